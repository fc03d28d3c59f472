"""Pre-execution: which pages are notebooks, what is cached, and that every failure is named."""

import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import prerun
import pytest
from jupyter_cache import get_cache

from dualarm_repro.cache_folder import cache_folder
from dualarm_repro.machine_code import compiled_folder

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


def test_records_and_pictures_of_all_checkers_are_warmed(registry, tmp_path, monkeypatch):
    broken = replace(registry.checkers["xue.eq03"], compute=lambda assumed: 1 / 0)
    monkeypatch.setitem(registry.checkers, "xue.eq03", broken)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(compiled_folder()))  # of machine code, not of records
    known = cache_folder() / "sources.json"  # else each worker parses every module
    if known.is_file():
        shutil.copy2(known, tmp_path)
    monkeypatch.setenv("DUALARM_CACHE", str(tmp_path))
    prerun.warm(["xue.eq04", "xue.eq03", "xue.eq09"])
    for kind in ("records", "pages"):
        assert {path.stem for path in (tmp_path / kind).iterdir()} == {"xue.eq04", "xue.eq09"}


def test_what_begins_at_once_is_of_several_documents():
    pages = {"a/short": ["a.1"], "a/long": ["a.2", "a.3"], "b/long": ["b.1"], "a/middle": ["a.4"]}
    costs = {"a.1": 1.0, "a.2": 5.0, "a.3": 4.0, "b.1": 2.0, "a.4": 8.0}
    assert prerun.in_turn(pages, costs) == [["a.2", "a.3"], ["b.1"], ["a.4"], ["a.1"]]
    assert prerun.in_turn(pages, {})[1] == ["b.1"], "whatever is known of costs"


INTERRUPTED = """
import pathlib, signal, sys, time
sys.path.insert(0, {tools!r})
import prerun

def compute(drawn, item_ids):
    pathlib.Path({begun!r}).touch()
    time.sleep(60)

def begin(*given):
    if {early}:
        signal.raise_signal(signal.SIGINT)
    return in_turn(*given)

in_turn, prerun.in_turn = prerun.in_turn, begin
prerun._compute = compute
sys.argv = ["prerun.py", "--records"]
print("begun", flush=True)
sys.exit(prerun.process())
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("early", [False, True])
def test_an_interruption_ends_all_without_a_word(tmp_path, early):
    """While records are computed, or while the workers that compute them begin."""
    begun = tmp_path / "begun"
    tools = str(Path(prerun.__file__).parent)
    program = INTERRUPTED.format(tools=tools, begun=str(begun), early=early)
    with subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout.readline() == "begun\n"
        while not early and not begun.exists() and process.poll() is None:
            time.sleep(0.05)
        if not early:
            os.killpg(process.pid, signal.SIGINT)
        words = process.communicate(timeout=30)
    assert (process.returncode, *words) == (130, "", "")
    assert _ended(process.pid, within=5.0)


def _ended(group, within):
    """Whether no process of a group is left after this time [s]."""
    for _ in range(int(within / 0.05)):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.05)
    return False


def test_the_key_of_a_page_follows_what_it_shows(tmp_path, monkeypatch):
    from dualarm_repro.ledger import kept

    page = tmp_path / "page.md"
    shows = 'from dualarm_repro.papers import show\n\nshow("xue.eq02")'
    page.write_text(NOTEBOOK.format(code=shows))
    key = prerun.page_key(page)
    page.write_text("Prose.\n" + NOTEBOOK.format(code=shows))
    assert prerun.page_key(page) == key
    page.write_text(NOTEBOOK.format(code=shows.replace("eq02", "eq03")))
    assert prerun.page_key(page) != key
    page.write_text(NOTEBOOK.format(code=shows))
    templates = tmp_path / "view" / "templates"  # what is beside it is read too
    templates.mkdir(parents=True)
    (templates / "card.html").write_text("another template")
    with monkeypatch.context() as patch:
        patch.setattr(prerun, "TEMPLATES", templates)
        assert prerun.page_key(page) != key
    read = kept.read
    monkeypatch.setattr(
        kept,
        "read",
        lambda registry, kind, name: (
            {"figure": "another", "scene": None} if kind == "pages" else read(registry, kind, name)
        ),
    )
    assert prerun.page_key(page) != key


@pytest.fixture
def executed_at_once(monkeypatch):
    """Whatever a page is executed by: cells count as executed without a kernel, whose start takes
    a second; the pool of workers inherits it."""

    def execute(notebook, **_):
        for cell in notebook.cells:
            if cell.cell_type == "code":
                cell.execution_count = 1
        return notebook

    monkeypatch.setattr("jupyter_cache.executors.utils.executenb", execute)


@pytest.mark.usefixtures("executed_at_once")
def test_only_pages_whose_key_changed_are_executed_again(book, tmp_path, monkeypatch):
    (book / "bad" / "page.md").write_text(NOTEBOOK.format(code="print(1)"))
    keys = {"intro": "a", "good": "a", "page": "a"}
    monkeypatch.setattr(prerun, "page_key", lambda page: keys[page.stem])
    assert prerun.prerun(book, tmp_path / "cache", timeout=60) == {}
    cache = get_cache(tmp_path / "cache")
    before = {Path(r.uri).stem: r.created for r in cache.list_cache_records()}
    keys["good"] = "b"
    assert prerun.prerun(book, tmp_path / "cache", timeout=60) == {}
    after = {Path(r.uri).stem: r.created for r in cache.list_cache_records()}
    assert {name for name in after if after[name] != before[name]} == {"good"}


@pytest.mark.usefixtures("executed_at_once")
def test_a_page_that_could_not_be_started_or_stored_is_executed_again(book, tmp_path, monkeypatch):
    (book / "bad" / "page.md").write_text(NOTEBOOK.format(code="print(1)"))
    asked, load = [], prerun.load_executor

    class Forgetful:
        def __init__(self, *arguments):
            self.run, self.cache = load(*arguments), arguments[1]

        def run_and_cache(self, filter_uris, timeout):
            asked.append([Path(uri).stem for uri in filter_uris])
            result = self.run.run_and_cache(filter_uris=filter_uris, timeout=timeout)
            for entry in self.cache.list_cache_records() if len(asked) == 1 else ():
                if Path(entry.uri).stem in ("good", "intro"):
                    self.cache.remove_cache(entry.pk)
                if Path(entry.uri).stem == "intro":
                    result.succeeded.remove(entry.uri)
                    result.errored.append(entry.uri)
            return result

    monkeypatch.setattr(prerun, "load_executor", Forgetful)
    assert prerun.prerun(book, tmp_path / "cache", timeout=60) == {}
    assert asked[1:] == [["good", "intro"]]
    found = {Path(r.uri).stem for r in get_cache(tmp_path / "cache").list_cache_records()}
    assert found == {"intro", "good", "page"}


def test_all_failures_are_named_and_the_rest_is_cached(book, tmp_path, monkeypatch):
    monkeypatch.delenv("IPYTHONDIR", raising=False)
    prerun.isolate_kernels(tmp_path / "ipython")
    failed = prerun.prerun(book, tmp_path / "cache", timeout=60)
    assert list(failed) == ["bad/page.md"]
    assert "ValueError: no arm" in failed["bad/page.md"]
    assert len(get_cache(tmp_path / "cache").list_cache_records()) == 2
    (book / "bad" / "page.md").write_text(NOTEBOOK.format(code="print(1)"))
    assert prerun.prerun(book, tmp_path / "cache", timeout=60) == {}
