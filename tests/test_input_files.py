"""Whatever is named as an input file: regular files are read, the rest is one line at once."""

import os
import socket

import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.errors import DualArmError, InputError
from dualarm_repro.input_files import contents, path_of
from dualarm_repro.planning import load_tasks
from dualarm_repro.planning.tasks.path_file import read_paths
from dualarm_repro.scene import PlacedArm, Scene, load_scene
from dualarm_repro.scene.mesh_parts import read_mesh

ARM = load_arm("irb120")


def _pipe(folder):
    os.mkfifo(folder / "it")
    return folder / "it"


def _socket(folder):
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(folder / "it"))
    return folder / "it"


def _endless(folder):
    (folder / "it").symlink_to("/dev/zero")
    return folder / "it"


def _folder(folder):
    (folder / "it").mkdir()
    return folder / "it"


KINDS = {"a pipe": _pipe, "a socket": _socket, "a device": _endless, "a folder": _folder}
READERS = {
    "scene": (load_scene, ".yaml"),
    "tasks": (load_tasks, ".yaml"),
    "urdf": (load_arm, ".urdf"),
    "robot": (load_arm, ".yaml"),
    "mesh": (lambda path: read_mesh(path, (1.0, 1.0, 1.0)), ".stl"),
    "path": (lambda path: read_paths(Scene([PlacedArm("left", ARM)]), [path]), ".csv"),
}


@pytest.mark.parametrize(("read", "ending"), READERS.values(), ids=READERS)
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_no_regular_file_is_named_and_not_waited_for(tmp_path, kind, read, ending):
    path = KINDS[kind](tmp_path).rename(tmp_path / f"it{ending}")
    with pytest.raises(DualArmError, match=f"file = '{kind}': expected a readable") as caught:
        read(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("value", [None, 3, 2.5, [], ["a"], b"x", {}, "", " ", "a\0b", object()])
@pytest.mark.parametrize("read", [load_arm, load_scene, load_tasks])
def test_arguments_that_are_no_path_are_named(read, value):
    with pytest.raises(InputError, match=r"expected .*path"):
        read(value)


def test_bytes_are_bounded(tmp_path):
    file = tmp_path / "file"
    file.write_bytes(b"12345")
    assert contents(path_of("test", "file", str(file)), "a file", 5) == b"12345"
    with pytest.raises(InputError, match="at most 4e-06 MB"):
        contents(file, "a file", 4)
