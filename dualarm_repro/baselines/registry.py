"""Every planner by name: the documents' methods, today's baselines, and those of other packages.

A package of one's own declares a planner as an entry point::

    [project.entry-points."dualarm_repro.planners"]
    my-planner = "my_package:plan"
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from importlib.metadata import EntryPoint, entry_points
from typing import Any, cast

from ..errors import InputError
from ..planning.foreign import bordered
from ..planning.methods import METHODS, Method
from ..planning.path_plan import as_method
from ..planning.planner import GROUP, PathPlanner
from ..planning.settings import APFSettings
from . import barrier, compiled_sampling, mutual_avoidance, sampling, shooting

#: Baselines by name. None imports the library behind it before it plans.
BASELINES: dict[str, PathPlanner] = {
    "mutual-avoidance-qp": mutual_avoidance.mutual_avoidance,
    "cbf-qp": barrier.barrier,
    "rrt-connect": sampling.rrt_connect,
    "rrt-connect-simplified": sampling.rrt_connect_simplified,
    "rrt-connect-in-turn": sampling.rrt_connect_in_turn,
    "rrt-connect-compiled": compiled_sampling.rrt_connect_compiled,
    "rrt-connect-compiled-in-turn": compiled_sampling.rrt_connect_compiled_in_turn,
    "bit-star": sampling.bit_star,
    "trajectory-optimisation": shooting.shooting,
}
#: Longest description of a planner that is listed.
_LONGEST = 200
WHOLE_LINKS = "apf-whole-links"


def enlist() -> dict[str, Method[Any]]:
    """Make every planner known to `plan_file`, and give the list by name.

    A package that cannot be loaded stays on the list, and says why when it is asked to plan. It
    cannot take the name of a method that is known already.
    """
    known = cast("dict[str, Method[Any]]", METHODS)
    for name, made in {**_baselines(), **found()}.items():
        known.setdefault(name, made)
    return known


def found() -> dict[str, Method[Any]]:
    """The planners of other packages that are installed, by the name of their entry point."""
    return {
        one.name: as_method(one.name, _described(one), partial(_loaded, one))
        for one in sorted(entry_points(group=GROUP), key=lambda one: one.name)
    }


def _baselines() -> dict[str, Method[Any]]:
    made = {
        name: as_method(name, first_line(planner), partial(_itself, planner), foreign=False)
        for name, planner in BASELINES.items()
    }
    improved = METHODS["apf-improved"]
    made[WHOLE_LINKS] = Method(
        WHOLE_LINKS,
        "The improved field with repulsion of the capsules of all links",
        _of_whole_links,
        APFSettings,
        cast("Method[APFSettings]", improved).default,
        cast("Method[APFSettings]", improved).plan,
    )
    return made


def first_line(planner: Callable[..., Any]) -> str:
    """What a planner says of itself: the first line of its docstring, as a title."""
    said = planner.__doc__ if isinstance(planner.__doc__, str) else ""
    lines = said.strip().splitlines() or ["says nothing of itself"]
    line = " ".join("".join(one if one.isprintable() else " " for one in lines[0]).split())
    return line[:1].upper() + line[1:_LONGEST].rstrip(".")


def _of_whole_links(settings: APFSettings) -> APFSettings:
    return settings.changed(control_points="capsules", weights=None)


def _itself(planner: PathPlanner) -> PathPlanner:
    return planner


def _described(one: EntryPoint) -> str:
    try:
        return first_line(_loaded(one))
    except InputError as error:
        return f"Cannot be loaded: {error.expected}"


def _loaded(one: EntryPoint) -> PathPlanner:
    with bordered(f"entry point {one.name}", "planner", one.value, "a planner"):
        planner = one.load()
        if not callable(planner):
            kind = type(planner).__name__
            raise TypeError(f"{kind} is no function from a PathProblem to a FoundPath")
    return cast("PathPlanner", planner)
