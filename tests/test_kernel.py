"""Compiled code follows an edit of a function that it calls, whatever the time stamps say."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from numba import float64
from numba.core import event

import dualarm_repro
from dualarm_repro.kernel import kernel

SCRIPT = """
import sys
sys.path.insert(0, {folder!r})
from dualarm_repro.caller import doubled
print(doubled({argument}))
"""
#: What compiling needs of the package.
OURS = (
    "kernel.py",
    "machine_code.py",
    "interruption.py",
    "sources.py",
    "cache_folder.py",
    "terminal.py",
)
PACKAGE = {
    "__init__.py": "",
    "caller.py": "from .called import factor\nfrom .kernel import kernel\n\n\n@kernel\n"
    "def doubled(x):\n    return factor(x) * x\n",
    "called.py": "from .kernel import kernel\n\n\n@kernel\ndef factor(x):\n    return 2.0\n",
}


def _run(folder, cache, argument="2.0"):
    return float(_printed(folder, cache, SCRIPT.format(folder=str(folder), argument=argument)))


def _printed(folder, cache, code):
    # Python's own cache of bytecode does go by time stamps.
    environment = {**os.environ, "DUALARM_CACHE": str(cache), "PYTHONDONTWRITEBYTECODE": "1"}
    environment.pop("NUMBA_CACHE_DIR", None)
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True,
                          text=True, check=True)  # fmt: skip
    return done.stdout


def _package(tmp_path, files):
    """A package with our way of compiling, and these files."""
    package = tmp_path / "src" / "dualarm_repro"
    package.mkdir(parents=True)
    for name in OURS:
        shutil.copy(Path(dualarm_repro.__file__).parent / name, package / name)
    for name, text in files.items():
        (package / name).write_text(text)
    return package


def test_an_edit_of_a_called_kernel_is_seen(tmp_path):
    package, cache = _package(tmp_path, PACKAGE), tmp_path / "cache"
    assert _run(package.parent, cache) == 4.0
    assert list(cache.rglob("*.nbc")), "machine code is kept"
    called = package / "called.py"
    stat = called.stat()
    called.write_text(called.read_text().replace("2.0", "3.0"))
    os.utime(called, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    assert _run(package.parent, cache) == 6.0
    assert _run(package.parent, "off") == 6.0


PAIR = """from typing import NamedTuple


class {name}(NamedTuple):
    {first}: float
    {second}: float
"""


def test_the_fields_of_a_named_tuple_count_though_no_kernel_imports_it(tmp_path):
    caller = (
        "from .kernel import kernel\n\n\n@kernel\ndef doubled(pair):\n    return 2.0 * pair.a\n"
    )
    package, cache = _package(tmp_path, {"__init__.py": "", "caller.py": caller}), tmp_path / "c"
    for name, first, second in (("Pair", "a", "b"), ("Pair", "b", "a"), ("Couple", "b", "a")):
        (package / "pairs.py").write_text(PAIR.format(name=name, first=first, second=second))
        argument = f"__import__('dualarm_repro.pairs').pairs.{name}(a=1.0, b=5.0)"
        assert _run(package.parent, cache, argument) == 2.0


#: A kernel called by Python and by another kernel, in any order.
ORDERS = ("doubled(2.0), factor(2.0)", "factor(2.0), doubled(2.0)", "factor(2.0), factor(3)")


@pytest.mark.parametrize("calls", ORDERS)
def test_a_kernel_answers_python_and_kernels_in_any_order(tmp_path, calls):
    package, cache = _package(tmp_path, PACKAGE), tmp_path / "cache"
    code = (
        f"import sys\nsys.path.insert(0, {str(package.parent)!r})\n"
        "from dualarm_repro.caller import doubled\nfrom dualarm_repro.called import factor\n"
        f"print({calls})\n"
    )
    wanted = " ".join("4.0" if call.startswith("doubled") else "2.0" for call in calls.split(", "))
    for _ in range(2):  # compiled, and from the machine code that was kept
        assert _printed(package.parent, cache, code).split() == wanted.split()


def test_an_interruption_while_it_compiles_leaves_a_whole_function(monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", "off")  # it is none of the package's, whose texts are known
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)

    def half(x):
        return 0.5 * x

    compiled = kernel(half)

    class Interruption(event.Listener):
        def on_start(self, _):
            signal.raise_signal(signal.SIGINT)

        def on_end(self, _):
            self.ended = True

    listener = Interruption()
    with event.install_listener("numba:compile", listener), pytest.raises(KeyboardInterrupt):
        compiled(3.0)
    assert listener.ended
    assert compiled.signatures == [(float64,)], "it is not compiled twice"
    assert compiled(3.0) == 1.5
