"""`pan` recomputed from its exported files alone: its published optimum and its witnesses."""

import numpy as np
import pytest
from exported import Export, columns, number
from welding_cell import Arm, Seam
from welding_job import OWNERS, Job, climbed


@pytest.fixture(scope="module")
def pan(files):
    return Export(files)


@pytest.fixture(scope="module")
def listed(pan):
    printed = pan.record("pan.claim_bases")["printed"]
    return np.array([[number(text) for text in printed[f"base{k}"]] for k in (1, 2, 3)])


def arm_of(pan, name, height=None):
    """An arm from the exported tables, the interpolated one with its shoulder where it is asked."""
    table, capsules = pan.table("pan.tab_none"), pan.table("pan.fig10")
    rows = table["arm"] == name
    angles = [
        np.radians(table[f"{key}_deg"][rows]) for key in ("alpha", "offset", "lower", "upper")
    ]
    a, d = table["a_m"][rows], table["d_m"][rows].copy()
    if height is not None and name == "er16":
        d[0] = height
    chosen = capsules["arm"] == name
    start = columns(capsules, *(f"start_{x}_m" for x in "xyz"))[chosen]
    end = columns(capsules, *(f"end_{x}_m" for x in "xyz"))[chosen]
    joint, radius = capsules["joint"][chosen].astype(int), capsules["radius_m"][chosen]
    start[(joint == 1) & (start[:, 2] < 0), 2] = -d[0]  # the column keeps its foot on the base
    links = list(zip(joint, start, end, radius, strict=True))
    return Arm((angles[0], a, d, angles[1], angles[2], angles[3]), links)


@pytest.fixture(scope="module")
def declared(pan):
    return pan.assumed("pan.claim_optimum") | {"singularity_threshold": 1e-3}


def job_of(pan, listed, given, points=None):
    return Job(arm_of(pan, given["arm"], given["shoulder_height"]), listed, given, points)


@pytest.fixture(scope="module")
def optimum(pan, listed, declared):
    """The published optimum: job, position, joints (3, N, 6) as exported, without the last row."""
    table = pan.table("pan.claim_joint_sequence")
    q = [np.radians(columns(table, *(f"{o} q{j} [deg]" for j in range(1, 7))))[:-1] for o in OWNERS]
    centre = np.array(pan.obtained("pan.claim_joint_sequence")["position"])
    return job_of(pan, listed, declared), centre, np.stack(q)


def test_seam(pan, declared):
    seam, table = (
        Seam(declared["radius_main"], declared["radius_branch"], 72),
        pan.table("pan.fig06"),
    )
    assert abs(seam.p - columns(table, *list(table)[-3:])).max() < 1e-12
    y, z = seam.p[:, 1], seam.p[:, 2]
    assert abs(y**2 + z**2 - declared["radius_main"] ** 2).max() < 1e-15


def test_bases(pan, listed):
    found = pan.obtained("pan.claim_bases")
    assert np.array_equal([found[f"base{k}"] for k in (1, 2, 3)], listed)


def test_joints_carry_the_job(optimum):
    """The exported joints put flanges and torch where workpiece and seam ask for them."""
    job, C, q = optimum
    for k in range(3):
        flange = job.bases[k] @ job.arm.frames(q[k])[:, 5]
        wanted = job.flanges[k].copy()
        wanted[:, :3, 3] += C
        assert abs(flange - wanted).max() < 1e-9
        assert (q[k] >= job.arm.lower).all()
        assert (q[k] <= job.arm.upper).all()


def test_the_exported_weld_is_a_turn_at_one_pace(pan, optimum):
    """Its times are those of the way along a dense seam, and it ends where it began."""
    job, _, q = optimum
    table, pace = pan.table("pan.claim_joint_sequence"), pan.record("pan.claim_joint_sequence")
    pace = _value(pace["thresholds"]["welding_speed"])
    assert len(table["time [s]"]) == job.count + 1
    assert np.allclose(table["time [s]"], table["seam [m]"] / pace)
    dense = Seam(job.of["radius_main"], job.of["radius_branch"], 100 * job.count).p
    ways = np.linalg.norm(np.diff(dense, axis=0, append=dense[:1]), axis=1).cumsum()
    assert table["seam [m]"][1:] == pytest.approx(ways[99::100], abs=1e-5)
    for k, owner in enumerate(OWNERS):
        last = [np.radians(table[f"{owner} q{j} [deg]"][-1]) for j in range(1, 7)]
        turns = (np.array(last) - q[k][0]) / (2 * np.pi)
        assert abs(turns - np.round(turns)).max() < 1e-9
        assert abs(np.diff(q[k], axis=0)).max() < np.pi / 2


def test_measures_and_fitness_of_the_optimum(pan, optimum):
    job, _, q = optimum
    w = np.stack(
        [abs(np.linalg.det(job.arm.jacobian(p, job.arm.frames(p)[:, 5, :3, 3]))) for p in q]
    )
    table = pan.table("pan.fig16")
    assert abs(w - [table[f"{owner}_m3"] for owner in OWNERS]).max() < 1e-9
    system = job.measure(q, w)
    assert abs(system - table["system"]).max() < 1e-9
    assert system.mean() == pytest.approx(pan.obtained("pan.claim_optimum")["fitness"], abs=1e-9)


def test_separations_of_the_optimum(pan, listed, declared, optimum):
    """By pairs of owners, on the dense seam of the item, with paths found here."""
    _, C, _ = optimum
    fine = job_of(pan, listed, declared, 720)
    q = np.stack([fine.path(robot, C)[0] for robot in range(3)])
    found, theirs = fine.separations(q, C), pan.obtained("pan.claim_constraints")["separations"]
    assert set(found) == set(theirs)
    for pair, value in theirs.items():
        assert found[pair] == pytest.approx(value, abs=1e-9), pair
    margin = min((q - fine.arm.lower).min(), (fine.arm.upper - q).min())
    # this seam is denser than that of the item: the margin is met between its points [deg]
    assert np.degrees(margin) == pytest.approx(
        pan.obtained("pan.claim_constraints")["joint_margin"], abs=0.5
    )


def test_paths_found_here_are_as_good(optimum):
    job, C, q = optimum
    for robot in range(3):
        own, w = job.path(robot, C)
        theirs = abs(
            np.linalg.det(job.arm.jacobian(q[robot], job.arm.frames(q[robot])[:, 5, :3, 3]))
        )
        assert abs(w - theirs).max() < 1e-9
        assert abs(own[:, :3] - q[robot][:, :3]).max() < 1e-9


def test_nothing_near_the_optimum_is_better(optimum):
    job, C, _ = optimum
    best = job.fitness(C)
    rng = np.random.default_rng(5)
    assert max(job.fitness(C + d) for d in rng.normal(scale=0.02, size=(12, 3))) < best


@pytest.mark.parametrize("most", [2, pytest.param(None, marks=pytest.mark.long)])
def test_witnesses(pan, listed, declared, most):
    """With each witness, or some, the printed point is feasible; a climb from it ends nearby."""
    record = pan.record("pan.claim_optimum")
    printed = np.array([number(text) for text in record["printed"]["C"]])
    limits = record["thresholds"]
    near, flat = (_value(limits[name]) for name in ("inside_branch", "three_digits"))
    witnesses = [one for one in record["witnesses"] if one["verdict"] == "holds"]
    assert witnesses
    order = np.random.default_rng(16).permutation(len(witnesses))
    for witness in (witnesses[k] for k in order[:most]):
        job = job_of(pan, listed, declared | witness["values"])
        at_print = job.fitness(printed)
        assert at_print > 0, witness["choice"]
        place, best = climbed(job, printed)
        gap = min(np.linalg.norm(place * [s, 1, 1] - printed) for s in (1, -1))
        assert gap <= near + 2e-3, witness["choice"]
        assert 1 - at_print / best <= flat, witness["choice"]


def _value(limit):
    return limit["value"] if isinstance(limit, dict) else limit
