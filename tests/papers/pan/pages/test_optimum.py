"""The optimum of `pan`: what is stored of its searches, the printed constraints, and its curves."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from dualarm_repro.arms.wrist_ik import inverse_kinematics
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.papers.pan.document import printed_optimum
from dualarm_repro.papers.pan.pages.optimum import curves, printed_point, problem, starts
from dualarm_repro.papers.pan.reading import Problem, solved, surveyed
from dualarm_repro.papers.pan.studies.consistency import CONSISTENCY, OBJECTIVES
from dualarm_repro.papers.pan.studies.fit import FIT
from dualarm_repro.welding import ROBOTS, Status
from dualarm_repro.welding.placement import statuses

PRINTED = np.array([0.023, -0.266, 0.404])


@pytest.fixture(scope="module")
def declared(nominal):
    return Problem.of(nominal)


def wilson_high(count, of, z=1.96):
    share = count / of
    middle = share + z**2 / (2 * of)
    spread = z * np.sqrt(share * (1 - share) / of + z**2 / (4 * of**2))
    return (middle + spread) / (1 + z**2 / of)


@pytest.mark.parametrize("objective", list(OBJECTIVES))
def test_shares_near_the_printed_point_by_counting(registry, objective):
    table, shares = CONSISTENCY.load(), printed_point.reading_table().loc[objective]
    for reading in ("inverted", "literal"):
        rows = table[table["base_transform"] == reading]
        points = rows[[f"{objective} {axis}" for axis in "xyz"]].to_numpy()
        apart = [float(np.sqrt(((p - PRINTED) ** 2).sum())) for p in points if np.isfinite(p).all()]
        for radius in (0.1, 0.15):
            near = sum(one <= radius for one in apart)
            assert shares[f"{reading} {radius}"] == pytest.approx(near / len(apart), abs=1e-12)
        assert shares[f"{reading} upper"] == pytest.approx(wilson_high(near, len(apart)), abs=1e-4)


def test_directed_search_of_a_reading_stands_in_its_row(registry):
    shares, climbs = printed_point.reading_table(), FIT.load()
    for _, climb in climbs.iterrows():
        column = f"{climb['base_transform']} search"
        assert shares.loc[climb["measure"], column] == climb["distance"]
    assert shares.loc["welder only"].filter(like="search").isna().all()


def test_searches_are_ordered_and_judged_by_both_thresholds(registry):
    limits = {n: t.value for n, t in REGISTRY.look("pan.claim_optimum").thresholds.items()}
    table = printed_point.searched()
    met = (table["distance"] <= limits["inside_branch"]) & (table["loss"] <= limits["three_digits"])
    assert (table["met"] == met).all()
    assert table["met"].is_monotonic_decreasing
    for _, part in table.groupby("met"):
        assert part["distance"].is_monotonic_increasing
    assert len(table) == len(FIT.load())


def test_witnesses_are_the_searches_that_met_print(registry, stored):
    found, table = printed_point.fitted(), FIT.load()
    assert len(found) == stored["claim_optimum"]["readings_with_witness"]
    assert stored["claim_optimum"]["readings_searched"] == len(table)
    assert {one["verdict"] for one in found} == {"holds"}
    for one in found:
        row = table[(table["distance"] == one["judged"]["distance"])].iloc[0]
        assert json.loads(row["values"]) == one["values"]
        assert one["choice"] == f"pan_fit {row['base_transform']}, {row['measure']}"
        assert one["values"]["base_transform"] == row["base_transform"]


def test_witnesses_lie_within_what_is_declared(registry):
    for one in printed_point.fitted():
        for name, value in one["values"].items():
            entry = REGISTRY.declared(f"pan.{name}", "value", "range", "choices")
            if entry.range is not None:
                assert entry.range[0] <= value <= entry.range[1]
            elif entry.choices is not None:
                assert value in entry.choices


def test_no_search_would_be_no_witness(registry, monkeypatch):
    far = FIT.load().assign(distance=1.0)
    monkeypatch.setattr(type(FIT), "load", lambda study: far)
    monkeypatch.setattr(printed_point, "searched", printed_point.searched.__wrapped__)
    assert printed_point.fitted() == []


def test_distance_to_print(stored):
    found = stored["claim_optimum"]
    assert found["distance"] == pytest.approx(np.linalg.norm(np.array(found["C"]) - PRINTED))
    assert found["C"] == stored["eq_opt"]["optimum"]
    assert found["fitness"] == stored["eq_opt"]["fitness"] == stored["claim_max_mmr"]["truth"]
    assert printed_optimum().tolist() == PRINTED.tolist()


def test_distance_to_the_edge_of_the_region(stored, nominal):
    best, box = np.array(stored["eq_opt"]["optimum"]), np.array(nominal["search_box"])
    edge = min(min(b - low, high - b) for b, (low, high) in zip(best, box, strict=True))
    assert stored["eq_opt"]["to_edge"] == pytest.approx(edge, abs=1e-12)


GIVEN = {
    "c": np.array([0.1, 0.2, 0.3]),
    "S": np.array([[0.0, 1.0], [0.0, 1.0], [0.3, 1.0]]),
    "theta": np.array([0.0, 1.0]),
    "theta_low": np.array([-1.0, 0.5]),
    "theta_high": np.array([1.0, 1.0]),
    "SD_min": 0.02,
}


@pytest.mark.parametrize(
    ("text", "changes", "met"),
    [
        ("c in S", {}, True),
        ("c in S", {"c": np.array([0.1, 0.2, 0.29])}, False),
        ("c in S", {"c": np.array([0.1, 1.01, 0.3])}, False),
        ("c in S", {"c": np.array([0.1, 0.2])}, False),
        ("c in T", {}, False),
        ("theta_low <= theta <= theta_high", {}, True),
        ("theta_low <= theta <= theta_high", {"theta": np.array([0.0, 0.4])}, False),
        ("theta_low <= theta <= theta_high", {"theta": np.array([1.1, 1.0])}, False),
        ("SD_min > 0", {}, True),
        ("SD_min > 0", {"SD_min": 0.0}, False),
        ("SD_min > 0", {"SD_min": -0.1}, False),
        ("apples > 0", {}, False),
        ("SD_min", {}, False),
    ],
)
def test_printed_constraints_one_by_one(text, changes, met):
    assert problem._met(text, {**GIVEN, **changes}) is met


@pytest.fixture(scope="module")
def best(stored):
    return tuple(stored["eq_opt"]["optimum"])


def test_values_of_the_names_in_the_constraints(declared, best):
    cell, jobs = declared.job.cell(), solved(declared.job, best)
    found = problem._given(cell, jobs, declared.box)
    low = [arm.lower for arm in cell.arms]
    np.testing.assert_allclose(found["theta_low"][:, 0], low)
    np.testing.assert_array_equal(found["c"], best)
    assert found["SD_min"] == pytest.approx(jobs.separation[0], abs=1e-12)
    assert found["min"](found["norm"](found["p"] - found["q"])) == pytest.approx(found["SD_min"])
    assert found["Rank"](found["J"]).min() == 6


def test_nearest_pairs_start_with_the_smallest_separation(declared, best, stored):
    cell, jobs = declared.job.cell(), solved(declared.job, best)
    pairs = problem._nearest_pairs(cell, jobs)
    assert pairs.is_monotonic_increasing
    assert pairs.iloc[0] == pytest.approx(jobs.separation[0], abs=1e-12)
    # a seam ten times as dense comes no farther, and hardly nearer
    for name, value in stored["claim_constraints"]["separations"].items():
        assert pairs[name] - 1e-3 < value <= pairs[name] + 1e-12


def test_shown_part_of_the_region_holds_what_is_feasible(declared, nominal):
    grid = surveyed(declared)
    shown = problem._shown(grid, declared.box)
    inside = grid.points[grid.fitness > 0]
    for points in (inside, PRINTED[np.newaxis]):
        assert (shown[:, 0] <= points).all()
        assert (points <= shown[:, 1]).all()
    assert (declared.box[:, 0] <= shown[:, 0]).all()
    assert (shown[:, 1] <= declared.box[:, 1]).all()
    # two cells of room
    room = np.minimum(inside.min(axis=0), PRINTED) - shown[:, 0]
    assert ((room >= 0.2 - 1e-9) | np.isclose(shown[:, 0], declared.box[:, 0])).all()


def test_shares_of_what_is_excluded_are_those_of_the_grid(declared, stored):
    status = surveyed(declared).status
    found = stored["claim_constraints"]["excluded"]
    names = {"joint angles within limits": Status.JOINT_LIMITS,
             "away from singularities": Status.SINGULAR, "no collision": Status.COLLISION,
             "inside the common workspace": Status.OUT_OF_REACH}  # fmt: skip
    for name, cause in names.items():
        assert found[name] == pytest.approx(np.mean(status == cause), abs=1e-12)
    feasible = stored["eq_opt"]["feasible_share"]
    assert sum(found.values()) + feasible == pytest.approx(1.0)


def test_a_path_of_lost_starts_adds_up(declared, stored):
    grid, found = surveyed(declared), stored["claim_bad_start"]
    assert found["share"] == pytest.approx(found["lost"] / found["begun"])
    alone = statuses(declared.job.cell(), grid.points)
    no_path = np.isin(alone, (Status.OUT_OF_REACH, Status.JOINT_LIMITS)).any(axis=1)
    assert found["begun"] - found["lost"] == (~no_path).sum()  # who has full paths has begun
    singular = ~no_path & (alone == Status.SINGULAR).any(axis=1)
    assert stored["claim_meets_singularity"]["singular"] == singular.sum()
    assert stored["claim_meets_singularity"]["with_paths"] == (~no_path).sum()
    paths = np.isin(grid.status, (Status.FEASIBLE, Status.COLLISION))
    assert stored["claim_meets_collision"]["with_paths"] == paths.sum()
    assert (paths == ~no_path & ~singular).all()


def test_a_robot_that_fails_does_not_hide_the_others(declared):
    """The survey names what fails first; where that is a singularity, others may have no path."""
    grid, cell = surveyed(declared), declared.job.cell()
    first = grid.points[grid.status == Status.SINGULAR]
    alone = statuses(cell, first)
    assert len(first) > 0
    assert (alone == Status.SINGULAR).any(axis=1).all()
    poses = cell.flanges[2][np.newaxis] + np.zeros((len(first), 1, 1, 1))
    poses = poses.copy()
    poses[..., :3, 3] += first[:, np.newaxis]
    flat = (np.linalg.inv(cell.bases[2]) @ poses).reshape(-1, 4, 4)
    free = np.full(6, np.inf)
    branches = inverse_kinematics(cell.geometries[2], flat, np.zeros(6), -free, free)
    reached = (~np.isnan(branches[..., 0])).any(axis=1).reshape(len(first), -1).all(axis=1)
    assert ((alone[:, 2] == Status.OUT_OF_REACH) | reached).all()


def test_contacts_by_pair(declared, stored):
    grid = surveyed(declared)
    points = grid.points[grid.status == Status.COLLISION]
    table = starts._contacts(declared.job, points[:24])
    assert len(table) == 24
    assert table.any(axis=1).all()  # that is why the search dropped them
    floor = [pair for pair in table if "floor" in pair]
    assert table[floor].any(axis=1).all()  # by the declared job, the floor alone
    found = stored["claim_meets_collision"]
    assert found["colliding"] + found["floor_alone"] == len(points)
    free = grid.points[grid.status == Status.FEASIBLE][:8]
    assert not starts._contacts(declared.job, free).to_numpy().any()
    none = starts._contacts(declared.job, points[:0])
    assert len(none) == 0
    assert list(none) == list(table)


class TestCurves:
    def test_table(self):
        w, system = np.arange(6.0).reshape(3, 2), np.array([7.0, 8.0])
        table = curves.curve_table(w, system, "theta")
        assert list(table) == ["theta", *[f"{name}_m3" for name in ROBOTS], "system"]
        assert table["theta"].tolist() == [0, 1]
        assert table["system"].tolist() == [7.0, 8.0]
        np.testing.assert_array_equal(table.iloc[:, 1:4].to_numpy().T, w)

    def test_another_joint_path_carries_elsewhere(self, declared, best):
        cell, jobs = declared.job.cell(), solved(declared.job, best)
        centre = np.array(best)
        assert curves._carried(cell, jobs, centre) < 1e-9
        bent = jobs.q.copy()
        bent[0, 2, 3, 0] += 1e-3
        # a milliradian at most at the reach of the arm, and not less than at the column
        moved = curves._carried(cell, replace(jobs, q=bent), centre)
        assert 2e-4 < moved < 2e-3
        assert curves._recomputed(cell, jobs) < 1e-12
        bent[0, 2, 3, 4] += 1e-2
        assert curves._recomputed(cell, replace(jobs, q=bent)) > 1e-6

    def test_where_the_welder_is_nearest_to_a_singularity(self, declared, best):
        cell, jobs = declared.job.cell(), solved(declared.job, best)
        cusp = curves._cusp(cell, jobs)
        assert cusp["point"] == jobs.w[0, 2].argmin()
        assert 0.3 < cusp["stretch"] < 1.0

    def test_largest_measure_of_the_arm_bounds_every_curve(self, registry, stored):
        largest = curves.largest_measure("er16")
        assert largest >= stored["tab_none"]["largest_measure"]
        share = stored["claim_near_zero_robot3"]["largest_share"]
        assert 0 < share < 1

    def test_poor_positions_are_those_of_the_statements(self, stored):
        assert stored["fig18"]["position"] == stored["claim_near_zero_robot3"]["position"]
        assert stored["fig19"]["position"] == stored["claim_unstable_b"]["position"]
        assert stored["fig18"]["mean_to_optimum"] < 1

    def test_curves_at_the_optimum(self, declared, best, stored):
        jobs = solved(declared.job, best)
        assert stored["fig16"]["smallest"] == pytest.approx(jobs.w[0].min(), abs=1e-9)
        low, high = stored["fig16"]["range"]
        assert low <= stored["eq_opt"]["fitness"] <= high
        span = np.degrees(np.ptp(jobs.q[0], axis=1))
        np.testing.assert_allclose(stored["fig17"]["span_deg"], span, atol=1e-6)
        cell = declared.job.cell()
        margins = [
            min((q - arm.lower).min(), (arm.upper - q).min())
            for arm, q in zip(cell.arms, jobs.q[0], strict=True)
        ]
        assert stored["fig17"]["joint_margin"] == pytest.approx(np.degrees(min(margins)), abs=1e-6)


def test_readings_drawn_are_all_optima(registry):
    clouds = dict(printed_point._clouds())
    table = CONSISTENCY.load()
    columns = [f"{name} x" for name in OBJECTIVES]
    for label, reading in (("matrix as pose of the base", "inverted"),
                           ("matrix as labelled", "literal")):  # fmt: skip
        rows = table.loc[table["base_transform"] == reading, columns]
        assert len(clouds[label]) == rows.notna().to_numpy().sum()
        assert isinstance(rows, pd.DataFrame)
