"""Command lines with wrong, odd and missing arguments, run in this process."""

import contextlib
import io
import sys

import numpy as np
from outcome import Hang, patience
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


def call(name, seed):
    """Judge one command line: its exit code, one line on standard error, nothing written."""
    rng = np.random.default_rng([seed, *name.encode()])
    place = folder() / "out"
    files = [str(folder() / one) for one in ("cell.yaml", "missing.yaml", "robot.yaml")]
    words = [*WORDS, *files, str(folder())]
    line = [name, *(words[k] for k in rng.integers(len(words), size=rng.integers(0, 5)))]
    if name in LONG:
        line += ["--nope-at-all"]
    return (
        *_judged([*line, *(("--out", str(place)) if name == "plan" else ())], place),
        repr(line),
    )


def _judged(line, place):
    out, err = io.StringIO(), io.StringIO()
    before, sys.argv = sys.argv, ["dualarm", *line]
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), patience():
            cli.main()
    except SystemExit as stop:
        code = stop.code or 0
    except Hang:
        return "defect", "no answer"
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
