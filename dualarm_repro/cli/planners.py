"""`methods` and `plan`: the planners on arms and obstacles of one's own."""

from __future__ import annotations

from pathlib import Path
from shlex import join
from typing import Annotated, Any

import typer

from . import NOT_USABLE, completion, output, progress
from .arguments import AllowCollision, AsJson, Out
from .examples import examples
from .scenes import print_links


@examples("dualarm methods", "dualarm methods --json")
def methods(as_json: AsJson = False) -> None:
    """List the planners that `plan` knows.

    With --json, the settings of each as a JSON Schema.
    """
    with progress.waiting("loading the planners"):
        from ..planning.methods import METHODS, settings_schema
    if as_json:
        output.print_json(
            [
                {"name": name, "description": m.description, "settings": settings_schema(name)}
                for name, m in METHODS.items()
            ]
        )
        return
    rows = [(name, entry.description) for name, entry in METHODS.items()]
    output.print_table(("method", "description"), rows)


@examples(
    "dualarm plan tasks.yaml --method apf-bidirectional --out results",
    "dualarm plan tasks.yaml --method apf-improved --json",
    "dualarm plan tasks.yaml --method all",
)
def plan(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.yaml", help="scene or task file")],
    method: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="name of a planner, see `dualarm methods`, or `all`",
            autocompletion=completion.methods,
        ),
    ],
    out: Out = Path("out"),
    allow_collision: AllowCollision = False,
    as_json: AsJson = False,
) -> None:
    """Plan the tasks of your own arms.

    Writes STEM.json, STEM_ARM.csv and the 3-D scene STEM.html, and says how closely bodies pass.
    The method `all` compares all planners, one line each, and writes nothing.
    Exit code 0: all arrive and are certified free of contact; 3: not so, and the files say so; 2:
    bad input, nothing is written.
    """
    with progress.waiting(f"planning {scene.name} by {method}"):
        from ..ledger.file_set import write_texts
        from ..ledger.files import to_json
        from ..planning.checks.truth import truth
        from ..planning.methods import plan_file
        from ..view.plan_report import plan_reached, plan_scene, plan_summary, told, usable

        found = plan_file(scene, method, allow_collision)
        judged, reached = truth(found.scene, found.paths), plan_reached(found)
        outcome, good = told(judged, reached), usable(judged, reached)
        made = {"scene": scene.name, "method": method, "usable": good, "outcome": outcome}
        summary = {**made, **plan_summary(found, judged)}
        mark = "" if good else f"# DO NOT RUN: {outcome}\n"
        title = f"{scene.stem} by {method}" + ("" if good else f": {outcome}")
        texts = {f"{scene.stem}.json": to_json(summary)}
        for name, one in found.plans.items():
            texts[f"{scene.stem}_{name}.csv"] = mark + one.to_frame().to_csv()
        texts[f"{scene.stem}.html"] = plan_scene(found, title).html()
        files = write_texts(out, texts)
    allowed = ["--allow-collision"] * allow_collision
    again = join(["dualarm", "plan", str(scene), "--method", method, "--out", str(out), *allowed])
    view = join(["python3", "-m", "webbrowser", files[-1].resolve().as_uri()])
    if as_json:
        written = [str(path) for path in files]
        output.print_json({**summary, "files": written, "again": again, "view": view})
    else:
        _print_outcome(summary)
        output.print_written(files)
        print(f"again: {again}")
        print(f"view: {view}")
    if not good:
        raise typer.Exit(NOT_USABLE)


def _print_outcome(summary: dict[str, Any]) -> None:
    for name, entry in summary["arms"].items():
        if "out_of_reach_m" not in entry:
            print(f"{name}: {entry['reason']}")
            continue
        print(f"{name}: {entry['reason']} after {entry['steps']} steps")
        if missed := entry["out_of_reach_m"]:
            print(f"  goal out of reach by {missed:.4f} m: planned to the nearest posture")
        if excess := entry["beyond_limits"]:
            print(f"  beyond a joint limit by {excess:.4g} (rad, or m if it slides)")
        if entry["certificate"]:
            certificate = entry["certificate"]
            print(f"  {', '.join(f'{key} {value}' for key, value in certificate.items())}")
    print_links(summary)
    print(f"outcome: {summary['outcome']}")
