"""What `qiu` publishes, recomputed in plain numpy from its CSV and JSON files, which pandas reads.

The command line writes the files; nothing of the project is imported here. Of the arm the table of
its file is read.
"""

import json
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from replayed_arm import Arm, apart_somewhere, arm_to_arm, arm_to_spheres, densified, to_itself
from replayed_search import Field, search

ROBOT = Path(__file__).parents[2] / "data" / "robots" / "irb120.yaml"
ITEMS = [
    "qiu.claim_bases", "qiu.claim_obstacles", "qiu.claim_start", "qiu.claim_d", "qiu.claim_zeta",
    "qiu.claim_rho0", "qiu.claim_alpha0", "qiu.claim_goals15", "qiu.claim_no_collision", "qiu.eq04",
    "qiu.fig03", "qiu.fig10", "qiu.fig12", "qiu.fig17", "qiu.tab02",
]  # fmt: skip
JOINTS = [f"q{j}" for j in range(1, 7)]


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("published")
    command = [sys.executable, "-m", "dualarm_repro.cli", "run", *ITEMS, "--out", str(folder)]
    subprocess.run(command, check=True, capture_output=True)
    return folder


class Published:
    """Numbers of the files, by item."""

    def __init__(self, folder):
        self.folder = folder

    @cache  # noqa: B019
    def record(self, item):
        return json.loads((self.folder / f"qiu.{item}.json").read_text())

    @cache  # noqa: B019
    def table(self, item):
        return pd.read_csv(self.folder / f"qiu.{item}.csv")

    def printed(self, item, key):
        return np.array(self.record(item)["printed"][key], dtype=float)

    def assumed(self, item):
        entries = [*self.record(item)["assumptions"], *self.record(item)["context"]]
        return {entry["id"].removeprefix("qiu."): entry["value"] for entry in entries}

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
    assert len(table) == 100
    for _, row in table.iterrows():
        q, goal = row[JOINTS].to_numpy(), row[[f"goal{j}" for j in range(1, 7)]].to_numpy()
        for name, force in (("F_att", field.attraction(q, goal)), ("F_rep", field.repulsion(q)[0])):
            there = row[[f"{name}{j}" for j in range(1, 7)]].to_numpy()
            assert force == pytest.approx(there, rel=1e-6, abs=1e-6)


def test_clearance_of_the_searched_path(published):
    table, arm = published.table("fig12"), published.arm("master")
    path = densified(table[JOINTS].to_numpy())
    least = min(arm_to_spheres(arm, q, *published.spheres()) for q in path)
    there = published.record("fig12")["obtained"]["clearance"]["obstacles"]
    assert least == pytest.approx(there, abs=1e-6)


def test_clearance_of_the_flange_of_the_one_way_search(published):
    points = published.table("fig10")[["x", "y", "z"]].to_numpy()
    centres, radius = published.spheres()
    away = np.linalg.norm(points[:, np.newaxis] - centres, axis=2).min() - radius
    there = published.record("fig10")["obtained"]["flange_clearance"]
    assert away == pytest.approx(there, abs=1e-6)
    arm = published.arm("master")
    for q, point in zip(published.table("fig10")[JOINTS].to_numpy(), points, strict=True):
        assert next(arm.points(q, (7,)))[0] == pytest.approx(point, abs=1e-6)


def test_clearance_of_every_common_motion(published):
    table, smallest = published.table("fig17"), published.record("fig17")["obtained"]["smallest"]
    arms = [published.arm(name) for name in ("master", "slave")]
    columns = [f"{n}_q{j}_deg" for n in ("master", "slave") for j in range(1, 7)]
    assert table["reading"].nunique() > 1
    for name, rows in table.groupby("reading"):
        q = np.deg2rad(rows[columns].to_numpy())
        found = [arm_to_arm(arms[0], row[:6], arms[1], row[6:]) for row in q]
        assert found == pytest.approx(rows["arm_to_arm_m"].to_list(), abs=1e-6)
        motion = densified(q)
        spheres = min(arm_to_spheres(arms[1], row[6:], *published.spheres()) for row in motion)
        assert spheres == pytest.approx(smallest[f"slave to spheres, {name}"], abs=1e-6)


@pytest.mark.parametrize("method", ["traditional", "improved"])
def test_table_2_with_the_printed_gains(published, method):
    field, goals = published.field(), published.table("claim_goals15")
    start = published.printed("claim_start", "q")
    has_table = published.assumed("claim_no_collision")["floor"] != "none"
    pairs = apart_somewhere(field.arm)
    found = {"planner": 0, "truth": 0}
    for _, row in goals.iterrows():
        goal = np.deg2rad(row[[f"q{j}_deg" for j in range(1, 7)]].to_numpy())
        arrived, path = search(field, start, goal, method == "improved")
        found["planner"] += arrived
        found["truth"] += arrived and is_free(field, path, has_table, pairs)
    table = published.table("tab02")
    rows = table[(table["control points"] == "elbow_wrist_flange") & (table["eta_0/zeta"] == 1.0)]
    there = rows[rows["method"] == method].iloc[0]
    assert {key: f"{found[key]}/{len(goals)}" for key in found} == {
        key: there[key] for key in found
    }


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
