"""Contents beside pages that are in no table of contents are made once for each depth."""

from types import SimpleNamespace

import pytest
import shared_contents

APP = SimpleNamespace(env=SimpleNamespace(all_docs={"xue/table2": 1.0}))


@pytest.fixture
def contents():
    """Contents of a page, and the pages for which they were made."""
    kept, made = {}, []

    def of(page, **how):
        context = {"toctree": lambda **how: made.append(page) or f"{page} {sorted(how.items())}"}
        shared_contents.share(kept, APP, page, "page.html", context, None)
        return context["toctree"](**how)

    return of, made


def test_pages_as_deep_share_them(contents):
    of, made = contents
    assert of("items/xue.tab01", maxdepth=2) == of("items/xue.tab02", maxdepth=2)
    assert made == ["items/xue.tab01"]
    of("_modules/dualarm_repro/cli", maxdepth=2)
    of("items/xue.tab02", maxdepth=3)
    assert made[1:] == ["_modules/dualarm_repro/cli", "items/xue.tab02"]


def test_a_source_of_the_book_has_its_own(contents):
    of, made = contents
    of("xue/table2")
    of("xue/table2")
    assert made == ["xue/table2"] * 2


def test_a_page_without_contents_is_left_alone():
    context = {}
    shared_contents.share({}, APP, "items/xue.tab01", "page.html", context, None)
    assert context == {}
