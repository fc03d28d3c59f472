"""`check` and `view`: a scene, or somebody else's path through it, without planning."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from . import NOT_USABLE, output, progress
from .arguments import AllowCollision, AsJson, Out
from .examples import examples

SceneFile = Annotated[
    Path, typer.Argument(metavar="SCENE.yaml", help="scene or task file", show_default=False)
]
PathFiles = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="PATH.csv", help="columns ARM.q1 ..., or q1 ... in a file named NAME_ARM.csv"
    ),
]


@examples(
    "dualarm check cell.yaml",
    "dualarm check cell.yaml path.csv",
    "dualarm check tasks.yaml out/tasks_left.csv out/tasks_right.csv --json",
)
def check(
    scene: SceneFile,
    paths: PathFiles = None,
    allow_collision: AllowCollision = False,
    as_json: AsJson = False,
) -> None:
    """Certify a scene, or paths through it, without planning.

    Exit code 0: certified free, within limits and at the goals; 3: not so; 2: bad input, or a start
    or goal of the scene that no plan may have.
    """
    with progress.waiting(f"checking {scene.name}"):
        from ..view.check_report import check_summary, loaded

        summary = check_summary(loaded(scene), list(paths or []), allow_collision)
        made = {"scene": scene.name, "paths": [str(path) for path in paths or []], **summary}
    if as_json:
        output.print_json(made)
    else:
        for name, arm in made["arms"].items():
            print(f"{name}: {_ends(arm)}")
        print_links(made)
        print(f"outcome: {made['outcome']}" if paths else "starts and goals: sound")
    if not made["usable"]:
        raise typer.Exit(NOT_USABLE)


@examples("dualarm view cell.yaml", "dualarm view tasks.yaml out/tasks_left.csv --out pages")
def view(
    scene: SceneFile, paths: PathFiles = None, out: Out = Path("out"), as_json: AsJson = False
) -> None:
    """Write the 3-D page of a scene, or of paths through it, without planning."""
    with progress.waiting(f"drawing {scene.name}"):
        from ..ledger.files import write_text
        from ..view.check_report import check_scene, loaded

        html = check_scene(loaded(scene), list(paths or []), scene.stem).html()
        page = write_text(out / f"{scene.stem}_view.html", html)
    if as_json:
        output.print_json({"scene": scene.name, "files": [str(page)]})
    else:
        output.print_written([page])


def _ends(arm: dict[str, Any]) -> str:
    from ..planning.checks.arrival import BEGUN

    gap = arm["away_from_start"]
    begun = "at its start" if gap <= BEGUN else f"{gap:.4g} (rad, or m if it slides) from its start"
    if "reached" not in arm:
        return begun
    return f"{begun}, {'at its goal' if arm['reached'] else 'not at its goal'}"


def print_links(summary: dict[str, Any], when: str = "step {:.4g}") -> None:
    """What of the arms is represented otherwise, the closest bodies, and the word for it if they
    collide."""
    for name, lines in summary.get("remarks", {}).items():
        for line in lines:
            print(f"{name}: {line}")
    links = summary["links"]
    if not links["pair"]:
        print("closest bodies: none are watched")
        return
    low, high = links["bracket_m"]
    pair = " - ".join(links["pair"])
    collision = (
        "" if links["collision_free"] else f": {links['verdict']}, do not run this on robots"
    )
    at = f"between {low:.4f} and {high:.4f} m at {when.format(links['step'])}"
    print(f"closest bodies: {pair} {at}{collision}")
