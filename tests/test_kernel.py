"""Compiled code follows an edit of a function that it calls, whatever the time stamps say."""

import os
import subprocess
import sys

SCRIPT = """
import sys
sys.path.insert(0, {folder!r})
from dualarm_repro.caller import doubled
print(doubled(2.0))
"""
PACKAGE = {
    "__init__.py": "",
    "caller.py": "from .called import factor\nfrom .kernel import kernel\n\n\n@kernel\n"
    "def doubled(x):\n    return factor(x) * x\n",
    "called.py": "from .kernel import kernel\n\n\n@kernel\ndef factor(x):\n    return 2.0\n",
}


def _run(folder, cache):
    environment = {**os.environ, "DUALARM_CACHE": str(cache)}
    environment.pop("NUMBA_CACHE_DIR", None)
    code = SCRIPT.format(folder=str(folder))
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True,
                          text=True, check=True)  # fmt: skip
    return float(done.stdout)


def test_an_edit_of_a_called_kernel_is_seen(tmp_path):
    import shutil
    from pathlib import Path

    import dualarm_repro

    package = tmp_path / "src" / "dualarm_repro"
    package.mkdir(parents=True)
    for name in ("kernel.py", "sources.py", "cache_folder.py"):
        shutil.copy(Path(dualarm_repro.__file__).parent / name, package / name)
    for name, text in PACKAGE.items():
        (package / name).write_text(text)
    cache = tmp_path / "cache"
    assert _run(package.parent, cache) == 4.0
    assert list(cache.rglob("*.nbc")), "machine code is kept"
    called = package / "called.py"
    stat = called.stat()
    called.write_text(called.read_text().replace("2.0", "3.0"))
    os.utime(called, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    assert _run(package.parent, cache) == 6.0
    assert _run(package.parent, "off") == 6.0
