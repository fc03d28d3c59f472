"""What `qiu` publishes, recomputed in plain numpy from its CSV and JSON files.

The command line writes the files; nothing of the project is imported here. Of the arm the table of
its file is read, since no export holds its capsules.
"""

from pathlib import Path

import numpy as np
import pytest
from exported import Export, columns
from replayed_arm import Arm, apart_somewhere, arm_to_arm, arm_to_spheres, densified, to_itself
from replayed_search import Field, search

ROBOT = Path(__file__).parents[2] / "data" / "robots" / "irb120.yaml"
JOINTS = [f"q{j}" for j in range(1, 7)]


class Published(Export):
    """Numbers of the files, by item of `qiu`."""

    def record(self, item_id):
        return super().record(f"qiu.{item_id}")

    def table(self, item_id):
        return super().table(f"qiu.{item_id}")

    def printed(self, item, key):
        return np.array(self.record(item)["printed"][key], dtype=float)

    def arm(self, name):
        yaw = self.assumed("fig03")["base_yaw"]
        return Arm(ROBOT, self.printed("claim_bases", name), yaw)

    def field(self):
        keys = {
            "claim_d": "d",
            "claim_zeta": "zeta",
            "claim_rho0": "rho0",
            "claim_alpha0": "alpha0",
        }
        printed = {key: float(self.printed(item, key)) for item, key in keys.items()}
        return Field(
            self.arm("master"), *self.spheres(), printed, self.assumed("claim_no_collision")
        )

    def spheres(self):
        item = "claim_obstacles"
        return self.printed(item, "centres"), float(self.printed(item, "radius"))


@pytest.fixture(scope="module")
def published(files):
    return Published(files)


def test_forces_at_random_postures(published):
    field, table = published.field(), published.table("eq04")
    names = ("q", "goal", "F_att", "F_rep")
    parts = [columns(table, *(f"{name}{j}" for j in range(1, 7))) for name in names]
    assert len(parts[0]) == 100
    for q, goal, attraction, repulsion in zip(*parts, strict=True):
        assert field.attraction(q, goal) == pytest.approx(attraction, rel=1e-6, abs=1e-6)
        assert field.repulsion(q)[0] == pytest.approx(repulsion, rel=1e-6, abs=1e-6)


def test_clearance_of_the_searched_path(published):
    table, arm = published.table("fig12"), published.arm("master")
    path = densified(columns(table, *JOINTS))
    least = min(arm_to_spheres(arm, q, *published.spheres()) for q in path)
    there = published.record("fig12")["obtained"]["clearance"]["obstacles"]
    assert least == pytest.approx(there, abs=1e-6)


def test_clearance_of_the_flange_of_the_one_way_search(published):
    table = published.table("fig10")
    points = columns(table, "x", "y", "z")
    centres, radius = published.spheres()
    away = np.linalg.norm(points[:, np.newaxis] - centres, axis=2).min() - radius
    there = published.record("fig10")["obtained"]["flange_clearance"]
    assert away == pytest.approx(there, abs=1e-6)
    arm = published.arm("master")
    for q, point in zip(columns(table, *JOINTS), points, strict=True):
        assert next(arm.points(q, (7,)))[0] == pytest.approx(point, abs=1e-6)


def test_clearance_of_every_common_motion(published):
    table, smallest = published.table("fig17"), published.record("fig17")["obtained"]["smallest"]
    arms = [published.arm(name) for name in ("master", "slave")]
    names = [f"{n}_q{j}_deg" for n in ("master", "slave") for j in range(1, 7)]
    motions = np.deg2rad(columns(table, *names))
    readings = np.unique(table["reading"])
    assert len(readings) > 1
    for name in readings:
        rows = table["reading"] == name
        q = motions[rows]
        found = [arm_to_arm(arms[0], row[:6], arms[1], row[6:]) for row in q]
        assert found == pytest.approx(table["arm_to_arm_m"][rows], abs=1e-6)
        motion = densified(q)
        spheres = min(arm_to_spheres(arms[1], row[6:], *published.spheres()) for row in motion)
        assert spheres == pytest.approx(smallest[f"slave to spheres, {name}"], abs=1e-6)


@pytest.mark.parametrize(
    ("method", "most"),
    [
        ("improved", 10),
        pytest.param("improved", None, marks=pytest.mark.long),
        pytest.param("traditional", None, marks=pytest.mark.long),
    ],
)
def test_table_2_with_the_printed_gains(published, method, most):
    """All goals, or some: of these no fewer may fail or succeed than the others leave."""
    field, table = published.field(), published.table("claim_goals15")
    goals = np.deg2rad(columns(table, *(f"q{j}_deg" for j in range(1, 7))))
    order = np.random.default_rng(15).permutation(len(goals))[:most]
    start = published.printed("claim_start", "q")
    has_table = published.assumed("claim_no_collision")["floor"] != "none"
    pairs = apart_somewhere(field.arm)
    found = {"planner": 0, "truth": 0}
    for goal in goals[order]:
        arrived, path = search(field, start, goal, method == "improved")
        found["planner"] += arrived
        found["truth"] += arrived and is_free(field, path, has_table, pairs)
    table = published.table("tab02")
    rows = (table["control points"] == "elbow_wrist_flange") & (table["eta_0/zeta"] == 1.0)
    (row,) = np.flatnonzero(rows & (table["method"] == method))
    for key, count in found.items():
        there, of = map(int, table[key][row].split("/"))
        assert of == len(goals)
        assert there - (of - len(order)) <= count <= there, key


def is_free(field, path, has_table, pairs):
    """Whether whole links keep off the spheres, the table and, in these pairs, each other, and the
    joints keep their limits."""
    arm, lower, upper = field.arm, *field.arm.limits.T
    if (path < lower).any() or (path > upper).any():
        return False
    for q in densified(path):
        cores, radii = arm.cores(q), arm.radii
        if arm_to_spheres(arm, q, field.centres, field.radius) <= 0.0:
            return False
        if to_itself(arm, q, pairs) <= 0.0:
            return False
        # The base and the shoulder turn about the vertical only.
        if has_table and (cores[2:, :, 2].min(axis=1) - radii[2:]).min() <= 0.0:
            return False
    return True
