"""`time`: a path of all arms within limits of speed and acceleration, as files for a robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from . import NOT_USABLE, output, progress
from .arguments import AsJson, Out
from .examples import examples
from .scenes import SceneFile, print_links


@examples(
    "dualarm time tasks.yaml out/tasks_left.csv out/tasks_right.csv --speed 0.5",
    "dualarm time cell.yaml path.csv --acceleration 3 --out results --json",
)
def time(
    scene: SceneFile,
    paths: Annotated[
        list[Path], typer.Argument(metavar="PATH.csv", help="as `dualarm check` takes them")
    ],
    speed: Annotated[
        float, typer.Option(help="share of the speed limits of the joints that may be used")
    ] = 1.0,
    acceleration: Annotated[
        float, typer.Option(help="largest acceleration of any joint [rad/s^2, m/s^2]")
    ] = 5.0,
    rate: Annotated[float, typer.Option(help="samples a second")] = 100.0,
    out: Out = Path("out"),
    as_json: AsJson = False,
) -> None:
    """Time a path within limits of speed and acceleration, and write it for a robot.

    Writes STEM_timed.csv (time, joints, tips), .json, .yaml (as a ROS JointTrajectory) and the 3-D
    page .html. The limits hold at every time, and the timed motion is certified anew; exit code 3:
    it is not free of contact, leaves joint limits, or does not begin at the start.
    """
    with progress.waiting(f"timing {scene.name}"):
        from ..ledger.file_set import write_texts
        from ..planning.checks.truth import truth
        from ..planning.timing import export
        from ..planning.timing.timed_motion import timed
        from ..view.check_report import away_from_starts, begins, checked_paths, loaded
        from ..view.plan_report import judged, remarks, told, usable
        from ..view.timed_scene import timed_scene

        given = loaded(scene)
        paths_given = checked_paths(given, paths)
        motion = timed(
            given.scene,
            paths_given,
            speed=speed,
            acceleration=acceleration,
            rate=rate,
        )
        found = truth(given.scene, motion.paths)
        begun = begins(away_from_starts(given, paths_given))
        good, outcome = usable(found, True, begun), told(found, True, begun)
        stem, mark = f"{scene.stem}_timed", "" if good else f"# DO NOT RUN: {outcome}\n"
        texts = {
            f"{stem}.csv": mark + export.to_csv(motion),
            f"{stem}.json": export.to_json(motion),
            f"{stem}.yaml": mark + export.to_joint_trajectory(motion),
            f"{stem}.html": timed_scene(motion, stem).html(),
        }
        files = write_texts(out, texts)
        summary = {
            "scene": scene.name,
            "duration_s": motion.duration,
            "samples": len(motion.time),
            "deviation_rad": motion.deviation,
            "speed_share": motion.fullest_speed,
            "acceleration_share": motion.fullest_acceleration,
            "begun": begun,
            "usable": good,
            "remarks": remarks(given.scene),
            **judged(found),
        }
    if as_json:
        output.print_json({**summary, "files": [str(path) for path in files]})
    else:
        print(f"duration: {motion.duration:.3f} s, {len(motion.time)} samples")
        print(f"largest distance from the path given: {motion.deviation:.2g} rad")
        print(
            f"certified at every time: at most {motion.fullest_speed:.4f} of the speeds and "
            f"{motion.fullest_acceleration:.4f} of the acceleration allowed"
        )
        if not begun:
            print("the path does not begin at the start of the scene")
        print_links(summary, "{:.3f} s")
        output.print_written(files)
    if not good:
        raise typer.Exit(NOT_USABLE)
