"""Tracked files hold no secrets, machine paths or registries; the checker finds each kind."""

import check_leaks
import pytest

#: Pieces that give a finding when put together, by what it is.
PLANTED = {
    "a private key": ("-----BEGIN RSA PRIV", "ATE KEY-----"),
    "a token": ("token ghp", "_" + "a1" * 18),
    "a password": ("pass", 'word = "correct horse battery"'.replace(" horse ", "-")),
    "an address with a login": ("https://me:", "hidden@example.org/simple"),
    "a path of one machine": ("open('/ho", "me/someone/arm.urdf')"),
    "an address of one network": ("http://10.", "0.0.7:8080/wheels"),
    "the host of a package registry": ("https://py", "pi.org/simple"),
    "a setting of a package index": ("--extra-", "index-url somewhere"),
}


def test_tracked_files_are_clean(root):
    if not (root / ".git").exists():
        pytest.skip("not a clone")
    files = check_leaks.tracked(root)
    assert len(files) > 500
    assert check_leaks.leaks(root, files) == []


@pytest.mark.parametrize("what", check_leaks.PATTERNS)
def test_each_kind_is_found(what):
    assert (3, what) in list(check_leaks.found(f"a line\n\n{''.join(PLANTED[what])}\n"))


@pytest.mark.parametrize(
    "line",
    [
        "http://127.0.0.1:7000/static/",
        "see https://spdx.org/licenses/MIT and /homes/of/arms",
        "package://panda/work/mesh.stl",
        "password: str | None = None",
        "token = stream.next_token()",
        "the PyPI name of the package",
        "data/results/home/x",
    ],
)
def test_harmless_lines_pass(line):
    assert list(check_leaks.found(line)) == []


def test_binary_files_are_read_too(tmp_path):
    (tmp_path / "picture.bin").write_bytes(b"\0\1\n" + "".join(PLANTED["a token"]).encode())
    (line,) = check_leaks.leaks(tmp_path, [check_leaks.Path("picture.bin")])
    assert line == "picture.bin:2: a token"


def test_every_exception_is_needed(root):
    assert check_leaks.unused(root) == []
