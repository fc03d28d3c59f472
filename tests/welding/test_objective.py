"""Readings of the measure and its weights, by hand and by what must not matter."""

from dataclasses import replace
from itertools import product

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.arm import Arm
from dualarm_repro.arms.robot_file import changed, load_robot_file
from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import InputError, UnknownNameError
from dualarm_repro.welding import Objective, Placement, closed_form, inverse_volumes
from dualarm_repro.welding.manipulability import weighted_measure

from .cells import make_cell

W = np.array([[2.0, 3.0], [0.5, 4.0], [1.0, 6.0]])
INVERSE = np.array([[1.0, 2.0], [3.0, 2.0]])


@pytest.mark.parametrize(
    ("reading", "system"),
    [
        ({"weights": "equal"}, [(1 + 1) / 2, (12 + 6) / 2]),
        ({"weights": "tight_only"}, [1.0, 12.0]),
        ({"weights": "loose_only"}, [1.0, 6.0]),
        ({"weights": "harmonic"}, [2 / (1 + 1), 2 / (1 / 12 + 1 / 6)]),
        ({"weights": "inverse_volume"}, [(1 * 1 + 3 * 1) / 4, (2 * 12 + 2 * 6) / 4]),
        ({"weights": "tight_only", "pair": "geometric_mean"}, [1.0, 12**0.5]),
        ({"weights": "loose_only", "unit": "mm"}, [1e9, 6e9]),
    ],
)
def test_measures_by_hand(reading, system):
    found = Objective(**reading).measures(W, INVERSE)
    np.testing.assert_allclose(found.system, system)


def test_a_seam_is_summed_up_by_its_mean_or_its_worst_point():
    values = np.array([[1.0, 2.0, 6.0], [4.0, 4.0, 1.0]])
    np.testing.assert_allclose(Objective().aggregate(values), [3.0, 3.0])
    np.testing.assert_allclose(Objective(aggregation="minimum").aggregate(values), [1.0, 1.0])


POSITIVE = st.floats(0.01, 100.0)


@settings(max_examples=40)
@given(tight=POSITIVE, loose=POSITIVE, first=POSITIVE, second=POSITIVE, factor=POSITIVE)
def test_a_weighted_measure_lies_between_and_only_the_ratio_of_weights_counts(
    tight, loose, first, second, factor
):
    found = weighted_measure(tight, loose, first, second)
    assert min(tight, loose) * (1 - 1e-12) <= found <= max(tight, loose) * (1 + 1e-12)
    assert weighted_measure(tight, loose, factor * first, factor * second) == pytest.approx(found)
    assert weighted_measure(factor * tight, factor * loose, first, second) == pytest.approx(
        factor * found
    )


def test_volumes_have_to_be_given_where_they_weigh():
    with pytest.raises(InputError, match=r"objective: inverse = None: expected inverse volumes"):
        Objective().measures(W, None)
    with pytest.raises(InputError, match="shape of inverse"):
        Objective().measures(W[None], INVERSE)
    assert not Objective(weights="equal").uses_volumes


@pytest.fixture(scope="module")
def job():
    cell = make_cell(count=12)
    jobs = Placement(cell, Objective()).jobs([[0.05, 0.1, 0.8]])
    assert jobs.feasible.all()
    return cell, jobs


@pytest.mark.parametrize("space", ["translational", "full"])
def test_readings_of_the_carriers_volumes_are_ordered(job, space):
    """The sum of two inverse volumes is twice their mean; the coupled pair is smaller than both."""
    cell, jobs = job
    mean, total, pair = (
        inverse_volumes(cell, jobs.q, space, one)[:, 0] for one in ("mean", "sum", "coupled_pair")
    )
    np.testing.assert_allclose(total, 2 * mean, rtol=1e-12)
    assert (pair > mean).all()
    welder = [inverse_volumes(cell, jobs.q, space, one)[:, 1] for one in ("mean", "coupled_pair")]
    np.testing.assert_array_equal(*welder)


@pytest.mark.parametrize(("field", "value"), [("space", "flat"), ("carriers", "both")])
def test_unknown_volumes_are_named(job, field, value):
    cell, jobs = job
    reading = {"space": "full", "carriers": "mean", field: value}
    with pytest.raises(UnknownNameError, match=f"inverse_volumes: {field} = '{value}'"):
        inverse_volumes(cell, jobs.q, **reading)


def turned(cell, pose):
    """The cell on bases moved together, its job turned with them."""
    R = pose.rotation
    flanges = cell.flanges.copy()
    flanges[..., :3, :3] = R @ flanges[..., :3, :3]
    flanges[..., :3, 3] = flanges[..., :3, 3] @ R.T
    return replace(
        cell,
        bases=pose.homogeneous @ cell.bases,
        rotations=R @ cell.rotations,
        flanges=flanges,
        references=cell.references @ R.T,
        torch_axis=cell.torch_axis @ R.T,
        floor=cell.floor + pose.translation[2],
    )


@pytest.mark.parametrize("seed", range(3))
def test_a_whole_cell_moved_on_its_floor_has_the_same_joints_and_fitness(job, seed):
    cell, jobs = job
    rng = np.random.default_rng(seed)
    pose = pin.SE3(pin.utils.rotate("z", rng.uniform(-3, 3)), rng.normal(size=3))
    there = Placement(turned(cell, pose), Objective())
    centres = jobs.centres @ pose.rotation.T + pose.translation
    found = there.jobs(centres)
    np.testing.assert_allclose(found.q, jobs.q, atol=1e-9)
    np.testing.assert_allclose(found.w, jobs.w, atol=1e-12)
    assert found.separation[0] == pytest.approx(jobs.separation[0], abs=1e-9)
    here = Placement(cell, Objective())
    assert there(centres)[0] == pytest.approx(here(jobs.centres)[0], rel=1e-9)


def scaled(name, factor):
    """An arm of a DH table with every length so many times as long."""
    robot = load_robot_file(data_path("robots", f"{name}.yaml"))
    joints = [changed(j, a=factor * j.a, d=factor * j.d) for j in robot.joints]
    return Arm.from_dh(f"{name}-{factor:g}", changed(robot, joints=joints, capsules=[]))


@pytest.mark.parametrize(("name", "factor"), list(product(["er16", "irb120"], [0.5, 3.0])))
def test_manipulability_scales_with_the_cube_of_the_arm(name, factor):
    """Three rows of the Jacobian are lengths, three are pure numbers."""
    plain, large = scaled(name, 1.0), scaled(name, factor)
    q = plain.random_configurations(50, np.random.default_rng(1))
    np.testing.assert_allclose(closed_form(large, q), factor**3 * closed_form(plain, q), rtol=1e-9)
    np.testing.assert_allclose(closed_form(plain, q), closed_form(load_arm(name), q), rtol=1e-9)
