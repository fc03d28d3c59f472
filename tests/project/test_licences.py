"""Every locked distribution has a licence, and the plain package brings in none under the GPL."""

from email.message import Message
from importlib.metadata import PackageNotFoundError, distribution
from types import SimpleNamespace

import pytest
from installs.rows import project_table
from supply import licences
from supply.locks import reached, read_all


@pytest.fixture(scope="module")
def table(root):
    return licences.read(root)


@pytest.fixture(scope="module")
def pinned(root):
    return read_all(root)


def saying(**fields):
    """A distribution whose metadata hold some fields."""
    told = Message()
    for name, value in fields.items():
        told[name.replace("_", "-")] = value
    return SimpleNamespace(metadata=told)


def test_every_locked_distribution_is_listed_and_nothing_else(table, pinned):
    assert set(table) == {one.name for lock in pinned.values() for one in lock}
    assert all(expression and place for expression, place in table.values())


def test_the_plain_package_needs_nothing_under_the_gpl(root, table, pinned):
    needed = reached(pinned["requirements.lock"], project_table(root)["dependencies"])
    assert len(needed) > 40
    assert [name for name in needed & set(table) if licences.strong(table[name][0])] == []


def test_the_table_says_what_installed_distributions_say(table, pinned):
    """Of the versions that the lock pins: another one may have changed its licence."""
    compared = 0
    for one in pinned["requirements.lock"]:
        try:
            installed = distribution(one.name)
        except PackageNotFoundError:
            continue
        if installed.version == one.version:
            assert licences.licence(one.name, installed) == table[one.name], one.name
            compared += 1
    assert compared > 40


@pytest.mark.parametrize(
    ("expression", "asks"),
    [
        ("GPL-2.0-or-later", True),
        ("AGPL-3.0-only", True),
        ("MIT AND GPL-3.0-only", True),
        ("MIT OR GPL-3.0-only", False),
        ("LGPL-3.0-only", False),
        ("BSD-3-Clause", False),
    ],
)
def test_the_gpl_is_told_from_the_lesser_one(expression, asks):
    assert licences.strong(expression) is asks


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"License_Expression": "MIT AND Zlib"}, ("MIT AND Zlib", "License-Expression")),
        ({"License": "BSD 3-Clause License  Copyright (c) 2022"}, ("BSD-3-Clause", "License")),
        ({"License": "MPL-2.0 AND MIT"}, ("MPL-2.0 AND MIT", "License")),
        (
            {"License": "UNKNOWN", "Classifier": "License :: OSI Approved :: MIT License"},
            ("MIT", "classifier"),
        ),
        ({"License": "Copyright somebody"}, None),
        ({"Classifier": "License :: Other/Proprietary License"}, None),
    ],
)
def test_what_metadata_say_becomes_an_expression(fields, expected):
    assert licences.stated(saying(**fields)) == expected


def test_expressions_are_spdx(table):
    spdx = pytest.importorskip("license_expression", reason="installed by `make env`")
    known = spdx.get_spdx_licensing()
    for name, (expression, _) in table.items():
        assert known.validate(expression).errors == [], name
