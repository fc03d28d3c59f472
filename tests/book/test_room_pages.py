"""The list of highlighted sources names modules with a page of their source only."""

from types import SimpleNamespace

import room_pages


def test_a_module_without_source_is_left_out_of_the_list():
    known = {"builtins": False, "dualarm_repro.errors": ("code", {}, {}, "api/ledger")}
    app = SimpleNamespace(env=SimpleNamespace(_viewcode_modules=known))
    assert room_pages.forget_sourceless(app) == []
    assert list(known) == ["dualarm_repro.errors"]


def test_a_build_without_sources_has_no_list():
    assert room_pages.forget_sourceless(SimpleNamespace(env=SimpleNamespace())) == []
