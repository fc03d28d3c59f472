"""Execute every notebook of the book in parallel into the cache that the build then reads.

The build itself runs notebooks one after the other and stops at the first that fails; this runs
them on all processors and lists every failure.
"""

from __future__ import annotations

import logging
import os
import re
import sys
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from pathlib import Path

import yaml
from jupyter_cache import get_cache
from jupyter_cache.executors import load_executor

from dualarm_repro.ledger import record
from dualarm_repro.papers import load

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


def warm_records() -> None:
    """Compute the record of every item once, the items of a page together, pages in parallel.

    Several pages show all records; without this each kernel that starts early computes all of them.
    """
    pages: dict[str, list[str]] = {}
    for item_id, checker in load().checkers.items():
        pages.setdefault(checker.page, []).append(item_id)
    with ProcessPoolExecutor() as pool:
        list(pool.map(_compute_records, pages.values()))


def _compute_records(item_ids: list[str]) -> None:
    for item_id in item_ids:
        with suppress(Exception):  # the page that shows the item will report it
            record(load(), item_id)


def prerun(book: Path, cache_folder: Path, timeout: int) -> dict[str, str]:
    """Execute what the cache does not hold.

    Returns
    -------
    dict
        Page to traceback, for each notebook that failed.
    """
    cache = get_cache(cache_folder)
    uris = [str(page) for page in notebooks(book)]
    for uri in uris:
        cache.add_nb_to_project(uri, read_data=READER)
    log = logging.getLogger("prerun")
    log.setLevel(logging.CRITICAL)  # failures are reported below, once
    run = load_executor("local-parallel", cache, log)
    result = run.run_and_cache(filter_uris=uris, timeout=timeout)
    return {
        str(Path(uri).relative_to(book)): _ANSI.sub(
            "", cache.get_project_record(uri).traceback or "could not be read or started"
        )
        for uri in sorted(result.excepted + result.errored)
    }


def main() -> int:
    """Execute the notebooks of the book; 1 if any failed. ``--records``: compute records only."""
    if "--records" in sys.argv[1:]:
        warm_records()
        return 0
    config = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    build = ROOT / "_build"
    isolate_kernels(build / ".ipython")
    book = ROOT / "book"
    if missing := [page for page in toc_pages(book) if not (book / f"{page}.md").is_file()]:
        print(f"in _toc.yml, but no such file: {', '.join(missing)}", file=sys.stderr)
        return 1
    warm_records()
    failed = prerun(book, build / ".jupyter_cache", config["execute"]["timeout"])
    for page, traceback in failed.items():
        print(f"{page} failed:\n{traceback}", file=sys.stderr)
    if failed:
        print(f"{len(failed)} notebooks failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
