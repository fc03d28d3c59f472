"""Command lines with wrong, odd and missing arguments, run in this process."""

import contextlib
import io
import sys
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from outcome import COMPILED, PATIENCE, Hang, patience
from valid import folder

from dualarm_repro import cli

WORDS = (
    *(
        "",
        " ",
        "-",
        "--",
        "-x",
        "--nope",
        "--json",
        "--out",
        "--help=1",
        "nope",
        "xue.eq01",
        "xue.nope",
    ),
    *(
        "../x",
        "/",
        ".",
        "\0",
        "x" * 5000,
        "nan",
        "-1",
        "0",
        "1e400",
        "é",
        "a\nb",
        "{}",
        "--paper",
        "xue",
    ),
    *(
        "--kind",
        "table",
        "--format",
        "bibtex",
        "--method",
        "apf-improved",
        "--jobs",
        "--samples",
        "--seed",
    ),
)
#: Commands that compute or rewrite for long once their arguments are right, and open a server.
LONG = {"run", "verify", "robustness", "study", "arena", "view", "new-document", "export"}


#: What is said of a command that takes too long.
NO_ANSWER = ("defect", "no answer")


def call(name, seed):
    """Judge one command line: its exit code, one line on standard error, nothing written."""
    rng = np.random.default_rng([seed, *name.encode()])
    files = [str(folder() / one) for one in ("cell.yaml", "missing.yaml", "robot.yaml")]
    words = [*WORDS, *files, str(folder())]
    line = [name, *(words[k] for k in rng.integers(len(words), size=rng.integers(0, 5)))]
    if name in LONG:
        line += ["--nope-at-all"]
    return *answer(lambda seconds: _judged(line, name == "plan", seconds)), repr(line)


def answer(attempt):
    """What an attempt gives within its processor time [s]. One that takes too long may have
    compiled: it is given time for that, once, and then has to be quick."""
    made = attempt(PATIENCE)
    if made == NO_ANSWER:
        made = attempt(COMPILED)
        made = made if made == NO_ANSWER else attempt(PATIENCE)
    return made


def _judged(line, writes, seconds):
    # a folder of its own, since a command that is repeated would find its own files
    place = Path(mkdtemp(dir=folder())) / "out"
    line = [*line, "--out", str(place)] if writes else line
    out, err = io.StringIO(), io.StringIO()
    before, sys.argv = sys.argv, ["dualarm", *line]
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), patience(seconds):
            cli.main()
    except SystemExit as stop:
        code = stop.code or 0
    except Hang:
        return NO_ANSWER
    except BaseException as error:
        return "defect", f"{type(error).__name__} left the command line"
    finally:
        sys.argv = before
    lines = err.getvalue().strip().splitlines()
    if code not in (0, 1, 2, 3):
        return "defect", f"exit code {code}: {' '.join(lines)[:120]}"
    if code == 2 and (not lines or "Traceback" in err.getvalue()):
        return "defect", f"exit code 2 with {len(lines)} lines"
    if code == 2 and place.exists() and any(place.iterdir()):
        return "defect", "files written although the input is bad"
    return ("answered" if code == 0 else "refused"), ""
