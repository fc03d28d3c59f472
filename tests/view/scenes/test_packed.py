"""The short form of a scene gives back poses to a tenth of a millimetre."""

import base64
import json

import numpy as np
import pinocchio as pin

from dualarm_repro.arms import load_arm
from dualarm_repro.view.scene3d import Scene3D
from dualarm_repro.view.scenes.camera import framed
from dualarm_repro.view.scenes.packed import packed


def read(made):
    return json.loads(packed(made.contents, framed(np.ones(3), np.eye(3)), None))


def whole(text):
    return np.frombuffer(base64.b64decode(text), "<i2") / 32767


def test_poses_are_those_of_the_motion():
    arm = load_arm("irb120")
    path = np.linspace(0.9 * arm.lower, 0.9 * arm.upper, 20)
    made = Scene3D("one", camera=(1.0, 1.0, 1.0))
    made.add_arm("arm", arm, path[0])
    made.animate({"arm": (arm, path)}, every=1)
    motion = read(made)["motion"]
    rows = whole(motion["poses"]).reshape(len(motion["nodes"]), 20, 7)
    for k in (0, 7, 19):
        place, quaternion = rows[-1, k, :3] * motion["reach"], rows[-1, k, 3:]
        expected = pin.SE3(made.contents.motion.poses["arm/6"][k])
        np.testing.assert_allclose(place, expected.translation, atol=1e-4)
        turned = pin.Quaternion(quaternion / np.linalg.norm(quaternion))
        np.testing.assert_allclose(turned.matrix(), expected.rotation, atol=3e-4)


def test_equal_triangles_are_stored_once():
    arm, made = load_arm("panda"), Scene3D("two", camera=(1.0, 1.0, 1.0))
    for name in ("a", "b"):
        made.add_arm(name, arm, 0.5 * (arm.lower + arm.upper))
    data = read(made)
    meshes = [part["m"] for part in data["parts"] if part["k"] == "mesh"]
    assert sorted(set(meshes)) == list(range(len(data["meshes"])))
    assert all(meshes.count(k) >= 2 for k in meshes)
