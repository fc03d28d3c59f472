"""Hostile input with fixed seeds: what is wrong is refused in one line, nothing else happens."""

import math
import resource

import calls
import commands
import numpy as np
import pytest
from long_tests import long_where
from numba import njit
from outcome import COMPILED, PATIENCE, Hang, judged, patience
from targets import cases, targets

from dualarm_repro.errors import InputError

#: Cases in all, how many of them are tried in short, and memory that they may take beyond what is
#: taken already.
CASES, SHORT, MEMORY = 10_000, 1_500, 6 * 2**30


@pytest.fixture(autouse=True, scope="module")
def bounded_memory():
    """An allocation of more than a few GB fails, as it should be refused before."""
    with open("/proc/self/statm", encoding="ascii") as file:
        taken = int(file.read().split()[0]) * resource.getpagesize()
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (taken + MEMORY, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_AS, before)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", targets())
@pytest.mark.parametrize("total", long_where(CASES.__eq__, [SHORT, CASES]))
def test_only_our_own_errors_and_no_nan(total, name):
    found = {}
    for seed in range(cases(name, total)):
        kind, what, case = targets()[name](seed)
        if kind == "defect":
            found.setdefault(what, (seed, case))
    assert not found


def test_so_many_cases():
    assert sum(cases(name, CASES) for name in targets()) >= CASES


@pytest.mark.parametrize("name", calls.known())
def test_valid_arguments_are_answered(name):
    entry = calls.known()[name]
    kind, what = judged(lambda: entry.function(**entry.arguments()), nan_allowed=True)
    assert (kind, what) == ("answered", "")


def test_the_judge_knows_defects():
    def refuses():
        raise InputError("a", "b", math.nan, "c")

    def stumbles():
        return {}["x"]

    def breaks_the_line():
        raise InputError("a\nb", "c", 1, "d")

    assert judged(refuses) == ("refused", "")
    assert judged(lambda: [1.0, np.ones(3)]) == ("answered", "")
    assert judged(stumbles)[0] == judged(breaks_the_line)[0] == "defect"
    assert judged(lambda: (1.0, np.array([math.nan])))[1] == "NaN for finite input"
    assert judged(lambda: 1.0, nan_given=True)[1] == "answers for NaN"


def test_the_compiler_is_never_ended_midway():
    # Many branches that all differ, so that it compiles for far longer than the patience.
    body = "".join(f"    x = x * {k}.5 if x > {k} else x + {k}\n" for k in range(60))
    made = {}
    exec(f"def long(x):\n{body}    return x", made)
    long = njit(made["long"])

    @patience(0.05)
    def forever():
        while True:
            long(0.5)

    with pytest.raises(Hang):
        forever()
    assert long.signatures
    assert long(0.5) == made["long"](0.5)


@pytest.mark.parametrize(
    ("taken", "expected", "given"),
    [
        ([1.0], ("answered", ""), [PATIENCE]),
        ([60.0, 60.0, 1.0], ("answered", ""), [PATIENCE, COMPILED, PATIENCE]),
        ([60.0, 60.0, 60.0], commands.NO_ANSWER, [PATIENCE, COMPILED, PATIENCE]),
        ([600.0, 600.0], commands.NO_ANSWER, [PATIENCE, COMPILED]),
    ],
)
def test_a_command_is_judged_without_the_time_in_which_it_compiles(taken, expected, given):
    allowed, taken = [], iter(taken)

    def attempt(seconds):
        allowed.append(seconds)
        return commands.NO_ANSWER if next(taken) > seconds else ("answered", "")

    assert commands.answer(attempt) == expected
    assert allowed == given
