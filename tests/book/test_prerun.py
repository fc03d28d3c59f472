"""Pre-execution: which pages are notebooks, what is cached, and that every failure is named."""

from dataclasses import replace

import prerun
import pytest
from jupyter_cache import get_cache

NOTEBOOK = "---\nfile_format: mystnb\n---\n\n# Page\n\n```{{code-cell}} ipython3\n{code}\n```\n"
TOC = """format: jb-book
root: intro
parts:
  - caption: A part
    chapters:
      - file: good
        sections:
          - file: bad/page
      - file: text
"""


@pytest.fixture
def book(tmp_path):
    folder = tmp_path / "book"
    (folder / "bad").mkdir(parents=True)
    (folder / "_toc.yml").write_text(TOC)
    (folder / "intro.md").write_text(NOTEBOOK.format(code="print(6 * 7)"))
    (folder / "good.md").write_text(NOTEBOOK.format(code="1 + 1"))
    (folder / "bad" / "page.md").write_text(NOTEBOOK.format(code='raise ValueError("no arm")'))
    (folder / "text.md").write_text("# Text\n\n```python\nraise ValueError\n```\n")
    return folder


def test_pages_in_reading_order(book):
    assert prerun.toc_pages(book) == ["intro", "good", "bad/page", "text"]
    assert [page.stem for page in prerun.notebooks(book)] == ["intro", "good", "page"]


def test_records_of_all_checkers_are_warmed(registry, tmp_path, monkeypatch):
    chosen = {i: registry.checkers[i] for i in ("xue.eq02", "xue.tab01")}
    broken = replace(registry.checkers["xue.eq03"], compute=lambda assumed: 1 / 0)
    monkeypatch.setattr(registry, "checkers", {"xue.eq03": broken} | chosen)
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path))
    prerun.warm_records()
    assert {path.stem for path in tmp_path.rglob("*.json")} == set(chosen)


def test_all_failures_are_named_and_the_rest_is_cached(book, tmp_path, monkeypatch):
    monkeypatch.delenv("IPYTHONDIR", raising=False)
    prerun.isolate_kernels(tmp_path / "ipython")
    failed = prerun.prerun(book, tmp_path / "cache", timeout=60)
    assert list(failed) == ["bad/page.md"]
    assert "ValueError: no arm" in failed["bad/page.md"]
    assert len(get_cache(tmp_path / "cache").list_cache_records()) == 2
    (book / "bad" / "page.md").write_text(NOTEBOOK.format(code="print(1)"))
    assert prerun.prerun(book, tmp_path / "cache", timeout=60) == {}
