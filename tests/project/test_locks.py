"""Locks pin everything by hash, name no address, agree with each other and with the bounds."""

import pytest
from installs.rows import project_table
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from supply.locks import LOCKS, LockError, plain, reached, read, read_all

HASH = "0" * 64
PIN = (
    f"numpy==2.2.0 ; python_version < '3.12' \\\n    --hash=sha256:{HASH}\n    # via\n    #   pin\n"
)


@pytest.fixture(scope="module")
def locks(root):
    return read_all(root)


@pytest.mark.parametrize("name", LOCKS)
def test_every_line_is_a_pin_a_hash_or_a_comment(root, name):
    """`read` refuses everything else; nothing is fetched from an address."""
    text = (root / name).read_text(encoding="utf-8")
    pinned = read(text, name)
    assert len(pinned) > 50
    assert sum(len(one.hashes) for one in pinned) == text.count("--hash=sha256:")
    assert "://" not in text
    assert "--hash=" not in text.replace("--hash=sha256:", "")


def test_a_pin_is_read_with_marker_hash_and_parents():
    (one,) = read(PIN)
    assert (one.name, one.version, one.marker) == ("numpy", "2.2.0", "python_version < '3.12'")
    assert (one.hashes, one.via) == ((HASH,), ("pin",))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (f"    --hash=sha256:{HASH}\n", ""),
        ("sha256:", "md5:"),
        (HASH, HASH[:-1]),
        ("numpy==2.2.0", "numpy>=2.2.0"),
        ("numpy==2.2.0", "numpy @ file:///numpy.whl"),
        ("numpy==2.2.0", "-e ."),
    ],
)
def test_a_line_of_another_form_is_refused(old, new):
    with pytest.raises(LockError):
        read(PIN.replace(old, new))


def test_locks_agree_where_they_pin_the_same(locks):
    pins = {}
    for pinned in locks.values():
        for one in pinned:
            key = (one.name, one.marker)
            assert pins.setdefault(key, (one.version, one.hashes)) == (one.version, one.hashes)


def test_locked_versions_are_allowed_by_the_project(root, locks):
    table = project_table(root)
    extras = table["optional-dependencies"]
    demands = {
        "requirements.lock": [*table["dependencies"], *extras["dev"]],
        "requirements-bench.lock": [*table["dependencies"], *extras["bench"]],
        "requirements-lab.lock": [*table["dependencies"], *extras["dev"], *extras["lab"]],
    }
    for name, asked in demands.items():
        versions = {}
        for one in locks[name]:
            versions.setdefault(canonicalize_name(one.name), []).append(one.version)
        for line in asked:
            wanted = Requirement(line)
            found = versions.get(canonicalize_name(wanted.name), [])
            assert found, f"{name} lacks {wanted.name}: make lock"
            assert all(wanted.specifier.contains(v, prereleases=True) for v in found), line


def test_what_a_demand_brings_in_is_followed(root, locks):
    """The plain package brings in numba's compiler, and neither the test runner nor quadprog."""
    found = reached(locks["requirements.lock"], project_table(root)["dependencies"])
    assert {"llvmlite", "coal", "clarabel"} <= found
    assert not found & {"pytest", "jupyter-book", "quadprog", "ompl"}
    assert plain("dask[distributed]>=2025.1") == "dask"
