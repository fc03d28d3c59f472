"""Robot files: what is refused, and that every number has a source."""

import jsonschema
import pytest
import yaml

from dualarm_repro.arms import arm_names, load_arm
from dualarm_repro.arms.robot_file import json_schema, load_robot_file
from dualarm_repro.datafiles import data_path
from dualarm_repro.errors import DataFileError, InputError


@pytest.fixture
def changed(tmp_path):
    """The file of the IRB 120 with one change."""

    def write(change):
        content = yaml.safe_load(data_path("robots", "irb120.yaml").read_text(encoding="utf-8"))
        change(content)
        path = tmp_path / "changed.yaml"
        path.write_text(yaml.safe_dump(content), encoding="utf-8")
        return path

    return write


def test_an_unchanged_copy_loads(changed):
    arm = load_arm(changed(lambda content: None))
    assert arm.name == "changed"
    assert arm.fk([0] * 6)[0, 3] == pytest.approx(0.374)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda c: c.pop("joints"), "joints = 'nothing'"),
        (lambda c: c.pop("kind"), "kind = 'nothing': expected one of dh, urdf, mirror"),
        (lambda c: c.update(kind="scara"), "kind = 'scara'"),
        (lambda c: c.update(kind=["dh"]), "kind = ['dh']"),
        (lambda c: c.update(joints=[]), "joints"),
        (lambda c: c["joints"][0].pop("d"), "joints.0.d = 'nothing'"),
        (lambda c: c["joints"][0].update(d=float("nan")), "joints.0.d = nan"),
        (lambda c: c["joints"][0].update(d="tall"), "joints.0.d = 'tall'"),
        (lambda c: c["joints"][0].update(d=True), "joints.0.d = True"),
        (lambda c: c["joints"][1].update(alpha="ninety"), "joints.1.alpha = 'ninety'"),
        (lambda c: c["joints"][1].update(alpha=float("inf")), "joints.1.alpha = inf"),
        (lambda c: c["joints"][2].update(lower="80 deg"), "lower below upper"),
        (lambda c: c["joints"][2].update(velocity=0), "positive velocity"),
        (lambda c: c["joints"][2].update(name="joint_1"), "names that differ"),
        (lambda c: c["joints"][2].update(beta=0), "joints.2.beta = 0"),
        (lambda c: c.update(convention="modern"), "convention = 'modern'"),
        (lambda c: c["provenance"].pop("d"), "provenance of the columns d"),
        (lambda c: c["provenance"]["d"].update(source="hearsay"), "'hearsay'"),
        (lambda c: c["provenance"]["d"].update(evidence="certain"), "provenance.d.evidence"),
        (
            lambda c: c["provenance"]["d"].update(
                joints={7: {"source": "assumed", "evidence": "assumed"}}
            ),
            "provenance.d.joints among 1..6, not 7",
        ),
        (lambda c: c["capsules"][0].update(joint=7), "capsules.joint among 0..6, not 7"),
        (lambda c: c["capsules"][0].update(radius=0), "capsules.0.radius = 0"),
        (lambda c: c["capsules"][0].update(end=[0, 0]), "capsules.0.end"),
        (lambda c: c.update(sources={}), "sources"),
    ],
)
def test_a_wrong_field_is_named(change, said, changed):
    with pytest.raises(DataFileError) as caught:
        load_arm(changed(change))
    assert "changed.yaml: " in str(caught.value)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_joint_more_or_less_is_another_arm(changed):
    with pytest.raises(DataFileError, match=r"capsules\.joint among 0\.\.5, not 6"):
        load_arm(changed(lambda c: c["joints"].pop()))


def test_a_mirror_needs_a_table(tmp_path):
    for name in ("panda", "es165d-slave"):
        text = data_path("robots", f"{name}.yaml").read_text(encoding="utf-8")
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    text = (tmp_path / "es165d-slave.yaml").read_text(encoding="utf-8")
    path = tmp_path / "image.yaml"
    path.write_text(text.replace("of: es165d", "of: panda"), encoding="utf-8")
    with pytest.raises(DataFileError, match="of = 'panda'"):
        load_arm(path)
    with pytest.raises(DataFileError, match=r"es165d\.yaml"):
        load_arm(tmp_path / "es165d-slave.yaml")


def test_flange_and_lock_are_for_urdfs():
    with pytest.raises(InputError, match="irb120 is no URDF"):
        load_arm("irb120", flange="tool")


@pytest.mark.parametrize("name", arm_names())
def test_shipped_files(name):
    path = data_path("robots", f"{name}.yaml")
    robot = load_robot_file(path)
    used = {origin.source for origin in robot.provenance.values()}
    used |= {capsule.source for capsule in getattr(robot, "capsules", [])}
    used |= {
        origin.source
        for column in robot.provenance.values()
        for origin in getattr(column, "joints", {}).values()
    }
    notes = " ".join(robot.notes)
    assert used <= set(robot.sources)
    assert all(key in used or key in notes for key in robot.sources)
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    jsonschema.validate(content, json_schema())
