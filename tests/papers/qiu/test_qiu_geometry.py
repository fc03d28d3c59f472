"""Arm, bases and goals of `qiu` with an arm of one's own: five lengths and six angles."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.qiu import document, ends
from dualarm_repro.papers.qiu.pages.field import forces
from dualarm_repro.papers.qiu.pages.geometry import task
from dualarm_repro.papers.qiu.studies import fit

D1, A2, A3, D4, D6 = 0.290, 0.270, 0.070, 0.302, 0.072
BASES = {"master": np.array([0.35, 0.0, 0.0]), "slave": np.array([-0.35, 0.0, 0.0])}
SPHERES = np.array([[-0.1, 0.2, 0.75], [-0.1, -0.03, 0.95]])


def turn(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    return {
        "z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]),
        "y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "x": np.array([[1, 0, 0], [0, c, -s], [0, s, c]]),
    }[axis]


def flange(q):
    """Upright at zero: z, y, y, x, y, x with the offsets of the maker's drawing."""
    R, p = np.eye(3), np.zeros(3)
    for axis, angle, before in zip(
        "zyyxyx", q, ([0, 0, D1], [0, 0, 0], [0, 0, A2], [0, 0, A3], [D4, 0, 0], [0, 0, 0]),
        strict=True,
    ):  # fmt: skip
        if axis == "z":
            R = R @ turn(axis, angle)
            p = p + R @ np.array(before)
            continue
        p = p + R @ np.array(before)
        R = R @ turn(axis, angle)
    return p + R @ np.array([D6, 0, 0]), R


@pytest.mark.parametrize("seed", range(4))
def test_flange_by_its_own_chain(registry, seed):
    arm = document.placed("master").arm
    q = arm.random_configurations(5, np.random.default_rng(seed))
    for one in q:
        point, _ = flange(one)
        np.testing.assert_allclose(arm.fk(one)[:3, 3], point, atol=1e-12)


def test_reach_is_the_straight_arm(registry, stored):
    reach = A2 + np.hypot(A3, D4) + D6
    assert document.reach() == pytest.approx(reach, abs=1e-12)
    assert stored["claim_overlap"]["reach"] == pytest.approx(reach, abs=1e-12)
    assert stored["claim_overlap"]["overlap"] == pytest.approx(2 * reach - 0.7, abs=1e-12)
    assert stored["claim_goal"]["reach"] == pytest.approx(reach, abs=1e-12)
    assert document.full_step() == pytest.approx(0.05 * reach)


def test_printed_goal_is_beyond_the_straight_arm(registry, stored):
    shoulder = BASES["master"] + [0, 0, D1]
    told = stored["claim_goal"]
    assert document.shoulder_to_goal() == pytest.approx(told["printed_distance"])
    goal = document.PRINTED.master_goal
    assert np.linalg.norm(goal - shoulder) == pytest.approx(told["printed_distance"])
    assert told["beyond_reach"] == pytest.approx(told["printed_distance"] - told["reach"])


@pytest.mark.parametrize("yaw", [0, 90, 180, 270])
def test_gap_of_the_start_tip_by_turn(registry, stored, yaw):
    tip, _ = flange(np.zeros(6))
    world = BASES["master"] + turn("z", np.deg2rad(yaw)) @ tip
    gap = np.linalg.norm(world - [0.35, 0.38, 0.62])
    assert task.gap_by_turn()[yaw] == pytest.approx(gap, abs=1e-12)
    assert stored["fig03"]["gap_by_turn"][str(yaw)] == pytest.approx(gap, abs=1e-12)


def test_start_tips_against_the_printed_digits(stored):
    """0.374 and 0.630 m where 0.38 and 0.62 are printed, to the centimetre or the millimetre."""
    tip = stored["claim_start"]["tcp"]
    np.testing.assert_allclose(tip, [0.35, D4 + D6, D1 + A2 + A3], atol=1e-12)
    assert stored["claim_start"]["gap"] == pytest.approx(np.hypot(0.006, 0.010), abs=1e-12)
    assert stored["claim_start"]["beyond_digits"] == pytest.approx(0.0095, abs=1e-9)


@pytest.mark.parametrize("name", ["about_x", "in_yz"])
def test_mirrors_of_base_and_tip(stored, name):
    signs = {"about_x": [1, -1, -1], "in_yz": [-1, 1, 1]}[name]
    told = stored["claim_symmetric"]
    master, slave = BASES.values()
    assert told[name] == pytest.approx(np.linalg.norm(master * signs - slave), abs=1e-12)
    tips = [base + np.array([0, 0.38, 0.62]) for base in (master, slave)]
    gap = np.linalg.norm(tips[0] * signs - tips[1])
    assert told[f"{name}_tip"] == pytest.approx(gap, abs=1e-12)


def test_distances_of_the_goal_to_the_spheres(stored, registry):
    goal = document.PRINTED.master_goal
    gaps = np.linalg.norm(SPHERES - goal, axis=1) - 0.1
    assert stored["claim_obstacles"]["goal_to_surface"] == pytest.approx(gaps.tolist())
    assert stored["claim_obstacles"]["centres"] == SPHERES.tolist()
    assert document.goal_to_surface() == pytest.approx(gaps)


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ([0.0, 0, 0], [0.1, 0, 0], 0.1),
        ([np.pi - 0.05, 0, 0], [-np.pi + 0.05, 0, 0], 0.1),  # the shorter way
        ([0, 2 * np.pi, 0], [0, 0, 0], 0.0),
        ([0, 0, 1.0], [0, 0, -1.0], 2.0),
    ],
)
def test_difference_of_postures(one, other, expected):
    assert task._turned(np.array(one), np.array(other)) == pytest.approx(expected, abs=1e-12)
    assert task._turned(np.array(other), np.array(one)) == pytest.approx(expected, abs=1e-12)


def test_a_posture_that_only_one_arm_has_is_no_agreement():
    assert task._turned(None, np.zeros(6)) == np.inf
    assert task._turned(np.zeros(6), None) == np.inf


def test_start_postures_reach_the_printed_tips(registry, stored):
    tips = {"master": np.array([0.35, 0.38, 0.62]), "slave": np.array([-0.35, 0.38, 0.62])}
    count = 0
    for name, postures in task.start_postures().items():
        back = turn("z", np.deg2rad(90))
        for (_, wrist), q in postures.items():
            if q is None:
                continue
            count += 1
            np.testing.assert_allclose(BASES[name] + back @ flange(q)[0], tips[name], atol=1e-9)
            np.testing.assert_allclose(q[3:], wrist, atol=1e-12)
    assert count == 2 * stored["claim_same_posture"]["reached"]


@pytest.mark.parametrize("shift", [-0.7, -0.6, 0.7])
def test_the_translation_of_the_bases_is_the_printed_one(registry, shift):
    found = evaluate(registry, "qiu.eq03", {"base_translation": shift})
    assert found.result.obtained["miss"] == pytest.approx(abs(shift + 0.7), abs=1e-12)
    assert found.verdict.meets_print is (shift == -0.7)


@pytest.mark.parametrize("yaw", [0, 180, 270])
def test_another_turn_of_the_bases_is_farther_from_print(registry, yaw):
    found = evaluate(registry, "qiu.fig03", {"base_yaw": yaw})
    assert found.verdict is Verdict.NOT_REPRODUCED
    assert found.result.obtained["turn_nearest_to_print"] is False


@pytest.mark.parametrize("change", ["a2", "a3", "d4", "d6"])
def test_a_longer_link_reaches_farther(registry, nominal, change):
    lengths = {**nominal["link_lengths"]}
    lengths[change] += 0.01
    found = evaluate(registry, "qiu.claim_overlap", {"link_lengths": lengths}).result.obtained
    reach = lengths["a2"] + np.hypot(lengths["a3"], lengths["d4"]) + lengths["d6"]
    assert found["reach"] == pytest.approx(reach)


class TestForces:
    @pytest.mark.parametrize("rho", [0.05, 0.1, 0.2, 0.39])
    def test_textbook_force_is_the_slope_of_its_potential(self, registry, rho):
        """F = eta (1 / rho - 1 / rho_0) / rho^2 with the printed 1000 and 0.4 m."""
        force = 1000 * (1 / rho - 1 / 0.4) / rho**2
        assert forces.repulsion("textbook", rho) == pytest.approx(force, rel=1e-9)
        assert forces.repulsion("inverse", rho) == pytest.approx(1000 / rho)

    def test_slopes_on_logarithmic_axes_by_hand(self, stored):
        """ln F = ln(1 / rho - 1 / rho_0) - 2 ln rho, differenced about two of the points."""
        told = stored["claim_inverse"]["slope"]
        rho = np.geomspace(0.02, 0.98, 97) * 0.4
        force = np.log(1 / rho - 1 / 0.4) - 2 * np.log(rho)
        step = np.log(rho[2] / rho[0])
        assert told["near"] == pytest.approx((force[2] - force[0]) / step, rel=1e-9)
        assert told["far"] == pytest.approx((force[-1] - force[-3]) / step, rel=1e-9)
        # and near the sphere that is the derivative, -2 - rho_0 / (rho_0 - rho)
        assert told["near"] == pytest.approx(-2 - 0.4 / (0.4 - rho[1]), abs=1e-4)

    def test_bounds_of_the_attraction(self, stored):
        bounds = stored["eq06"]["bounds"]
        assert bounds["norm"] == pytest.approx(0.4 * 1000)
        assert bounds["per_joint"] == pytest.approx(0.4 * 1000 * np.sqrt(6))

    def test_postures_lie_about_the_way_to_the_goal(self, registry):
        goal = np.array([2.0, 0.5, -0.9, 0, 0, 0])
        q = forces._postures(goal)
        share = q @ goal / (goal @ goal)
        # draws of 0 to 0.45 and a spread of 0.1 rad
        assert -0.2 < share.min() < share.max() < 0.65
        off = q - share[:, np.newaxis] * goal
        assert off.std() == pytest.approx(0.1, rel=0.15)  # of 240 draws


class TestEnds:
    """Halves of a search made by hand: five postures each, one step of 0.05 rad apart."""

    @pytest.fixture
    def plan(self):
        forward = np.zeros((5, 6))
        forward[:, 0] = 0.05 * np.arange(5)
        backward = np.zeros((5, 6))
        backward[:, 0] = 0.5 - 0.03 * np.arange(5)
        settings = SimpleNamespace(ending=SimpleNamespace(tolerance=0.1))
        return SimpleNamespace(
            ends=[np.array([0.1, 0.0, 0.5]), np.array([0.1, 0.03, 0.54])],
            record=SimpleNamespace(paths=(forward, backward)),
            problem=SimpleNamespace(start=np.zeros(6), goal=np.array([0.5, 0, 0, 0, 0, 0]),
                                    settings=settings),
            reason="reached", searches=4, reached=True,
        )  # fmt: skip

    def test_outcome(self, registry, plan):
        printed = np.array([[0.1, 0.0, 0.6], [0.1, 0.03, 0.54]])
        found = ends.outcome(plan, printed, np.array([5.0, 5.0]))
        assert found["mean_step_over_alpha0"] == pytest.approx((0.05 + 0.03) / 2 / 0.05)
        assert found["least_mean_step_over_alpha0"] == pytest.approx((0.5 - 0.1) / 10 / 0.05)
        assert found["gap_tip"] == pytest.approx(0.05)
        assert found["distance_to_print"] == pytest.approx([0.1, 0.0])
        assert (found["reason"], found["searches"]) == ("reached", 4)

    def test_met_and_counted(self, registry, plan):
        printed = np.array([[0.1, 0.0, 0.6], [0.1, 0.0, 0.56]])
        face = ends.outcome(plan, printed, np.array([5.0, 5.0]))
        found = ends.met(face, {"searches": 7}, printed)
        assert found["printed_gap_tip"] == pytest.approx(0.04)
        step = document.full_step()
        assert found["steps_from_print"]["forward"] == pytest.approx(0.1 / step)
        assert found["joined"] is True
        failed = ends.met({**face, "reason": "trapped"}, {}, printed)
        assert failed["joined"] is False

    def test_halves_are_named_in_order(self):
        assert ends.by_half([1, 2]) == {"forward": 1, "backward": 2}
        assert [rule.key for rule in ends.count_rules("x")] == ["forward", "backward", "joined"]
        assert [rule.key for rule in ends.meeting_rules("x")][-1] == "joined"

    def test_near_is_a_threshold_in_steps(self, registry):
        steps = registry.look("qiu.claim_bi_meet").thresholds["near"].value
        assert ends.near_print("qiu.claim_bi_meet") == pytest.approx(steps * document.full_step())

    @pytest.mark.parametrize("name", ["fit", "fit_slave"])
    def test_tally_of_the_stored_fit(self, rows, stored, name):
        table = rows(name)
        item = {"fit": "claim_bi_counts", "fit_slave": "claim_slave_counts"}[name]
        told = stored[item]["fit"]
        for key in ("tried", "joined", "counted"):
            assert told[key] == sum(row[key] for row in table)
        for key, column in (("nearest", "nearest"), ("calibrated", "error")):
            known = [r[column] for r in table if r[column] is not None and r[column] == r[column]]
            assert told[key] == pytest.approx(min(known))

    def test_the_witness_of_a_fit_is_its_best_cell(self, registry):
        table = fit.FIT.load()
        best = float(table["error"].min())
        (near,) = ends.fit_witness(table, best)
        (far,) = ends.fit_witness(table, 0.5 * best)
        assert (near["verdict"], far["verdict"]) == ("holds", "fails")
        assert near["values"]["error"] == best

    def test_a_tally_keeps_the_nearest_of_those_that_count(self, registry, plan):
        goal = np.array([plan.ends[0], plan.ends[1]])
        found = fit.Tally(goal, 4)
        off = SimpleNamespace(**{**vars(plan), "ends": [goal[0] + [0.02, 0, 0], goal[1]]})
        lost = SimpleNamespace(**{**vars(plan), "reached": False})
        other = SimpleNamespace(**{**vars(plan), "searches": 5})
        for one, chosen in ((off, "off"), (lost, "lost"), (other, "other"), (off, "again")):
            found.take(one, {"gain_ratio": chosen})
        assert {k: found.row[k] for k in ("tried", "joined", "counted")} == {
            "tried": 4, "joined": 3, "counted": 2,
        }  # fmt: skip
        assert found.row["nearest"] == pytest.approx(0.0)  # joined, though of another number
        assert found.row["error"] == pytest.approx(0.02)
        assert found.row["gain_ratio"] == "off"  # the first of equal ones
        assert found.row["mean_step_over_alpha0"] == pytest.approx(0.8)
        found.take(plan, {"gain_ratio": "exact"})
        assert found.row["gain_ratio"] == "exact"

    @pytest.mark.parametrize(
        ("value", "read"),
        [("[0, 0.8, 0]", [0, 0.8, 0]), ("front_deep", "front_deep"), (1, 1.0), (2.5, 2.5)],
    )
    def test_values_of_a_table_as_those_of_the_yaml(self, value, read):
        assert fit._read(value) == read

    def test_grids(self):
        made = fit.combinations(a=[1, 2], b=["x", "y", "z"])
        assert len(made) == 6
        assert made[1] == {"a": 1, "b": "y"}


def test_volume_and_corners_of_the_moving_hull_are_stored_alike(stored):
    told = stored["fig09"]
    assert isinstance(told["vertices"], int)
    # of a triangulated convex body: F = 2 V - 4
    assert told["faces"] == 2 * told["vertices"] - 4
    corners = ConvexHull(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]]))
    assert len(corners.simplices) == 2 * len(corners.vertices) - 4


def test_errors_of_the_printed_ends(stored):
    """Ends 13.4 and 25.7 steps of 0.0326 m away, as distances in metres and in steps."""
    for item in ("claim_bi_meet", "claim_slave_meet"):
        told = stored[item]
        steps = [told["steps_from_print"][half] for half in ("forward", "backward")]
        np.testing.assert_allclose(np.array(told["distance_to_print"]) / 0.05
                                   / (A2 + np.hypot(A3, D4) + D6), steps, rtol=1e-9)  # fmt: skip
        gap = np.subtract(told["forward"], told["backward"])
        assert told["gap_tip"] == pytest.approx(np.linalg.norm(gap))
