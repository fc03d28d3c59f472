"""Packages of others are imported without what Python says of their source."""

import subprocess
import sys

import pytest

from dualarm_repro.quiet_import import quietly

LOUD = 'import warnings\nwarnings.warn("escape", SyntaxWarning)\nvalue = 3\n'


def test_a_module_that_warns_is_imported_in_silence(tmp_path):
    (tmp_path / "loud_module.py").write_text(LOUD)
    for line, says in (
        ("import loud_module as m", True),
        ("from dualarm_repro.quiet_import import quietly; m = quietly('loud_module')", False),
    ):
        made = subprocess.run(
            [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(tmp_path)!r}); {line}; "
             "print(m.value)"], capture_output=True, text=True, check=True,
        )  # fmt: skip
        assert made.stdout == "3\n"
        assert bool(made.stderr) is says


def test_a_missing_module_is_said():
    with pytest.raises(ModuleNotFoundError):
        quietly("no_such_package")
