"""Surroundings that nobody thought of: names of folders, locales, packages that are missing."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from .calls import Place, called
from .jobs import Job, cli, refusal
from .laboratory import Laboratory, Trial

NAMES = ("two words", "双臂 机械臂", "ünï çødé", "-dash", 'it\'s "quoted" $HOME %20 #1', "a\nb")
LOCALES: dict[str, dict[str, str | None]] = {
    "C": {"LC_ALL": "C"},
    "C, no UTF-8 at all": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "POSIX": {"LC_ALL": "POSIX", "LANG": None, "LANGUAGE": None},
    "unknown": {"LC_ALL": "xx_YY.UTF-8"},
    "ASCII pipes": {"PYTHONIOENCODING": "ascii"},
    "Latin-1 pipes": {"PYTHONIOENCODING": "latin-1"},
}
#: Makes packages invisible that are named in a variable; Python imports it at its start.
_HIDES = """
import os, sys
from importlib.machinery import PathFinder

class Without:
    hidden = set(os.environ["FAULTS_MISSING"].split(","))
    @classmethod
    def find_spec(cls, name, path=None, target=None):
        hides = name.partition(".")[0] in cls.hidden
        return None if hides else PathFinder.find_spec(name, path, target)

sys.meta_path[:] = [Without if one is PathFinder else one for one in sys.meta_path]
"""
METHODS = cli("methods", "methods")


def folders(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """Folders of any name, and a way to one of them through a link."""
    for job in jobs:
        expected = lab.undisturbed(job).results
        for name in lab.some(NAMES):
            place = lab.place()
            inner = place.folder / name
            inner.mkdir()
            there = Place(inner, place.cache)
            wrong = job.complaint(called(job.command, there), expected, inner)
            yield Trial("odd folder", f"{job.name} in {name!r}", wrong)
        place = lab.place()
        link = place.folder / "link"
        link.symlink_to(lab.place().folder)
        yield Trial("odd folder", f"{job.name}, link", lab.survives(job, Place(link, place.cache)))


def locales(lab: Laboratory, jobs: Sequence[Job]) -> Iterator[Trial]:
    """Locales without the letters that are printed: no result is another, nothing is refused."""
    for job in jobs:
        expected = lab.undisturbed(job).results
        for name, changes in lab.some(LOCALES.items()):
            place = lab.place(changes=changes)
            call = called(job.command, place)
            told = {k: v for k, v in expected.items() if k != "standard output"}
            wrong = job.complaint(call._replace(out=""), {**told, **_empty(job)}, place.folder)
            yield Trial("locale", f"{job.name}, {name}", wrong)


def missing(lab: Laboratory) -> Iterator[Trial]:
    """Packages of the extras that are not there: named in one line where they are needed."""
    hide = lab.scratch / "hide"
    hide.mkdir()
    (hide / "sitecustomize.py").write_text(_HIDES, encoding="utf-8")

    def without(*names: str) -> Place:
        path = os.pathsep.join(filter(None, (str(hide), os.environ.get("PYTHONPATH"))))
        return lab.place(changes={"PYTHONPATH": path, "FAULTS_MISSING": ",".join(names)})

    extras = ("ompl", "pink", "crocoddyl", "quadprog", "dask", "distributed")
    for names in (*((name,) for name in extras), extras):
        call = called(METHODS.command, without(*names))
        wrong = "" if call.code == 0 and not call.err else refusal(call, ())
        yield Trial("missing package", f"methods without {', '.join(names)}", wrong)
    needed = {
        "rrt-connect": "ompl",
        "bit-star": "ompl",
        "trajectory-optimisation": "crocoddyl",
    }
    scene = str(Path(__file__).resolve().parents[2] / "data" / "scenes" / "example_tasks.yaml")
    for method, package in needed.items():
        job = cli(method, "plan", scene, "--method", method)
        wrong = refusal(called(job.command, without(package)))
        yield Trial("missing package", f"{method} without {package}", wrong)
    job = cli("scheduler", "verify", "xue.eq01", "--scheduler", "tcp://localhost:1")
    wrong = refusal(called(job.command, without("dask", "distributed")))
    yield Trial("missing package", "a scheduler without dask", wrong)


def _empty(job: Job) -> dict[str, str]:
    return {"standard output": ""} if job.told else {}
