"""Equation (16) of `pan` and its weights: ellipsoids, volumes and units by hand."""

import numpy as np
import pytest

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.pan.pages.measure import system as page
from dualarm_repro.welding.objective import cell_grams

BALL = 4 / 3 * np.pi


def turned(axes, seed):
    """R diag(axes^2) R^T with a random rotation R."""
    Q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return Q @ np.diag(np.square(axes)) @ Q.T


def test_volumes_by_their_semi_axes():
    axes = [(1.0, 2.0, 3.0), (0.5, 0.5, 4.0)]
    grams = np.array([turned(one, k) for k, one in enumerate(axes)])
    np.testing.assert_allclose(page._volumes(grams), [BALL * 6.0, BALL * 1.0], rtol=1e-12)
    flat = np.diag([1.0, 1.0, -1e-18])[np.newaxis]  # round-off below zero
    assert page._volumes(flat)[0] == 0.0
    twist = np.diag(np.arange(1.0, 7.0) ** 2)[np.newaxis]
    assert page._volumes(twist)[0] == pytest.approx(np.pi**3 / 6 * 720)


def test_merged_weights_of_the_carriers():
    ratios = np.array([[0.2, 0.4], [0.6, 0.1], [0.3, 0.3]])
    grams = np.array([[turned((1, 2, 3), 0)], [turned((2, 1, 1), 1)], [np.eye(3)]])
    common = np.array([0.7])
    np.testing.assert_allclose(page._merged("mean", ratios, grams, common), [0.4, 0.25])
    np.testing.assert_allclose(page._merged("sum", ratios, grams, common), [0.8, 0.5])
    both = np.linalg.inv(np.linalg.inv(grams[0, 0]) + np.linalg.inv(grams[1, 0]))
    volume = BALL * np.sqrt(np.linalg.det(both))
    np.testing.assert_allclose(page._merged("coupled_pair", ratios, grams, common),
                               [0.7 / volume])  # fmt: skip


@pytest.fixture(scope="module")
def grams(display):
    cell, jobs, _ = display
    return cell_grams(cell, jobs.q, 3)


def test_grams_are_those_of_the_reference_points(display, grams):
    """J J^T of the point of each robot, by pinocchio's Jacobian and the lever to the point."""
    cell, jobs, centre = display
    tips = cell.seam_in_world(centre)
    for robot in range(3):
        for n in (0, 31):
            q, base = jobs.q[0, robot, n], cell.bases[robot]
            flange = (base @ cell.arms[robot].fk(q))[:3, 3]
            J = cell.arms[robot].jacobian(q)
            v, w = base[:3, :3] @ J[:3], base[:3, :3] @ J[3:]
            point = tips[n] if robot == 2 else centre
            linear = v + np.cross(w.T, point - flange).T
            np.testing.assert_allclose(grams[robot, n], linear @ linear.T, atol=1e-9)


def test_volumes_and_axes_of_the_page(stored, grams):
    by_hand = BALL * np.sqrt(np.linalg.det(grams[:, 0]))
    assert stored["claim_beta_rule"]["volumes"] == pytest.approx(by_hand, rel=1e-9)
    axes = np.sqrt(np.linalg.eigvalsh(grams[:, 0]))[:, ::-1]
    np.testing.assert_allclose(stored["fig03"]["semi_axes"], axes, atol=1e-9)
    np.testing.assert_allclose(BALL * axes.prod(axis=1), by_hand, rtol=1e-9)


def test_intersection_by_another_quadrature(stored, grams):
    """(1/3) int r(u)^3 over the sphere, r the least of the three radii, by Gauss and trapezoids."""
    z, weight = np.polynomial.legendre.leggauss(300)
    angle = 2 * np.pi * np.arange(600) / 600
    side = np.sqrt(1 - z**2)[:, np.newaxis]
    u = np.stack(np.broadcast_arrays(side * np.cos(angle), side * np.sin(angle), z[:, None]), -1)
    inverse = np.linalg.inv(grams[:, 0])
    cubes = np.einsum("nmi,kij,nmj->knm", u, inverse, u).max(axis=0) ** -1.5 / 3
    volume = (weight @ cubes).sum() * 2 * np.pi / 600
    # kinks of the integrand between the ellipsoids limit both quadratures
    assert stored["claim_beta_rule"]["intersection"] == pytest.approx(volume, rel=5e-4)
    assert volume < min(stored["claim_beta_rule"]["volumes"])


def test_mean_share_of_the_carriers_is_that_of_inverse_volumes(stored, grams):
    inverse = 1 / (BALL * np.sqrt(np.linalg.det(grams)))
    carriers = inverse[:2].mean(axis=0)
    share = (carriers / (carriers + inverse[2])).mean()
    assert stored["claim_beta_rule"]["mean_share_of_carriers"] == pytest.approx(share, abs=1e-9)


def test_sampled_volume_is_within_its_error(stored):
    # three standard errors of a seeded draw
    assert stored["claim_beta_rule"]["monte_carlo"] < 3


def test_powers_of_the_unit_of_length(stored):
    """A measure of a 6 x 6 Jacobian has the unit m^3, the product of two of them m^6."""
    powers = stored["eq16"]["powers"]
    assert powers["M_loose"] == pytest.approx([3.0, 3.0], abs=1e-9)
    assert powers["M_tight"] == pytest.approx([6.0, 6.0], abs=1e-9)
    low, high = powers["MMR"]
    assert 3.0 < low < high < 6.0


def test_powers_of_other_prints(registry):
    """Printed as a geometric mean, all terms would be in m^3, and their mean, too."""
    printed = registry.printed("pan.eq15")
    mean = "M_tight = sqrt(sqrt(det(J_1*J_1^T)*det(J_2*J_2^T)))"
    with registry.with_printed("pan.eq15", {**printed, "formula": mean}):
        powers = page.unit_powers("er16")
    for name in ("M_tight", "M_loose", "MMR"):
        assert powers[name] == pytest.approx([3.0] * page._CASES, abs=1e-9)


def test_moved_by_unit_is_the_way_between_both_optima(stored):
    found = stored["eq16"]
    way = np.subtract(found["best_in_metres"], found["best_in_millimetres"])
    assert found["moved_by_unit"] == pytest.approx(np.linalg.norm(way), abs=1e-12)
    # mirror images as one: both at the positive side
    assert found["best_in_metres"][0] > 0 < found["best_in_millimetres"][0]
    assert stored["eq_opt"]["optimum"] == found["best_in_metres"]


@pytest.mark.parametrize(
    ("space", "count"), [("translational", 3), ("full", 6)]
)  # fmt: skip
def test_extreme_velocities_lie_on_the_ellipsoid_of_either_space(registry, space, count):
    found = evaluate(registry, "pan.fig03", {"ellipsoid_space": space})
    assert found.verdict is Verdict.REGENERATED
    assert found.result.obtained["fits"] < 1e-8
    assert np.shape(found.result.obtained["semi_axes"]) == (3, 3)


@pytest.mark.parametrize("reference", ["pipe_end", "own_flange"])
def test_the_point_of_the_carriers_moves_their_ellipsoids_alone(registry, stored, reference):
    found = evaluate(registry, "pan.fig03", {"carrier_reference": reference}).result.obtained
    before = stored["fig03"]["semi_axes"]
    assert np.abs(np.subtract(found["semi_axes"][:2], before[:2])).max() > 1e-2
    np.testing.assert_allclose(found["semi_axes"][2], before[2], atol=1e-12)
