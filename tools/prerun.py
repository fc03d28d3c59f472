"""Execute every notebook of the book in parallel into the cache that the build then reads.

The build itself runs notebooks one after the other and stops at the first that fails; this runs
them on all processors and lists every failure.
"""

from __future__ import annotations

import gc
import json
import logging
import os
import re
import sys
import threading
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from functools import partial
from hashlib import sha256
from itertools import zip_longest
from multiprocessing import active_children
from pathlib import Path
from typing import Any

import yaml
from jupyter_cache.executors import load_executor
from notebook_cache import open_cache, seal
from sphinx_ext.rare_collections import THRESHOLDS

from dualarm_repro.datafiles import data_path
from dualarm_repro.ledger import record
from dualarm_repro.ledger.closure import closure_of_modules, hash_file
from dualarm_repro.ledger.files import to_json, write_text
from dualarm_repro.ledger.reference import read_costs
from dualarm_repro.ledger.workers import deaf
from dualarm_repro.papers import load
from dualarm_repro.sources import graph
from dualarm_repro.view.page import pictures
from dualarm_repro.view.rendering import TEMPLATES
from dualarm_repro.view.running_notebook import IN_BOOK

ROOT = Path(__file__).resolve().parents[1]
READER = {"name": "myst_nb_md", "type": "plugin"}
_ANSI = re.compile(r"\x1b\[[0-9;]*m")
_FRONT_MATTER = re.compile(r"\A---\n(.*?)\n---\n", re.DOTALL)


def toc_pages(book: Path) -> list[str]:
    """Names of all pages in ``_toc.yml``, in reading order, without suffix."""

    def walk(entry: dict) -> list[str]:
        here = [entry[key] for key in ("root", "file") if key in entry]
        below = [
            *entry.get("chapters", []),
            *entry.get("sections", []),
            *entry.get("parts", []),
        ]
        return here + [page for child in below for page in walk(child)]

    return walk(yaml.safe_load((book / "_toc.yml").read_text(encoding="utf-8")))


def is_notebook(source: Path) -> bool:
    """Whether a Markdown file declares itself an executable notebook."""
    match = _FRONT_MATTER.match(source.read_text(encoding="utf-8"))
    return bool(match) and yaml.safe_load(match[1]).get("file_format") == "mystnb"


def notebooks(book: Path) -> list[Path]:
    """The executable pages of the book."""
    pages = (book / f"{page}.md" for page in toc_pages(book))
    return [page for page in pages if is_notebook(page)]


def isolate_kernels(folder: Path) -> None:
    """Let kernels read their settings from ``folder``: no startup files of a user, no log lines."""
    profile = folder / "profile_default"
    profile.mkdir(parents=True, exist_ok=True)
    settings = 'c.IPKernelApp.log_level = "ERROR"\n'
    (profile / "ipython_kernel_config.py").write_text(settings, encoding="utf-8")
    os.environ["IPYTHONDIR"] = str(folder)


def in_turn(pages: dict[str, list[str]], costs: dict[str, float]) -> list[list[str]]:
    """The items of each page: the longest page of every document first, then the second longest.

    The items of a page go together, since they share what they compute. Pages of a document share
    what is compiled for them: those who begin at once begin with different documents.
    """

    def cost(page: str) -> float:
        return sum(costs.get(item_id, 0.0) for item_id in pages[page])

    ranked: dict[str, list[str]] = {}
    for page in sorted(pages, key=lambda page: -cost(page)):
        ranked.setdefault(page.partition("/")[0], []).append(page)
    rounds = zip_longest(*ranked.values())
    return [pages[page] for one in rounds for page in one if page is not None]


def warm(item_ids: Iterable[str] | None = None, drawn: bool = True) -> None:
    """Compute the record of every item once, in parallel, and its pictures if it is to be drawn."""
    registry = load()
    chosen = registry.items if item_ids is None else set(item_ids)
    pages: dict[str, list[str]] = {}
    for item_id, checker in registry.checkers.items():
        if item_id in chosen:
            pages.setdefault(checker.page, []).append(item_id)
    gc.freeze()
    gc.set_threshold(*THRESHOLDS)  # the workers inherit it: a compiler makes little garbage
    with ProcessPoolExecutor() as pool:
        try:
            with deaf():  # whoever is interrupted ends the workers, which tell nothing of it
                done = pool.map(partial(_compute, drawn), in_turn(pages, read_costs()))
            list(done)
        except KeyboardInterrupt:
            threading.excepthook = lambda _: None  # the pool's own, which finds its workers gone
            for worker in active_children():
                worker.kill()
            raise


def _compute(drawn: bool, item_ids: list[str]) -> None:
    for item_id in item_ids:
        with suppress(Exception):  # the page that shows the item will report it
            (pictures if drawn else record)(load(), item_id)


def page_key(page: Path) -> str:
    """What the outputs of a page depend on: its cells, the library it imports, the items it shows.

    A page that asks for the whole registry depends on every item; robots, scenes and
    templates count for all.
    """
    text = page.read_text(encoding="utf-8")
    cells = re.findall(r"^```\{code-cell\}.*?^```", text, re.DOTALL | re.MULTILINE)
    code = "\n".join(cells)
    modules = {name for name in re.findall(r"^(?:from|import) (dualarm_repro[\w.]*)", code, re.M)}
    items = re.findall(r'"((?:\w+)\.(?:\w+))"', code)
    registry = load()
    shown = registry.items if "load()" in code else [i for i in items if i in registry.items]
    known = sorted(name for name in modules if name in graph().files)
    parts = [code, closure_of_modules(tuple(known), drawn=True).digest]
    parts += [to_json(record(registry, item_id), indent=None) for item_id in shown]
    parts += [to_json(pictures(registry, i), indent=None) for i in items if i in registry.items]
    read = [data_path(folder).glob("*.yaml") for folder in ("robots", "scenes")]
    read += [TEMPLATES.glob("*.html"), TEMPLATES.parent.rglob("*.yaml")]
    parts += [hash_file(p) for paths in read for p in sorted(paths)]
    return sha256("\0".join(parts).encode()).hexdigest()


def _imports(page: Path) -> int:
    """How many modules of the library a page uses beside those that show what is kept."""
    text = page.read_text(encoding="utf-8")
    return len(set(re.findall(r"^from dualarm_repro\.(?!papers import show)([\w.]+)", text, re.M)))


def drop_changed(cache: Any, pages: Iterable[Path], keys_file: Path) -> None:
    """Remove from the notebook cache every page whose key has changed since it was executed.

    The cache itself knows the cells only.
    """
    try:
        known = json.loads(keys_file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        known = {}
    known = known if isinstance(known, dict) else {}
    keys = {str(page): page_key(page) for page in pages}
    stale = {page for page, key in keys.items() if known.get(page) != key}
    for entry in cache.list_cache_records():
        if entry.uri in stale or entry.uri not in keys:
            cache.remove_cache(entry.pk)
    write_text(keys_file, to_json(keys, indent=1))


def prerun(book: Path, cache_folder: Path, timeout: int) -> dict[str, str]:
    """Execute what the cache does not hold.

    Returns
    -------
    dict
        Page to traceback, for each notebook that failed.
    """
    cache = open_cache(cache_folder)
    pages = sorted(notebooks(book), key=_imports, reverse=True)  # those that compute most first
    drop_changed(cache, pages, cache_folder / "pages.json")
    uris = [str(page) for page in pages]
    for uri in uris:
        cache.add_nb_to_project(uri, read_data=READER)
    log = logging.getLogger("prerun")
    log.setLevel(logging.CRITICAL)  # failures are reported below, once
    run = load_executor("local-parallel", cache, log)
    result = run.run_and_cache(filter_uris=uris, timeout=timeout)
    stored = {entry.uri for entry in cache.list_cache_records()}
    excepted, errored = [*result.excepted], [*result.errored]
    # Two kernels that start at once may choose one port, and two workers may store at once.
    if again := sorted({*result.succeeded} - stored | {*errored}):
        second = run.run_and_cache(filter_uris=again, timeout=timeout)
        excepted, errored = [*excepted, *second.excepted], [*second.errored]
    seal(cache, cache_folder)
    return {
        str(Path(uri).relative_to(book)): _ANSI.sub(
            "", cache.get_project_record(uri).traceback or "could not be read or started"
        )
        for uri in sorted(excepted + errored)
    }


def main() -> int:
    """Execute the notebooks of the book; 1 if any failed. ``--records``: compute records only."""
    if "--records" in sys.argv[1:]:
        warm(drawn=False)
        return 0
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    build = ROOT / "_build"
    isolate_kernels(build / ".ipython")
    os.environ[IN_BOOK] = "1"
    book = ROOT / "book"
    if missing := [page for page in toc_pages(book) if not (book / f"{page}.md").is_file()]:
        print(f"in _toc.yml, but no such file: {', '.join(missing)}", file=sys.stderr)
        return 1
    warm()
    failed = prerun(book, build / ".jupyter_cache", config["execute"]["timeout"])
    for page, traceback in failed.items():
        print(f"{page} failed:\n{traceback}", file=sys.stderr)
    if failed:
        print(f"{len(failed)} notebooks failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


def process() -> int:
    """:func:`main`, whose interruption needs no words; 130 then, as of any command."""
    try:
        return main()
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(process())
