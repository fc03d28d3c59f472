"""What `patent` publishes of its motions, recomputed from the exported files in plain numpy.

The command line writes the files; of the arm its URDF is read, and nothing of the project.
"""

from pathlib import Path

import numpy as np
import pytest
from exported import Export, columns
from replayed_panda import Pair, optimality_residual

JOINTS = [f"{arm}_{{}}{k} [{{}}]" for arm in ("left", "right") for k in range(1, 8)]
#: Declared settings that the exported items do not list: gains and margins of the merged bounds.
FEEDBACK, LIMIT_GAIN, MARGIN, DAMPER, OUTER, INNER = 10.0, 5.0, 0.05, 5.0, 0.10, 0.03


@pytest.fixture(scope="module")
def export(files):
    return Export(files)


@pytest.fixture(scope="module")
def pair():
    return Pair(0.6)


def motion(export, item, name=None):
    """Rows of one motion of a table by column."""
    table = export.table(item)
    if name is None:
        return table
    chosen = table["motion"] == name
    return {key: values[chosen] for key, values in table.items()}


def joints(table, letter, unit):
    return columns(table, *(name.format(letter, unit) for name in JOINTS))


def paths(table, letter="", unit="m"):
    names = [f"{arm}_{letter}{axis} [{unit}]" for arm in ("left", "right") for axis in "xyz"]
    return columns(table, *names).reshape(-1, 2, 3)


def speeds(table):
    x = joints(table, "v", "rad/s")
    return x[:-1].astype(float)


def test_no_module_of_the_project_is_used():
    for name in ("test_replay_patent.py", "replayed_panda.py", "exported.py"):
        text = (Path(__file__).parent / name).read_text(encoding="utf-8")
        assert "import dualarm" + "_repro" not in text
        assert "from dualarm" + "_repro" not in text


def test_the_motions_of_fig_2(export, pair):
    obtained = export.obtained("patent.fig02")
    for name, key in (("without", "naive_distance"), ("with", "distance")):
        table = motion(export, "patent.fig02", name)
        q, x, dt = joints(table, "q", "rad"), speeds(table), np.diff(table["time [s]"])
        # Joints are the sums of the velocities that are held.
        assert np.abs(q[1:] - q[:-1] - dt[:, None] * x).max() < 1e-9
        looked = [pair.distance(row) for row in q[::20]]
        tips, least = np.array([one[0] for one in looked]), np.array([one[1] for one in looked])
        assert least == pytest.approx(table["distance [m]"][::20], abs=1e-8)
        assert table["distance [m]"].min() == pytest.approx(obtained[key], abs=1e-8)
        off = np.linalg.norm(tips - paths(table)[::20], axis=2)
        assert off.max() < 1.2e-5
        velocity = np.diff(paths(table), axis=0) / dt[:, None, None]
        halfway = 0.5 * (paths(table, "v", "m/s")[1:] + paths(table, "v", "m/s")[:-1])
        assert np.abs(velocity - halfway).max() < 1e-6
    assert off.max() == pytest.approx(obtained["tip_error"], abs=1e-6)
    assert np.abs(x).max() == pytest.approx(obtained["peak_speed"], abs=1e-8)
    acceleration = np.abs(np.diff(x, axis=0)).max() / dt[0]
    assert acceleration == pytest.approx(obtained["peak_acceleration"], abs=1e-4)
    arm = pair.arms[0]
    assert (np.abs(x) <= np.tile(arm.speed, 2)).all()
    assert (q > np.tile(arm.lower, 2)).all()
    assert (q < np.tile(arm.upper, 2)).all()


@pytest.mark.parametrize(
    ("item", "name", "avoid"),
    [
        ("patent.fig02", "with", True),
        ("patent.fig02", "without", False),
        ("patent.claim_two_ranges", "crossing, QP", True),
        ("patent.claim_two_ranges", "start below d2, QP", True),
        ("patent.claim_limits", "QP, slow", True),
        ("patent.claim_limits", "QP, fast", True),
    ],
)
def test_each_velocity_is_the_minimiser_of_its_problem(export, pair, item, name, avoid):
    table = motion(export, item, name)
    q, x = joints(table, "q", "rad"), speeds(table)
    path, velocity = paths(table), paths(table, "v", "m/s")
    arm, pressed = pair.arms[0], 0
    for k in range(0, len(x), max(1, len(x) // 60)):
        tips, distance, J, gradient = pair.look(q[k])
        b = (velocity[k] + FEEDBACK * (path[k] - tips)).ravel()
        C, d = np.zeros((0, 14)), np.zeros(0)
        if avoid:
            near = distance < OUTER
            room = LIMIT_GAIN * (np.tile(arm.upper, 2) - MARGIN - q[k])
            back = LIMIT_GAIN * (q[k] - np.tile(arm.lower, 2) - MARGIN)
            speed = np.tile(arm.speed, 2)
            C = np.vstack([-gradient[near], np.eye(14), -np.eye(14)])
            bounds = np.minimum(room, speed), np.minimum(back, speed)
            d = np.concatenate([DAMPER * (distance[near] - INNER), *bounds])
            pressed += bool((C @ x[k] - d > -1e-6).any())
        assert optimality_residual(x[k], J, b, C, d) < 1e-6
    assert pressed > 0 or not avoid


def test_excess_over_the_limits(export, pair):
    obtained, arm = export.obtained("patent.claim_limits"), pair.arms[0]
    angles = {"pseudo-inverse": "naive_excess", "QP": "angle_excess", "network": "network_excess"}
    for way, key in angles.items():
        q = joints(motion(export, "patent.claim_limits", f"{way}, slow"), "q", "rad")
        beyond = max((q - np.tile(arm.upper, 2)).max(), (np.tile(arm.lower, 2) - q).max())
        assert beyond == pytest.approx(obtained[key], abs=1e-8)
    for way, key in (("pseudo-inverse", "naive_speed_excess"), ("network", "network_speed_excess")):
        x = speeds(motion(export, "patent.claim_limits", f"{way}, fast"))
        beyond = (np.abs(x) - np.tile(arm.speed, 2)).max()
        assert beyond == pytest.approx(obtained[key], abs=1e-8)


def test_the_network_in_continuous_time(export, pair):
    table = motion(export, "patent.eq_integration")
    q = joints(table, "q", "rad")
    looked = [pair.distance(row) for row in q[::10]]
    tips = np.array([one[0] for one in looked])
    assert np.linalg.norm(tips - paths(table)[::10], axis=2).max() < 1e-6
    least = min(one[1] for one in looked)
    obtained = export.obtained("patent.eq_integration")["distance"]
    assert obtained - 1e-9 < least < obtained + 1e-5


def test_the_accuracy_of_the_network_from_rest_and_from_a_random_state(export, pair):
    obtained, table = (
        export.obtained("patent.claim_accuracy"),
        export.table("patent.claim_accuracy"),
    )
    errors = {}
    for name in dict.fromkeys(table["motion"]):
        one = motion(export, "patent.claim_accuracy", name)
        q, every = joints(one, "q", "rad"), slice(None, None, max(1, len(one["motion"]) // 400))
        tips = np.array([pair.distance(row)[0] for row in q[every]])
        errors[name] = np.linalg.norm(tips - paths(one)[every], axis=2).max()
    random = errors.pop("random state")
    (rest,) = errors.values()
    # Sampled every so often, so that the largest may lie between; the files keep ten digits.
    assert 0.5 * obtained["tip_error"] <= rest <= obtained["tip_error"] + 1e-6
    assert random <= obtained["tip_error_random_start"] + 1e-6
