"""Two of one arm: how far apart they stand, which postures are clear, and what a path is worth."""

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.planning import FoundPath
from dualarm_repro.scene import distances, links_of
from dualarm_repro.view import public_pair
from dualarm_repro.view.public_pair import (
    ROOM,
    SHARE,
    clear_alone,
    clear_postures,
    distance_of_bases,
    flange_reach,
    judged,
    two_of,
)


@pytest.fixture(scope="module")
def arm():
    return load_arm("irb120")


@pytest.fixture
def rng():
    return np.random.default_rng(4)


def test_bases_stand_so_far_apart_along_y(arm):
    scene = two_of(arm, 0.9)
    places = [one.placement.translation for one in scene.arms]
    np.testing.assert_allclose(places[0] - places[1], [0.0, 0.9, 0.0])
    np.testing.assert_allclose(np.sum(places, axis=0), 0.0, atol=1e-12)
    assert [one.name for one in scene.arms] == ["arm0", "arm1"]


def test_the_reach_is_that_of_the_farthest_posture(arm, rng):
    """Of an IRB 120: from axis 1 to the flange, stretched out."""
    reach = flange_reach(arm, rng)
    straight = max(
        float(np.linalg.norm(arm.joint_positions(q)[:, :2], axis=1).max())
        for q in arm.random_configurations(400, np.random.default_rng(1))
    )
    assert reach >= 0.97 * straight
    lengths = np.linalg.norm(np.diff(arm.joint_positions(np.zeros(6)), axis=0), axis=1).sum()
    assert reach <= lengths + 1e-9


def test_bases_are_apart_by_a_share_of_the_reach_or_by_what_stands(arm):
    seed = 6
    apart = distance_of_bases(arm, np.random.default_rng(seed))
    reach = flange_reach(arm, np.random.default_rng(seed))
    links = links_of(arm)
    still = links.joint == 0
    y, radius = links.local[still, :, 1], links.radius[still, np.newaxis]
    width = float((y + radius).max() - (y - radius).min()) if still.any() else 0.0
    assert apart == pytest.approx(max(SHARE * reach, width + ROOM if width else 0.0))


def test_postures_of_one_arm_are_clear_and_begin_at_home(arm, rng):
    found = clear_alone(arm, rng)
    assert 1 < len(found) <= 201
    scene = two_of(arm, 100.0)
    for q in found[:20]:
        both = np.concatenate([q, q])
        assert distances(scene, both).min() > ROOM
    assert arm.within_limits(found).all()


def test_postures_of_both_are_clear_and_the_first_is_that_of_both(arm, rng):
    single = clear_alone(arm, rng)
    scene = two_of(arm, 0.7)
    found = list(clear_postures(scene, single, rng))
    assert found
    assert all(distances(scene, q).min() > ROOM for q in found)
    first = np.concatenate([single[0], single[0]])
    if distances(scene, first).min() > ROOM:
        np.testing.assert_array_equal(found[0], first)
    rows = {tuple(row) for row in single}
    assert all(tuple(half) in rows for q in found for half in (q[:6], q[6:]))


@pytest.mark.parametrize("apart", [0.9, 0.25])
def test_a_report_never_promises_more_than_the_samples_keep(arm, apart, monkeypatch):
    """The straight line between two postures, far apart and through each other."""
    looked = []
    monkeypatch.setattr(public_pair, "mesh_distance", lambda scene, q: looked.append(q) or 0.125)
    scene = two_of(arm, apart)
    ends = np.array([np.zeros(12), np.tile([0.8, 0.3, 0.0, 0.0, 0.2, 0.0], 2)])
    found = judged(scene, FoundPath(ends, "reached"))
    rows = np.linspace(*ends, 200)
    least = float(distances(scene, rows).min())
    assert found["pair_lower"] <= least + 1e-9
    assert bool(found["pair_lower"] > 0.0) is (least > 0.0)
    assert found["pair_reached"]
    assert found["pair_meshes"] == 0.125
    assert not judged(scene, FoundPath(ends, "stuck"))["pair_reached"]
    np.testing.assert_allclose(looked[0][: public_pair.ROWS], np.linspace(*ends, public_pair.ROWS))
    nearest = distances(scene, looked[0][-1]).min()
    assert nearest <= least + 0.01, "where the certificate is tightest the meshes are looked at too"


def test_an_arm_that_cannot_move_has_no_task(arm, rng, monkeypatch):
    class Fixed:
        """Bounds that leave no room."""

        lower = upper = np.zeros(6)

    monkeypatch.setattr(public_pair, "distance_of_bases", lambda *_: 0.5)
    found = public_pair.planned_pair(Fixed(), rng)
    assert found["pair_reason"] == public_pair.FIXED
    assert found["pair_apart"] == 0.5
    assert found["pair_reached"] is None
    monkeypatch.setattr(public_pair, "clear_alone", lambda *_: np.zeros((1, 6)))
    assert public_pair.planned_pair(arm, rng)["pair_reason"] == public_pair.SELF


def test_arms_that_always_touch_are_moved_apart_in_vain(arm, rng, monkeypatch):
    tried = []
    plain = public_pair.two_of
    monkeypatch.setattr(public_pair, "two_of", lambda a, d: tried.append(d) or plain(a, d))
    monkeypatch.setattr(public_pair, "clear_postures", lambda *_: iter(()))
    monkeypatch.setattr(public_pair, "distance_of_bases", lambda *_: 0.8)
    found = public_pair.planned_pair(arm, rng)
    assert found["pair_reason"] == public_pair.OTHER
    assert tried == pytest.approx([0.8, 1.0, 1.2])
    assert found["pair_apart"] == pytest.approx(1.2)
    assert found["pair_reached"] is None
