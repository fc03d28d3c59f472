"""Poses of nodes: what moves has those of the key frames, the rest stays."""

import numpy as np

from dualarm_repro.view.scenes.contents import WORLD, Contents, Motion


def shifted(x):
    pose = np.eye(4)
    pose[0, 3] = x
    return pose


def made():
    contents = Contents("t", np.ones(3), grid=True)
    contents.nodes |= {"arm/1": shifted(1.0), "rock": shifted(5.0)}
    contents.motion = Motion(
        np.array([0, 2]), 20, {"arm/1": np.array([shifted(1.0), shifted(2.0)])}
    )
    return contents


def test_a_node_moves_if_it_is_in_the_motion():
    contents = made()
    assert contents.pose("arm/1", 1)[0, 3] == 2.0
    assert contents.pose("arm/1")[0, 3] == 1.0
    assert contents.pose("rock", 1)[0, 3] == 5.0
    assert [pose[0, 3] for pose in contents.poses("arm/1")] == [1.0, 2.0]
    assert [pose[0, 3] for pose in contents.poses("rock")] == [5.0]
    np.testing.assert_array_equal(contents.pose(WORLD, 1), np.eye(4))


def test_without_motion_a_frame_changes_nothing():
    contents = made()
    contents.motion = None
    assert contents.pose("arm/1", 1)[0, 3] == 1.0


def test_scenes_share_nothing():
    one, other = (Contents("t", np.ones(3), grid=False) for _ in range(2))
    one.nodes["x"] = np.eye(4)
    one.parts.append(None)
    assert "x" not in other.nodes
    assert other.parts == []
