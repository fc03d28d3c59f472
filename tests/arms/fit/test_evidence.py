"""Pairs left out by evidence, parts that are never left out, and the cache of what was found."""

import numpy as np
import pytest

from dualarm_repro.arms import Evidence, load_arm
from dualarm_repro.arms.exclusions import shape_of
from dualarm_repro.scene import PlacedArm, Scene, distances

from ..urdf.texts import joint, link, write

BALL = "<sphere radius='{}'/>"


def arm_of(folder, *radii, gap=0.3, swing=2.5):
    """Links with a ball at each joint origin, ``gap`` apart in a plane."""
    names = [f"l{k}" for k in range(len(radii))]
    limit = f"<limit lower='{-swing}' upper='{swing}' effort='1' velocity='1'/>"
    parts = [link(n, BALL.format(r), origin="") for n, r in zip(names, radii, strict=True)]
    for k in range(len(radii) - 1):
        text = joint(f"j{k}", names[k], names[k + 1], axis="0 1 0", limit=limit)
        parts.append(text.replace("xyz='0 0 0.3' rpy='0.1 0.2 0.3'", f"xyz='0 0 {gap}'"))
    return load_arm(write(folder, *parts))


def pairs(arm):
    """Names of the watched pairs."""
    scene = Scene([PlacedArm("a", arm)])
    return {tuple(n.removeprefix("a/") for n in pair) for pair in scene.pairs.names}


def test_what_always_touches_is_left_out_and_listed(tmp_path):
    """Two balls two joints and at most 0.6 m apart whose radii add up to 0.7 m."""
    arm = arm_of(tmp_path, 0.4, 0.01, 0.3)
    (one,) = [e for e in arm.exclusions if e.evidence is not Evidence.ADJACENT]
    assert (one.first, one.second, one.evidence) == ("l0_0", "l2_0", Evidence.ALWAYS)
    assert one.touching == one.sampled == 2000
    assert str(one).startswith("l0_0 - l2_0: always, shapes touch in 2000")
    assert pairs(arm) == set()


def test_what_touches_now_and_then_stays(tmp_path):
    """Radii 0.1 and 0.1: |l0 l2| = 0.6 cos(q/2) < 0.2 for |q| > 2.46."""
    arm = arm_of(tmp_path, 0.1, 0.01, 0.1)
    assert arm.exclusions == ()
    assert ("l0_0", "l2_0") in pairs(arm)


def test_adjacent_shapes_that_touch_are_listed(tmp_path):
    """Balls of 0.2 and 0.15 m, 0.3 m apart, touch; those of 0.15 and 0.1 m do not."""
    (one,) = arm_of(tmp_path, 0.2, 0.15, 0.1, swing=0.3).exclusions
    assert (one.first, one.second, one.evidence) == ("l0_0", "l1_0", Evidence.ADJACENT)
    assert one.touching == one.sampled


def test_plates_close_above_each_other_are_told_apart_by_their_hulls(tmp_path):
    """Plates 2 cm apart and 1 cm thick: the capsules overlap, the plates are left in and clear."""
    plate = "<box size='0.6 0.6 0.01'/>"
    parts = [link("l0", plate, origin=""), link("l1", None), link("l2", plate, origin="")]
    for k in range(2):
        text = joint(f"j{k}", f"l{k}", f"l{k + 1}")
        parts.append(text.replace("xyz='0 0 0.3' rpy='0.1 0.2 0.3'", "xyz='0 0 0.01'"))
    arm = load_arm(write(tmp_path, *parts))
    assert arm.exclusions == ()
    scene = Scene([PlacedArm("a", arm)])
    assert len(scene.pairs) > 0
    q = arm.random_configurations(50, np.random.default_rng(0))
    assert distances(scene, q).min(axis=1) == pytest.approx(0.01, abs=2e-6)


def test_what_never_meets_within_its_hull_is_left_out(tmp_path):
    """A ball in the middle of a hollow block, which it never meets."""
    corner = 0.2 * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    sides = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    rows = [f"v {x} {y} {z}" for x, y, z in corner]
    rows += [f"f {a} {b} {c}\nf {a} {c} {d}" for a, b, c, d in sides]
    (tmp_path / "block.obj").write_text("\n".join(rows) + "\n", encoding="utf-8")
    block = link("l0", "<mesh filename='block.obj'/>", origin="")
    parts = [block, link("l1", None), link("l2", BALL.format(0.02), origin="")]
    for k in range(2):
        text = joint(f"j{k}", f"l{k}", f"l{k + 1}")
        parts.append(text.replace("xyz='0 0 0.3' rpy='0.1 0.2 0.3'", "xyz='0.01 0 0'"))
    arm = load_arm(write(tmp_path, *parts))
    assert arm.exclusions
    for one in arm.exclusions:
        assert (one.evidence, one.touching) == (Evidence.NEVER, 0)
        assert one.flagged >= 20
    scene = Scene([PlacedArm("a", arm)])
    q = arm.random_configurations(50, np.random.default_rng(0))
    assert distances(scene, q).min(initial=1.0) > 0.0


def test_names_of_shapes():
    assert shape_of("forearm_link_0.13") == "forearm_link_0"
    assert shape_of("link_0.0_0") == "link_0.0_0", "a link may have a dot in its name"


def test_the_cache_answers_and_a_broken_one_is_replaced(tmp_path, monkeypatch):
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path / "cache"))
    first = arm_of(tmp_path, 0.4, 0.01, 0.3)
    found = [one.geometry.radius for one in first.geometry.geometryObjects]
    (kept,) = (tmp_path / "cache" / "arms").glob("*.json")
    text = kept.read_text()
    monkeypatch.setattr("dualarm_repro.arms.fit.links.parts_of", lambda *_: pytest.fail("not kept"))
    again = arm_of(tmp_path, 0.4, 0.01, 0.3)
    assert [one.geometry.radius for one in again.geometry.geometryObjects] == found
    assert again.exclusions == first.exclusions
    monkeypatch.undo()
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path / "cache"))
    kept.write_text("{")
    assert arm_of(tmp_path, 0.4, 0.01, 0.3).exclusions == first.exclusions
    assert kept.read_text() == text
    _ = arm_of(tmp_path, 0.4, 0.02, 0.3).exclusions
    assert len(list((tmp_path / "cache" / "arms").glob("*.json"))) == 2, "by content"
    assert np.isfinite(found).all()
