"""Files of every kind with something wrong in them: changed values, changed text."""

import copy
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import yaml
from outcome import judged
from valid import CELL, TASKS, folder

from dualarm_repro.arms import Arm, load_arm, load_robot_file
from dualarm_repro.control import load_scenario
from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger.schema import load_paper
from dualarm_repro.planning import load_tasks
from dualarm_repro.scene import clearance_gradient, load_scene

VALUES = (
    *(
        None,
        True,
        "",
        " ",
        "x",
        "x" * 300,
        "é",
        "../x",
        "nan",
        0,
        -1,
        3,
        2.5,
        1e-320,
        1e12,
        1e30,
        1e308,
    ),
    *(float("nan"), float("inf"), -float("inf"), 10**30, 10**400, [], {}, [1], {"a": 1}, "90 deg"),
    *("pi/0", "-pi/2", "9" * 400 + " deg", [[1, 2], [3]], [1.0, 2.0, 3.0], [float("nan")] * 3),
)
SNIPPETS = (
    *(
        "\n? [a]\n: b\n",
        " 2024-13-45 ",
        " !!int abc ",
        " !!float x ",
        " !!python/object:os.system x ",
        "\0",
    ),
    *(
        "&a [*a]",
        "*nope",
        "{",
        "}",
        "[",
        "]",
        ":",
        "- ",
        "\t",
        "\ufeff",
        "%",
        "!!binary x",
        "<<: *x",
        "'",
    ),
    *("2024-01-01T00:00:00+99:99", "9" * 5000, "#", "---\n", "<", ">", "&", "/>", "<!--", "1e999"),
)
LIMIT = "<limit lower='-2.5' upper='2.5' effort='10' velocity='2'/>"
URDF = f"""<robot name='r'>
<link name='base'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
<link name='l1'><visual><geometry><box size='0.1 0.1 0.3'/></geometry></visual></link>
<link name='l2'><collision><origin xyz='0 0 0.1' rpy='0 0 1'/>
 <geometry><cylinder radius='0.05' length='0.3'/></geometry></collision></link>
<joint name='j1' type='revolute'><parent link='base'/><child link='l1'/>
 <origin xyz='0 0 0.3' rpy='0.1 0.2 0.3'/><axis xyz='0 0 1'/>{LIMIT}</joint>
<joint name='j2' type='continuous'><parent link='l1'/><child link='l2'/>
 <origin xyz='0 0 0.3'/><axis xyz='0 1 0'/><limit effort='10' velocity='2'/></joint>
</robot>
"""


def _kinematics(arm):
    q = np.where(np.isfinite(arm.lower), np.clip(0.1, arm.lower, arm.upper), 0.1)
    return arm.fk(q), arm.jacobian(q), arm.manipulability(q)


def _robot(path):
    robot = load_robot_file(path)
    return _kinematics(Arm.from_dh("a", robot, "none")) if robot.kind == "dh" else None


def _scene(path):
    scene = load_scene(path)
    return clearance_gradient(scene, np.zeros(scene.nq))


def _tasks(path):
    return load_tasks(path).scene.nq


#: Kind of file to its valid text, its ending, and what is done with it.
KINDS = {
    "robot": (lambda: data_path("robots", "irb120.yaml").read_text(), "yaml", _robot),
    "scene": (lambda: CELL, "yaml", _scene),
    "tasks": (lambda: TASKS, "yaml", _tasks),
    "scenario": (
        lambda: data_path("scenes", "patent_crossing.yaml").read_text(),
        "yaml",
        load_scenario,
    ),
    "ledger": (lambda: _small_ledger(), "yaml", load_paper),
    "urdf": (lambda: URDF, "urdf", lambda path: _kinematics(load_arm(path, flange="l2"))),
}


@cache
def _small_ledger():
    spec = spec_from_file_location("toy", Path(__file__).parents[1] / "ledger" / "toy.py")
    toy = module_from_spec(spec)
    spec.loader.exec_module(toy)
    return toy.YAML


@cache
def _plain(kind):
    """The valid file as plain mappings and lists."""
    return yaml.safe_load(KINDS[kind][0]())


def call(kind, seed):
    """Judge the reading of one changed file: outcome, defect and the text."""
    rng = np.random.default_rng([seed, *kind.encode()])
    text, ending, use = KINDS[kind]
    changed = text()
    if ending == "yaml" and rng.random() < 0.6:
        content = copy.deepcopy(_plain(kind))
        for _ in range(rng.integers(1, 3)):
            _change(content, rng)
        changed = yaml.safe_dump(content, allow_unicode=True)
    else:
        for _ in range(rng.integers(1, 3)):
            changed = _edited(changed, rng)
    path = folder() / f"changed-{kind}.{ending}"
    path.write_bytes(changed.encode("utf-8", "surrogatepass"))
    return (*judged(lambda: use(path)), changed)


def _change(content, rng):
    """Replace, drop, add or repeat something at a random place."""
    place = content
    while True:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        if not keys:
            return
        key = keys[rng.integers(len(keys))]
        below = place[key]
        if isinstance(below, dict | list) and below and rng.random() < 0.8:
            place = below
            continue
        match rng.integers(5):
            case 0:
                del place[key]
            case 1 if isinstance(place, dict):
                place[VALUES[rng.integers(8)] or "more"] = below
            case 1:
                place.append(below)
            case _:
                place[key] = VALUES[rng.integers(len(VALUES))]
        return


def _edited(text, rng):
    """The text with a piece cut out, doubled, replaced or put in."""
    start = int(rng.integers(len(text) + 1))
    stop = min(len(text), start + int(rng.integers(1, 12)))
    match rng.integers(5):
        case 0:
            return text[:start] + text[stop:]
        case 1:
            return text[:stop] + text[start:]
        case 2:
            number = VALUES[rng.integers(len(VALUES))]
            return text[:start] + str(number)[:500] + text[stop:]
        case 3:
            return text[: start + 1]
        case _:
            return text[:start] + SNIPPETS[rng.integers(len(SNIPPETS))] + text[start:]
