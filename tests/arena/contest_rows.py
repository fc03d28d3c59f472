"""Rows of a contest of two methods whose tables can be counted by hand."""

import numpy as np
import pandas as pd

from dualarm_repro.arena.judged import Outcome
from dualarm_repro.arena.study import WITNESS

#: One of today's planners and one of a document.
A, B = "rrt-connect", "apf-improved"


def made(number, method, outcome, length=np.nan, evaluations=0, claim=False):
    """A row as the study stores it."""
    task = {"kind": "random", "group": "g", "subject": "s", "number": number}
    values = {"joint_length": length, "evaluations": evaluations, "claim": claim}
    values["time"] = 0.01 * evaluations
    return {**task, "method": method, "outcome": str(outcome), **values}


def table():
    """Task 0: both; 1: only A; 2: nobody but the witness; 3: nobody; 4: an unsound end."""
    ok, hit, stop = Outcome.SUCCESS, Outcome.COLLIDES, Outcome.STOPPED
    rows = [
        made(0, WITNESS, ok), made(0, A, ok, 2.0, 100, True), made(0, B, ok, 6.0, 50, True),
        made(1, WITNESS, stop), made(1, A, ok, 3.0, 300, True), made(1, B, hit, 1.0, 20, True),
        made(2, WITNESS, ok), made(2, A, stop, 0.0, 20_000), made(2, B, stop, 1.0, 40),
        made(3, WITNESS, stop), made(3, A, stop), made(3, B, hit, 1.0, 10, True),
        *(made(4, name, Outcome.NO_TASK) for name in (WITNESS, A, B)),
    ]  # fmt: skip
    return pd.DataFrame(rows)
