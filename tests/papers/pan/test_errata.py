"""Proofs of `pan`: their values by computations of their own, and what would undo them."""

import numpy as np
import pytest
from evaluated_items import proved

from dualarm_repro.ledger import prove
from dualarm_repro.papers.pan.document import SEED, stand_in

QUICK = ("base_transform", "eq14_size", "constant_pose", "rank_condition", "ellipsoid_axes")


@pytest.fixture(scope="module")
def proofs():
    return {name: proved(f"pan.{name}") for name in QUICK}


@pytest.mark.parametrize("name", QUICK)
def test_proof_holds_and_shows_its_values(proofs, name):
    assert proofs[name].holds
    assert proofs[name].values


def test_base_by_both_readings(proofs):
    found = proofs["base_transform"].values
    assert found["as_pose"] == [1.0, -1.0, 0.05]
    assert found["as_labelled"] == [-1.0, 1.0, -0.05]


def test_size_of_the_block_matrix(proofs):
    """2m x 2n against 12 x (m + n): equal for m = n = 6 alone."""
    assert proofs["eq14_size"].values["size"] == "2*m x 2*n"
    for m in range(1, 9):
        for n in range(1, 9):
            assert ((2 * m, 2 * n) == (12, m + n)) is (m == n == 6)


def test_workpiece_has_to_turn_between_two_points(proofs):
    """The bisector leans by theta along the branch: the largest relative turn of all pairs."""
    from dualarm_repro.papers.pan.reading import FlatSeam

    R = FlatSeam(0.1, 0.06, 72, "bisector").rotations
    turns = [np.degrees(np.arccos(np.clip((np.trace(R[0].T @ one) - 1) / 2, -1, 1))) for one in R]
    assert proofs["constant_pose"].values["largest_turn_deg"] == pytest.approx(max(turns))
    assert max(turns) > 45


def test_measure_near_a_wrist_singularity(proofs):
    arm = stand_in("er16")
    q = arm.random_configurations(10_000, np.random.default_rng(SEED))[:100].copy()
    q[:, 4] = 1e-6
    J = arm.jacobian(q)
    assert (np.linalg.matrix_rank(J) == 6).all()
    largest = np.abs(np.linalg.det(J)).max()
    told = proofs["rank_condition"].values["largest_measure_there"]
    # determinants of nearly singular matrices keep four digits
    assert told == pytest.approx(largest, rel=1e-3)
    assert told < 1e-6  # sin q5 times what the arm can do at most


def test_eigenvalues_are_no_axes(proofs):
    found = proofs["ellipsoid_axes"].values
    singular, eigen = map(np.array, (found["singular_values"], found["absolute_eigenvalues"]))
    assert np.prod(singular) == pytest.approx(np.prod(eigen))
    assert singular[0] > eigen[0]  # no vector is stretched more than by the norm
    assert singular[-1] < eigen[-1]


@pytest.mark.parametrize(
    ("item", "printed", "name"),
    [
        ("pan.eq14", {"rows": "2*m", "columns": "2*n"}, "eq14_size"),
        ("pan.claim_bases", {"base1": ["-1.0", "1.0", "-0.05"]}, "base_transform"),
    ],
)
def test_another_print_would_need_no_erratum(registry, item, printed, name):
    with registry.with_printed(item, {**registry.printed(item), **printed}):
        assert not prove(registry, f"pan.{name}").holds
