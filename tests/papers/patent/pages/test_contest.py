"""The contests of `patent`: measures on motions made by hand, decays, and who is called sooner."""

import numpy as np
import pytest
from scipy import stats

from dualarm_repro.control.motion import JointLimits, Motion
from dualarm_repro.control.neural.network_settings import NetworkSettings
from dualarm_repro.control.neural.penalty import Penalty, penalty
from dualarm_repro.ledger import REGISTRY
from dualarm_repro.ledger.assumptions import alternatives
from dualarm_repro.papers.patent.document import CONTROL_STEP
from dualarm_repro.papers.patent.pages.contest import motion as motion_page
from dualarm_repro.papers.patent.pages.contest import robust, speed
from dualarm_repro.papers.patent.pages.network import decay
from dualarm_repro.papers.patent.pages.network import penalty as penalty_page
from dualarm_repro.settings import code

SEED = 20240057


def made(error=0.0, distance=0.1, acceleration=0.0, stopped=None):
    """A motion of ten steps of 1 ms, tips off by ``error`` (11,), links apart by ``distance``."""
    x = np.zeros((10, 2))
    x[5:, 0] = 1e-3 * acceleration
    limits = JointLimits(np.full(2, -3.0), np.full(2, 3.0), np.full(2, 2.0))
    errors = np.column_stack([np.broadcast_to(error, 11), np.zeros(11)])
    return Motion(
        1e-3, 1e-3 * np.arange(11), np.zeros((11, 2)), x, errors,
        np.broadcast_to(distance, 11).astype(float), np.zeros(10), np.zeros(10), limits, stopped,
    )  # fmt: skip


class TestRobust:
    def test_late_error_is_the_median_of_the_second_half(self):
        error = np.array([9.0, 9, 9, 9, 9, 1, 2, 3, 4, 5, 6]) * 1e-4
        assert robust._late(made(error)) == pytest.approx(3.5e-4)

    @pytest.mark.parametrize(
        ("measure", "own", "calm", "added"),
        [
            ("largest_tip_error", made(3e-4), made(1e-4), 2e-4),
            ("late_tip_error", made(3e-4), made(1e-4), 2e-4),
            ("late_residual", made(3e-4), made(1e-4), 3e-4),
            ("smallest_distance", made(distance=0.02), made(distance=0.05), 0.03),
            ("peak_acceleration", made(acceleration=7.0), made(acceleration=2.0), 5.0),
            # what a disturbance takes away is not added
            ("largest_tip_error", made(1e-4), made(3e-4), 0.0),
            ("smallest_distance", made(distance=0.05), made(distance=0.02), 0.0),
            ("peak_acceleration", made(acceleration=2.0), made(acceleration=7.0), 0.0),
        ],
    )
    def test_what_a_disturbance_adds(self, registry, measure, own, calm, added):
        assert robust._added(own, calm, measure) == pytest.approx(added, abs=1e-12)

    def test_motions_are_compared_instant_by_instant(self, registry):
        """Equal extremes at other times are no equal motions."""
        first, second = np.zeros(11), np.zeros(11)
        first[2], second[8] = 5e-4, 5e-4
        assert robust._added(made(first), made(second), "largest_tip_error") == pytest.approx(5e-4)

    def test_a_hardly_changed_late_error_is_the_calm_one(self, registry):
        noticeable = robust._noticeable()
        calm = made(1e-4)
        just, more = made((1 + 0.9 * noticeable) * 1e-4), made((1 + 1.1 * noticeable) * 1e-4)
        assert robust._left(just, calm) == 0.0
        assert robust._left(more, calm) == pytest.approx((1 + 1.1 * noticeable) * 1e-4)

    def test_a_motion_that_breaks_down_adds_without_bound(self, registry):
        for measure in robust.MEASURES:
            assert robust._added(made(stopped="diverged"), made(), measure) == np.inf

    @pytest.mark.parametrize(
        ("own", "other", "share"),
        [(1.0, 3.0, 0.5), (3.0, 1.0, -0.5), (0.0, 2.0, 1.0), (2.0, 0.0, -1.0), (0.0, 0.0, 0.0),
         (np.inf, 1.0, -1.0), (1.0, np.inf, 1.0), (np.inf, np.inf, 0.0)],
    )  # fmt: skip
    def test_advantage_of_the_network(self, own, other, share):
        assert robust._share(own, other) == share
        assert robust._share(other, own) == -share

    def test_interval_is_that_of_students_t(self):
        values = [0.1, 0.4, 0.2, 0.5]
        low, high = stats.t.interval(0.95, 3, np.mean(values), stats.sem(values))
        assert robust._interval(values) == pytest.approx(
            {"value": 0.3, "low": low, "high": high}, abs=1e-12
        )
        assert robust._interval([0.7]) == {"value": 0.7, "low": 0.7, "high": 0.7}

    @pytest.mark.parametrize("kind", ["state", "readings", "model"])
    def test_stored_advantage_is_that_of_what_is_added(self, stored, kind):
        told = stored[f"claim_robust_{kind}"]
        own, other = told["added_network"], told["added_primal_dual"]
        share = (other - own) / (other + own)
        # medians of four repeats against the mean of their shares
        assert told["advantage"]["value"] == pytest.approx(share, abs=2e-2)
        assert told["advantage"]["low"] <= told["advantage"]["value"] <= told["advantage"]["high"]

    def test_a_delay_is_the_same_every_time(self, stored):
        told = stored["claim_robust_delay"]["advantage"]
        assert told["low"] == told["value"] == told["high"]

    def test_every_size_is_an_assumption_of_its_item(self, registry):
        for kind, name in robust.SIZES.items():
            assert name in REGISTRY.look(f"patent.claim_robust_{kind}").assumptions
            assert kind in robust._TOLD
        choices = REGISTRY.declared("patent.robustness_measure", "choices").choices
        assert set(choices) == set(robust.MEASURES)
        kinds = REGISTRY.declared("patent.disturbance", "choices").choices
        assert set(kinds) == set(robust.SIZES)

    def test_the_general_statement_is_that_of_its_kind(self, stored, nominal):
        kind = nominal["disturbance"]
        assert stored["claim_robust"]["advantage"] == stored[f"claim_robust_{kind}"]["advantage"]

    def test_growing_gains_fight_a_constant_push(self, stored):
        """The stationary error under a push is the push over the gain: the ceiling leaves least."""
        sweep = stored["claim_robust_state"]["sweep"]
        peaks = [sweep[f"growing_{gamma}"]["peak"] for gamma in (10, 40, 80)]
        assert peaks == sorted(peaks, reverse=True)
        # the error of a slow network falls as one over its gain
        assert peaks[0] / peaks[1] == pytest.approx(4.0, rel=0.1)  # gains of 10 and 40

    def test_row_of_the_table(self):
        row = robust._row(made(2e-4, distance=0.04, acceleration=3.0))
        assert row == (True, 0.04, 2e-4, 2e-4, pytest.approx(3.0))
        assert len(row) == len(robust._COLUMNS)


class TestDecay:
    @pytest.mark.parametrize(
        ("errors", "threshold", "steps"),
        [
            ([1.0, 0.5, 0.2, 0.05, 0.01], 0.1, 3),
            ([1.0, 0.05, 0.5, 0.05, 0.01], 0.1, 3),  # for good
            ([0.01, 0.01], 0.1, 0),
            ([1.0, 0.1, 0.0], 0.1, 1),  # at the threshold is below it
        ],
    )
    def test_settled_means_for_good(self, errors, threshold, steps):
        assert decay.settled(np.array(errors), threshold) == pytest.approx(steps * CONTROL_STEP)

    @pytest.mark.parametrize("errors", [[1.0, 1.0], [0.01, 1.0], [0.01, np.nan]])
    def test_what_never_settles_takes_the_horizon(self, errors):
        assert decay.settled(np.array(errors), 0.1) == decay.HORIZON

    @pytest.mark.parametrize(
        ("activation", "slope"),
        [("linear", 1.0), ("tanh", 3.0), ("sinh", 3.0), ("bipolar_sigmoid", 2.0 / np.tanh(2.0)),
         ("power_sigmoid", 2.0 / np.tanh(2.0)), ("power", 1.0)],
    )  # fmt: skip
    def test_ceiling_of_the_gain(self, activation, slope):
        assert decay.gain_ceiling(activation) == pytest.approx(1000.0 / slope)

    @pytest.mark.parametrize(("gamma", "until"), [(1.0, 0.5), (10.0, 0.372), (80.0, 2.0)])
    def test_mean_gain_is_its_integral_over_the_time(self, gamma, until):
        """(1 / T) int min(gamma e^t, ceiling) dt, closed form, to a step."""
        reached = min(until, np.log(1000.0 / gamma))
        integral = gamma * np.expm1(reached) + 1000.0 * (until - reached)
        # left sums of steps of 1 ms
        assert decay.mean_gain("linear", gamma, until) == pytest.approx(integral / until, rel=2e-3)

    def test_linear_decay_is_the_product_of_its_steps(self, registry, stored):
        """|F| falls by 1 - gain dt a step while the network stands on a quadratic problem."""
        curve = decay.decay("linear", 10.0, "start")
        rate = -np.log(curve[200] / curve[50]) / (150 * CONTROL_STEP)
        # the Hessian of the penalty bends the decay a little
        assert rate == pytest.approx(-np.log(1 - 10.0 * CONTROL_STEP) / CONTROL_STEP, rel=2e-2)
        told = stored["claim_gain_time_varying"]
        threshold = REGISTRY.nominal("patent")["convergence_threshold"]
        assert told["constant_s"] == pytest.approx(decay.settled(curve, threshold))

    def test_growing_gain_arrives_when_its_integral_does(self, stored):
        """gamma (e^t - 1) reaches what the constant gain takes gamma t for, or nearly so."""
        told = stored["claim_gain_time_varying"]
        grown, constant = np.expm1(told["growing_s"]), told["constant_s"]
        assert grown == pytest.approx(constant, rel=1e-2)  # explicit steps of 1 ms
        assert told["sooner"] == pytest.approx(told["ceiling_s"] - told["growing_s"])
        assert told["ceiling"] == 1000.0

    def test_error_starts_at_the_drawn_size(self, registry):
        for kind in ("growing", "start", "ceiling"):
            curve = decay.decay("linear", 10.0, kind)
            drawn = np.random.default_rng(SEED).uniform(-decay.START, decay.START, len(curve))
            assert curve[0] <= decay.START
            assert curve[0] > 0.5 * np.abs(drawn[:10]).max()
            assert (np.diff(curve[:100]) <= 1e-12).all()


class TestSpeed:
    @pytest.mark.parametrize(
        ("own", "rival", "sooner"),
        [(1.0, 2.0, True), (2.0, 1.0, False), (1.0, 1.0, False), (1.0, None, True),
         (None, 1.0, False), (None, None, False), (0.0, 1.0, True)],
    )  # fmt: skip
    def test_who_is_sooner(self, own, rival, sooner):
        assert speed._sooner(own, rival) is sooner

    def test_declared_networks_cover_the_declared_ranges(self, registry):
        networks = speed.declared_networks()
        low, high = alternatives("patent.penalty_factor", 2)
        forms = alternatives("patent.penalty_form", 0)
        assert {one.penalty for one in networks} == set(forms)
        for form in forms:
            factors = [one.factor for one in networks if one.penalty == form]
            assert factors[0] == pytest.approx(low)
            assert factors[-1] == pytest.approx(high)
            np.testing.assert_allclose(np.divide(factors[1:], factors[:-1]), 10.0)
        assert {one.sharpness for one in networks} == {
            alternatives("patent.penalty_sharpness", 2)[1]
        }

    def test_tried_networks_are_counted(self, registry, stored):
        assert stored["claim_efficient"]["tried"] == len(speed.declared_networks())

    def test_iterations_looked_at(self):
        counts = speed._counts()
        assert counts[0] == 0
        assert counts[-1] == speed._MOST_ITERATIONS
        assert (np.diff(counts) > 0).all()
        assert set(range(10)) <= set(counts.tolist())

    def test_gain_integrals_become_times(self, registry, monkeypatch):
        """gamma (e^t - 1) = s for the growing gain, gamma t = s for the constant one."""
        own = np.where(speed._FLOW >= 5.0, 1e-9, 1.0)
        other = np.where(speed._LONG_FLOW >= 100.0, 1e-9, 1.0)
        monkeypatch.setattr(speed, "_flows", lambda: ([own], [other]))
        mine, rival = speed._flow_times(0, 1e-6, 10.0)
        assert mine == pytest.approx(np.log(1.5), abs=2e-2)  # a grid of 0.1 in the integral
        after = speed._LONG_FLOW[speed._LONG_FLOW >= 100.0][0]
        assert rival == pytest.approx(after / 10.0)
        never = np.ones_like(other)
        monkeypatch.setattr(speed, "_flows", lambda: ([own], [never]))
        assert speed._flow_times(0, 1e-6, 10.0)[1] is None

    def test_stored_contest_adds_up(self, stored):
        faster, cheap = stored["claim_faster"], stored["claim_efficient"]
        assert faster["sooner"]["of"] == faster["arrived"] == faster["primal_dual_arrived"]
        assert faster["operations_ratio"] > 1 < faster["time_ratio"]
        assert cheap["everywhere"] <= cheap["tried"]
        assert cheap["saved"] < 0 < cheap["exact_operations"]
        slow = stored["claim_pinv_slow"]
        # by normal equations the pseudo-inverse is the cheapest of the three
        assert slow["pseudo_inverse"] < min(slow["network_step"], slow["exact"])
        assert slow["slower"]["count"] == 0


class TestPenalty:
    @pytest.mark.parametrize(
        ("form", "factor"),
        [("quadratic", 10.0), ("squared_softplus", 10.0), ("softplus", 1.0), ("exponential", 0.1)],
    )
    def test_stiffer_moves_what_the_form_has(self, form, factor):
        network = NetworkSettings(penalty=form, factor=1e3, sharpness=50.0)
        stiff = penalty_page.stiffened(network, 10.0)
        assert stiff.factor == pytest.approx(1e3 * factor)
        assert stiff.sharpness == pytest.approx(500.0)
        assert stiff.penalty == network.penalty

    def test_stiffer_by_one_is_the_same(self):
        for form in Penalty:
            network = NetworkSettings(penalty=form)
            assert penalty_page.stiffened(network, 1.0) == network

    def test_declared_choices_take_ends_and_nominal_values(self, registry, stored):
        tried = penalty_page._declared()
        assert len(tried) == len(set(tried)) == stored["eq_penalty"]["tried"]
        for index, name in ((1, "penalty_factor"), (2, "penalty_sharpness")):
            low, high = alternatives(f"patent.{name}", 2)
            assert {one[index] for one in tried} == {low, REGISTRY.nominal("patent")[name], high}

    def test_quadratic_form_by_hand(self):
        kind = code(Penalty.QUADRATIC)
        for g, expected in ((2.0, (20.0, 20.0, 10.0)), (-1.0, (0.0, 0.0, 0.0))):
            assert penalty(kind, 10.0, 5.0, g) == pytest.approx(expected)

    @pytest.mark.parametrize("form", list(Penalty))
    def test_properties_of_every_form(self, form):
        found = penalty_page._properties(str(form), 1e3, 50.0)
        assert found["first_derivative"] < 1e-6
        assert found["slope"] >= 0 <= found["bend"]
        assert found["inside"] < 0.02  # e^-4, of an exponential e^-8

    def test_bias_is_inverse_to_the_stiffness(self, stored):
        bias = stored["eq_qp_penalized"]["bias"]
        ratios = np.divide(bias[:-1], bias[1:])
        # to first order in 1 / p
        np.testing.assert_allclose(ratios, 10.0, rtol=0.02)
        assert stored["eq_qp_penalized"]["bias_ratio"] == pytest.approx(ratios[0])
        # the multiplier follows the miss, and both fall alike
        assert stored["eq_penalty_defs"]["nearer"] == pytest.approx(0.01, rel=0.05)


def test_initial_states():
    zero, drawn = (motion_page._initial_state(name, 20) for name in ("zero", "random"))
    assert (zero == 0).all()
    np.testing.assert_array_equal(drawn, 0.1 * np.random.default_rng(SEED).normal(size=20))


@pytest.mark.parametrize(
    ("item", "key", "bound"),
    [("claim_accuracy", "tip_error", "accuracy_bound"),
     ("claim_real_time", "tip_error", "accuracy_bound")],
)  # fmt: skip
def test_shares_of_bounds(stored, nominal, item, key, bound):
    found = stored[item]
    assert found[f"{key}_share"] == pytest.approx(found[key] / nominal[bound], abs=1e-12)


def test_share_of_the_period(stored, nominal):
    told = stored["claim_real_time"]
    share = told["operations"] / nominal["operation_rate"] / nominal["time_step"]
    assert told["period_share"] == pytest.approx(share)
    both = stored["claim_vs_pinv"]
    assert both["network_operations"] == told["operations"]
    assert both["period_share"] == pytest.approx(
        max(both["qp_operations"], both["network_operations"])
        / nominal["operation_rate"]
        / nominal["time_step"]
    )


def test_the_frozen_crossing_is_the_same_in_every_statement(stored):
    assert stored["fig02"]["distance"] == stored["claim_vs_pinv"]["distance"]
    assert stored["fig02"]["naive_distance"] == stored["claim_vs_pinv"]["naive_distance"]
    assert stored["fig02"]["shortfall"] == pytest.approx(0.03 - stored["fig02"]["distance"])
    # between axes the distance is larger by both radii, which are 0.09 m here
    gap = stored["fig02"]["axis_distance"] - stored["fig02"]["distance"]
    assert gap == pytest.approx(0.18, abs=1e-9)
