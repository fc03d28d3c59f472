"""Shared by the tests of the command line: calling it in this process."""

import sys

import pytest

from dualarm_repro import cli


@pytest.fixture
def dualarm(capsys, monkeypatch):
    """Run the command line in this process: exit code, standard output, standard error."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["dualarm", *map(str, arguments)])
        with pytest.raises(SystemExit) as stop:
            cli.main()
        out, err = capsys.readouterr()
        return stop.value.code or 0, out, err

    return run
