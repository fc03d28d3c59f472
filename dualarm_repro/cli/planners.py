"""`methods` and `plan`: the planners on arms and obstacles of one's own."""

from __future__ import annotations

from pathlib import Path
from shlex import join
from typing import Annotated, Any

import typer

from . import completion, output, progress
from .arguments import AsJson, Out
from .examples import examples


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
)
def plan(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.yaml", help="scene or task file")],
    method: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="name of a planner, see `dualarm methods`",
            autocompletion=completion.methods,
        ),
    ],
    out: Out = Path("out"),
    as_json: AsJson = False,
) -> None:
    """Plan the tasks of your own arms.

    Writes STEM.json, STEM_ARM.csv and the 3-D scene STEM.html, and says how closely bodies pass.
    """
    with progress.waiting(f"planning {scene.name} by {method}"):
        from ..ledger.file_set import write_together
        from ..ledger.files import to_json, write_text
        from ..planning.methods import plan_file
        from ..view.plan_report import plan_scene, plan_summary

        found = plan_file(scene, method)
        summary = {"scene": scene.name, "method": method, **plan_summary(found)}
        html = plan_scene(found, f"{scene.stem} by {method}").html()
        texts = {
            f"{scene.stem}.json": to_json(summary),
            **{f"{scene.stem}_{k}.csv": one.to_frame().to_csv() for k, one in found.plans.items()},
            f"{scene.stem}.html": html,
        }
        *files, page = write_together(
            out, lambda staged: [write_text(staged / name, text) for name, text in texts.items()]
        )
    again = join(["dualarm", "plan", str(scene), "--method", method, "--out", str(out)])
    view = join(["python3", "-m", "webbrowser", page.resolve().as_uri()])
    if as_json:
        written = [str(path) for path in (*files, page)]
        output.print_json({**summary, "files": written, "again": again, "view": view})
        return
    _print_outcome(summary)
    output.print_written([*files, page])
    print(f"again: {again}")
    print(f"view: {view}")


def _print_outcome(summary: dict[str, Any]) -> None:
    for name, entry in summary["arms"].items():
        print(f"{name}: {entry['reason']} after {entry['steps']} steps")
        if missed := entry["out_of_reach_m"]:
            print(f"  goal out of reach by {missed:.4f} m: planned to the nearest posture")
        if entry["certificate"]:
            certificate = entry["certificate"]
            print(f"  {', '.join(f'{key} {value}' for key, value in certificate.items())}")
    links = summary["links"]
    collision = "" if links["collision_free"] else ": COLLISION, do not run this on robots"
    pair, distance = " - ".join(links["pair"]), links["minimum_distance_m"]
    print(f"closest bodies: {pair} {distance:.4f} m{collision}")
