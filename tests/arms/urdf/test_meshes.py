"""Where meshes are looked for."""

import pytest

from dualarm_repro.arms.urdf.meshes import mesh_path
from dualarm_repro.errors import DataFileError


@pytest.fixture
def urdf(tmp_path):
    """The path of a URDF in a package of its own."""
    path = tmp_path / "ws" / "pkg" / "urdf" / "arm.urdf"
    path.parent.mkdir(parents=True)
    return path


def made(path):
    """An empty file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()
    return path


def test_relative_absolute_and_file_names(urdf, tmp_path):
    near = made(urdf.parent / "meshes" / "a b.stl")
    assert mesh_path(urdf, "mesh", "meshes/a b.stl", ()) == near
    assert mesh_path(urdf, "mesh", str(near), ()) == near
    assert mesh_path(urdf, "mesh", f"file://{near}", ()) == near
    assert mesh_path(urdf, "mesh", f"file://{urdf.parent}/meshes/a%20b.stl", ()) == near


def test_packages_by_option_by_place_and_by_variable(urdf, tmp_path, monkeypatch):
    for variable in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(variable, raising=False)
    name = "package://pkg/m/a.stl"
    with pytest.raises(DataFileError, match=r"arm\.urdf, ROS_PACKAGE_PATH, .*by packages="):
        mesh_path(urdf, "mesh", name, ())
    elsewhere = made(tmp_path / "other" / "pkg" / "m" / "a.stl")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"/nowhere:{tmp_path / 'other'}")
    assert mesh_path(urdf, "mesh", name, ()) == elsewhere
    assert mesh_path(urdf, "mesh", name.replace("package", "model"), ()) == elsewhere
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "other" / "pkg"))
    assert mesh_path(urdf, "mesh", name, ()) == elsewhere, "the variable may name the package"
    monkeypatch.delenv("ROS_PACKAGE_PATH")
    shared = made(tmp_path / "ros" / "share" / "pkg" / "m" / "a.stl")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "ros"))
    assert mesh_path(urdf, "mesh", name, ()) == shared
    beside = made(urdf.parents[1] / "m" / "a.stl")
    assert mesh_path(urdf, "mesh", name, ()) == beside, "the place of the file comes first"
    assert mesh_path(urdf, "mesh", name, (tmp_path / "other",)) == elsewhere


def test_a_missing_mesh_is_named_however_long_its_path(urdf):
    name = f"file:///{'long_folder/' * 20}no_such_part.stl"
    with pytest.raises(DataFileError, match=r"mesh = .*no_such_part\.stl'"):
        mesh_path(urdf, "mesh", name, ())
