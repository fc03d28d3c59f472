"""Border to the code of other packages: whatever it raises, prints or writes into, the library
keeps its own copy of the problem and answers with one line.

It runs in this process. Code that ends the process itself (``os._exit``, a signal, a fault of
compiled code) or never returns is out of reach, and an interruption by the user goes through.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from copy import deepcopy
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DualArmError, InputError, UnsupportedArmError

if TYPE_CHECKING:
    from .planner import FoundPath, PathProblem


@contextmanager
def bordered(source: str, field: str, value: object, expected: str) -> Iterator[None]:
    """One InputError of whatever is raised; what is printed goes to the standard error.

    Raises
    ------
    InputError
        Anything was raised, an attempt to end the process (``SystemExit``) included.
    """
    try:
        with redirect_stdout(sys.stderr):
            yield
    except UnsupportedArmError as error:
        raise UnsupportedArmError(f"{source}: {error}") from error
    except InputError as error:
        place = f"{source}: {error.source}"
        raise InputError(place, error.field, error.value, error.expected) from error
    except DualArmError as error:
        raise DualArmError(f"{source}: {error}") from error
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        kind = " ".join(f"{type(error).__name__}: {_text(error)}".split())
        raise InputError(source, field, value, f"{expected} ({kind})") from error


def asked(
    name: str, planner: Callable[[PathProblem], FoundPath], problem: PathProblem
) -> FoundPath:
    """What a planner answers to a copy of a problem.

    The copy shares no array with what the plan is judged by; only the number of evaluations comes
    back.

    Raises
    ------
    InputError
        The planner fails, or its answer is no FoundPath.
    """
    given = deepcopy(problem)
    with bordered(f"planner {name}", "method", name, "a planner that answers"):
        found = planner(given)
        asked_for = given.evaluations
    if isinstance(asked_for, int | np.integer):
        problem.evaluations = int(asked_for)
    return found


def _text(error: BaseException) -> str:
    try:
        return str(error)
    except Exception:  # even that is code of somebody else
        return "without a text"
