"""What `dualarm` says when it is called without arguments."""

from __future__ import annotations

_TEXT = """\
dualarm recomputes what documents on dual-arm robots print, compares, and says what holds.

Usage: dualarm COMMAND [ARGUMENTS] [OPTIONS]

Where to start:
  dualarm list --paper xue                       the items of a document, with their verdicts
  dualarm show xue.tab02                         what is printed beside what is obtained, and why
  dualarm run xue.tab02 --set base_distance=3.0  again, with one assumption changed
  dualarm cite xue.tab02                         a citation of the result and its document
  dualarm methods                                planners for arms and obstacles of your own

`dualarm --help` lists all commands, `dualarm COMMAND --help` explains one and gives examples."""


def overview() -> str:
    """A newcomer's first five commands, and where to read on."""
    return _TEXT
