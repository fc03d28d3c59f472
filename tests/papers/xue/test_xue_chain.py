"""Arms and arrangement of `xue` in plain numpy: the printed matrices, Table 1, edges and bars."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.ledger import evaluate
from dualarm_repro.ledger.reference import read_reference
from dualarm_repro.papers.xue import demands
from dualarm_repro.papers.xue.document import lengths, reach, slave_end, slave_start
from dualarm_repro.papers.xue.pages import scene
from dualarm_repro.papers.xue.pages.kinematics import chain, printed_chain
from dualarm_repro.papers.xue.pages.potentials import printed_field
from dualarm_repro.papers.xue.pages.table2 import statements
from dualarm_repro.papers.xue.reading import nominal
from dualarm_repro.papers.xue.studies import lottery, paths

#: a_{i-1}, alpha_{i-1}, d_i of the matrices, and column a of Table 1.
A = [0, 0.285, 1.024, 0.25, 0, 0]
A_PRINTED = [0.285, 1.024, 0.25, 0, 0, 0]
ALPHA = np.array([0, -1, 0, -1, 1, -1]) * np.pi / 2
D = [0, 0, 0, 1.225, 0, 0.225]
GOAL = np.pi * np.array([-1 / 2, -1 / 8, -1 / 2, 1 / 2, 1 / 4, 0])
angles = st.lists(st.floats(-3.1, 3.1), min_size=6, max_size=6).map(np.array)


def craig(a, alpha, d, theta):
    ca, sa, ct, s = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array([[ct, -s, 0, a], [s * ca, ct * ca, -sa, -d * sa],
                     [s * sa, ct * sa, ca, d * ca], [0, 0, 0, 1.0]])  # fmt: skip


def frames(q, a=A, alpha=ALPHA):
    pose, found = np.eye(4), [np.eye(4)]
    for row in zip(a, alpha, D, q, strict=True):
        pose = pose @ craig(*row)
        found.append(pose)
    return np.array(found)


@pytest.fixture(scope="module")
def stored(registry):
    """Obtained values of the reference, by item without the document."""
    return {k.partition(".")[2]: one["obtained"] for k, one in read_reference("xue").items()}


class TestChain:
    @settings(max_examples=20)
    @given(angles)
    def test_product_of_the_printed_matrices(self, registry, q):
        np.testing.assert_allclose(chain.symbolic_poses(q[np.newaxis])[0], frames(q)[-1],
                                   atol=1e-12)  # fmt: skip
        np.testing.assert_allclose(printed_chain.table_pose(q), frames(q, A_PRINTED)[-1],
                                   atol=1e-12)  # fmt: skip

    def test_goals_by_both_readings(self, stored):
        own = {"goal_matrices": frames(GOAL)[-1, :3, 3],
               "goal_table": frames(GOAL, A_PRINTED)[-1, :3, 3]}  # fmt: skip
        for name, point in own.items():
            np.testing.assert_allclose(stored["tab01"][name], point, atol=1e-12)
        gap = np.linalg.norm(own["goal_matrices"] - own["goal_table"])
        assert stored["tab01"]["goal_distance"] == pytest.approx(gap)

    def test_parameters_are_recovered_from_print(self, registry, stored):
        found = printed_chain.printed_parameters()
        assert found["a"] == pytest.approx(A)
        assert found["d"] == pytest.approx(D)
        assert found["alpha"] == pytest.approx(ALPHA.tolist())
        assert printed_chain.table_parameters()["a"] == pytest.approx(A_PRINTED)
        assert stored["tab01"]["a_one_row_up"] == pytest.approx(A_PRINTED)

    def test_origins_of_the_frames(self, stored):
        found = frames(np.zeros(6))[:, :3, 3]
        np.testing.assert_allclose(stored["fig02"]["origins"], found, atol=1e-12)
        np.testing.assert_allclose(stored["claim_master_start"]["tcp"], found[-1], atol=1e-12)
        np.testing.assert_allclose(stored["eq08"]["tcp_goal"], frames(GOAL)[-1, :3, 3], atol=1e-12)

    def test_mirrored_slave(self, stored):
        """Negated twists and angles: the reflection in y = 0."""
        tip = frames(-GOAL, A, -ALPHA)[-1, :3, 3]
        np.testing.assert_allclose(stored["claim_mirror"]["slave_goal"], tip, atol=1e-12)
        np.testing.assert_allclose(frames(GOAL)[-1, :3, 3] * [1, -1, 1], tip, atol=1e-12)

    def test_flanges_of_both_arms_as_drawn(self, registry, stored, monkeypatch):
        far = evaluate(registry, "xue.fig03", {"base_distance": 3.0, "display_posture": "goal"})
        tips = far.result.obtained["flanges"]
        half = np.array([0, 1.5, 0])
        np.testing.assert_allclose(tips["master"], frames(GOAL)[-1, :3, 3] + half, atol=1e-12)
        np.testing.assert_allclose(tips["slave"], np.array(tips["master"]) * [1, -1, 1],
                                   atol=1e-12)  # fmt: skip
        (y,) = {abs(point[1]) for point in stored["fig03"]["flanges"].values()}
        assert y == pytest.approx(0.5 * 2.51)

    def test_reach_is_that_of_the_straight_chain(self, registry):
        """a1 + a2 + hypot(a3, d4) + d6, which no random posture exceeds."""
        size, rng = lengths("matrices"), np.random.default_rng(4)
        straight = size["a1"] + size["a2"] + np.hypot(size["a3"], size["d4"]) + size["d6"]
        assert reach("matrices") == pytest.approx(straight, abs=1e-6)
        far = max(np.linalg.norm(frames(q)[-1, :3, 3]) for q in rng.uniform(-3.1, 3.1, (500, 6)))
        assert far <= straight
        assert lengths("published")["a2"] - size["a2"] == pytest.approx(1.15 - 1.024)

    def test_names_of_a_printed_pose(self, registry):
        matrix = registry.printed("xue.eq08")["matrix"]
        assert chain._names_entries(matrix)
        twice = [list(row) for row in matrix]
        twice[0][0] = twice[1][1]
        assert not chain._names_entries(twice)
        last = [list(row) for row in matrix]
        last[3][3] = "0"
        assert not chain._names_entries(last)

    def test_excess_of_the_start_over_its_limit(self, stored):
        # axis L of the maker turns to 76 deg in the document's zero of 90 deg
        assert stored["claim_master_start"]["excess_deg"] == pytest.approx(14.0)


class TestFields:
    """(9)-(15) by hand: k_a = 3, k_r = 1, d_0 = 0.3 m."""

    @settings(max_examples=30)
    @given(st.lists(st.floats(-3, 3), min_size=3, max_size=3).map(np.array))
    def test_attraction(self, registry, x):
        goal = np.array([0.5, -0.5, 1.0])
        by_hand = 1.5 * ((x - goal) ** 2).sum()
        assert printed_field.attraction(x, goal) == pytest.approx(by_hand, abs=1e-12)
        assert printed_field.attraction(x, goal, 2.0) == pytest.approx(by_hand * 2 / 3, abs=1e-12)

    @pytest.mark.parametrize("d", [0.01, 0.1, 0.29, 0.3, 0.31, 2.0])
    def test_repulsion(self, registry, d):
        by_hand = 0.5 * (1 / d - 1 / 0.3) ** 2 if d <= 0.3 else 0.0
        for item in ("eq10", "eq14"):
            found = printed_field.repulsion(item, np.full((1, 1, 1), d), nearest=False)
            assert found[0, 0] == pytest.approx(by_hand, abs=1e-12)

    def test_repulsion_of_several_shapes_adds_or_is_that_of_the_nearest(self, registry):
        distances = np.array([[[0.1, 0.2, 0.5]]])
        parts = [0.5 * (1 / d - 1 / 0.3) ** 2 for d in (0.1, 0.2)]
        for nearest, expected in ((False, sum(parts)), (True, parts[0])):
            found = printed_field.repulsion("eq10", distances, nearest=nearest)
            assert found == pytest.approx(expected)

    @pytest.mark.parametrize("d", [0.05, 0.2])
    def test_repulsive_force(self, registry, d):
        """k_r (1/d - 1/d_0) / d^2 times the gradient of the distance."""
        away = np.array([0.6, -0.8, 0.0])
        found = printed_field.repulsive_force(d, away)
        np.testing.assert_allclose(found, (1 / d - 1 / 0.3) / d**2 * away, rtol=1e-12)
        assert (printed_field.repulsive_force(0.4, away) == 0).all()

    @settings(max_examples=20)
    @given(angles, angles)
    def test_new_attraction(self, registry, theta, goal):
        x, target = np.array([0.1, 0.2, 0.3]), np.array([1.0, -1.0, 0.0])
        by_hand = 1.5 * (((x - target) ** 2).sum() + ((theta - goal) ** 2).sum())
        found = printed_field.new_attraction(x, target, theta, goal)
        assert found == pytest.approx(by_hand, rel=1e-12)

    def test_sum_over_the_points(self, registry):
        rows = np.arange(10.0).reshape(2, 5)
        np.testing.assert_allclose(printed_field.summed(rows), [10.0, 35.0])
        assert printed_field.summands() == 5.0
        np.testing.assert_allclose(printed_field.total(rows[0], rows[1]), rows.sum(axis=0))

    def test_what_is_no_number_agrees_with_nothing(self, registry):
        assert np.isnan(printed_field.difference(np.array([1.0, np.nan]), 1.0))
        assert printed_field.difference(np.array([1.0, 3.5]), np.array([2.0, 3.0])) == 1.0
        assert np.isnan(printed_field.value("eq09", 1, {"k_a": 1.0}))
        assert np.isnan(printed_field.value("eq09", 7, {}))


@pytest.fixture(scope="module")
def layout(registry):
    return nominal().layout


class TestArrangement:
    def test_points_of_the_arrangement(self, layout):
        base = np.array([layout.master_base_x, layout.master_base_y, layout.master_base_z])
        np.testing.assert_array_equal(layout.master_base, base)
        np.testing.assert_allclose(layout.slave_base, base - [0, layout.base_distance, 0])
        world = replace(layout, slave_frame="world")
        own = replace(layout, slave_frame="slave_base")
        np.testing.assert_array_equal(world.frame_origin, 0)
        np.testing.assert_array_equal(own.frame_origin, own.slave_base)
        for point, printed in zip(own.slave_points(), (slave_start(), slave_end()), strict=True):
            np.testing.assert_allclose(point - own.slave_base, printed)

    @pytest.mark.parametrize(
        ("name", "way"),
        [("x", [1, 0, 0]), ("y", [0, 1, 0]), ("chord", [-1.2, 0.45, 0])],
    )
    def test_normals_of_the_window(self, layout, name, way):
        np.testing.assert_allclose(replace(layout, window_normal=name).normal, way, atol=1e-12)

    @pytest.mark.parametrize(
        ("place", "inside"),
        [
            ([0.0, 0.0, 0.0], False),  # the middle of the opening
            ([0.0, 0.0, 0.55], True),  # the upper bar, 0.1 thick above half of 1.0
            ([0.0, 0.0, -0.55], True),
            ([0.0, 0.45, 0.0], True),  # a side bar beyond half of 0.8
            ([0.0, 0.45, 0.58], True),  # a corner
            ([0.06, 0.45, 0.0], False),  # in front of it
            ([0.0, 0.52, 0.0], False),  # beyond it
            ([0.0, 0.0, 0.62], False),
        ],
    )
    def test_a_bar_is_entered(self, layout, place, inside):
        made = replace(layout, window_normal="x", window_opening_width=0.8,
                       window_opening_height=1.0, window_bar=0.1)  # fmt: skip
        away = made.window_centre + np.array([5.0, 0, 0])
        track = np.array([away, made.window_centre + np.array(place), away])
        assert lottery.enters_bar(track, made) is inside
        assert lottery.enters_bar(np.array([away, away]), made) is False

    def test_distance_of_the_ends_from_the_edges(self, layout):
        """Start and End of 0.35 and 0.8 m, 0.5 and 0.15 m against edges made by hand."""
        made = replace(
            layout, slave_frame="world", window_normal="x", window_opening_width=1.0,
            window_opening_height=1.0, window_bar=0.1, window_centre_x=0.0, window_centre_y=0.0,
            window_centre_z=0.0,
        )  # fmt: skip
        across = np.abs([[0.35, 0.5], [0.8, 0.15]])
        edges = [0.5, 0.6]
        by_hand = min(abs(a - e) for row in across for a in row for e in edges)
        assert demands.from_edges(made) == pytest.approx(by_hand, abs=1e-12) == 0.0
        higher = replace(made, window_centre_z=0.3)
        across = np.abs([[0.35, 0.2], [0.8, -0.15]])
        by_hand = min(abs(a - e) for row in across for a in row for e in edges)
        assert demands.from_edges(higher) == pytest.approx(by_hand, abs=1e-12)

    def test_way_that_lies_ahead(self):
        track = np.array([[0.0, 0, 0], [1, 0, 0], [1, 3, 0], [1, 3, 0]])
        assert demands._ahead(track).tolist() == [1.0, 0.75, 0.0, 0.0]

    @pytest.mark.parametrize(
        ("found", "total"),
        [({}, 0.0), ({"a": 1.0, "b": 0.0}, 0.0), ({"a": -0.5, "b": 2.0, "c": -0.25}, -0.75)],
    )
    def test_failures_do_not_make_up_for_each_other(self, found, total):
        assert demands.failures(found) == total

    def test_neighbours_shift_one_number_at_a_time(self, layout):
        made = list(demands.neighbours(layout))
        assert len(made) == 2 * len(demands.SHIFTS)
        for name, other in made:
            (changed,) = [k for k in vars(layout) if getattr(layout, k) != getattr(other, k)]
            shift = getattr(other, changed) - getattr(layout, changed)
            assert abs(shift) == pytest.approx(demands.SHIFTS[changed])
            assert name == f"{changed} {shift:+.2g}"

    def test_shares_of_short_steps(self):
        steps = np.array([0.0, 0.1, 0.2, 0.25, 0.35])
        path = np.column_stack([steps, np.zeros(5)])
        assert scene._shortened(path, 0.1) == pytest.approx(0.25)
        assert scene._shortened(path, 0.05) == 0.0

    def test_a_path_that_first_backs_off(self):
        goal = np.array([1.0, 0.0, 0.0])
        back = np.array([[0.0, 0, 0], [-0.25, 0, 0], [1.0, 0, 0]])
        assert paths.farther_later(back, goal) == pytest.approx(0.25)
        assert paths.farther_later(back[::2], goal) == 0.0


class TestTimes:
    def test_printed_ratio(self, stored):
        told = stored["claim_times"]
        assert told["printed_ratio"] == pytest.approx(0.53 / 0.41)
        steps = told["mean_steps"]
        ratio = steps[told["longer"]] / min(steps.values())
        assert told["step_ratio"] == pytest.approx(ratio)
        assert told["by_reading"]["end_effector"]["successful"] == told["step_ratio"]

    @pytest.mark.parametrize(
        ("timed", "field"), [("successful", "steps_reached"), ("all", "steps_all")]
    )
    def test_runs_that_are_timed(self, registry, timed, field):
        from dualarm_repro.papers.xue.pages.table2.table import Trials
        from dualarm_repro.planning.trials.outcome import Outcome

        def made(**values):
            return Outcome(**{**dict.fromkeys(Outcome._fields, 0), **values})

        trials = Trials(made(steps_reached=10.0, steps_all=20.0),
                        made(steps_reached=float("nan"), steps_all=5.0))  # fmt: skip
        found = statements._steps(trials, timed)
        assert found["traditional"] == getattr(trials.traditional, field)
        assert found["improved"] == (None if timed == "successful" else 5.0)
        assert statements._steps(None, timed) == {"traditional": None, "improved": None}

    def test_needs_goal_angles_by_print(self, registry):
        assert statements.needs_goal_angles()
        printed = registry.printed("xue.eq13")
        with registry.with_printed("xue.eq13", {**printed, "formula": "U_aat^* = k_a*|X - X_g|^2"}):
            assert not statements.needs_goal_angles()


def test_attraction_off_the_goal_is_that_of_the_tolerance(stored):
    assert stored["claim_stop_zero"]["off_goal"] == pytest.approx(1.5 * 0.02**2)
    assert stored["claim_stop_zero"]["at_goal"] == 0.0
    assert stored["claim_stop_zero"]["at_trap"] > stored["claim_stop_zero"]["off_goal"]


def test_virtual_point_would_keep_the_arm_at_its_share_of_the_way(stored):
    """k_w / (k_w + k_a) of the way from goal to point, with 2 and 3."""
    assert stored["eq_virtual"]["rest_share"] == pytest.approx(0.4)


def test_overlap_of_both_clouds_is_told_alike(stored):
    for key in ("share_low", "share_high"):
        assert stored["fig06"][key] == stored["claim_overlap"][key]
    told = stored["claim_overlap"]
    assert told["volume_low"] < told["volume"] < told["volume_high"]
    for key in ("master_in_slave", "slave_in_master"):
        assert told["share_low"] < stored["fig06"][key] < told["share_high"]
