"""Look at the built book in a browser, from its files, and write what is wrong into the book.

Chapters are looked at closely, pages of items by a seeded sample; links are followed on every page.
``_static/browser.json`` and the status page of the build say what was found. Ends with 1 if
something is wrong and with 3 if there is no browser: then nothing was checked.
"""

from __future__ import annotations

import argparse
import asyncio
import random
import sys
from collections.abc import Awaitable, Callable, Iterable, Sequence
from pathlib import Path

from browser.chromium import NOT_RUN, WHY_NOT, browser, executable
from browser.links import dead_links
from browser.page_checks import look_at
from browser.report import Report, publish
from browser.scenes import SCENES, STAGE, look_at_scenes, spare
from browser.use import use
from browser.visit import WIDE
from browser.without_scripts import read_page
from playwright.async_api import BrowserContext, Error
from prerun import ROOT, toc_pages

SEED = 390
#: Tabs at a time.
TABS = 3
#: One in so many pages of items is looked at closely, or at all, and so many of sources.
CLOSELY, ITEMS, SOURCES = 20, 3, 50
_SCENE_CLASS = SCENES.partition(".")[2]


def pages_of(html: Path) -> list[str]:
    """Every page of a built book by its name without suffix; scenes and templates are none."""
    found = [path.relative_to(html).with_suffix("").as_posix() for path in html.rglob("*.html")]
    return sorted(n for n in found if not n.endswith(".scene") and not n.startswith("_static/"))


def sample(pages: Sequence[str], folder: str, one_in: int) -> list[str]:
    """A seeded share of the pages below a folder, at least one if there are any."""
    below = [name for name in pages if name.startswith(f"{folder}/")]
    count = min(len(below), max(1, len(below) // one_in))
    return sorted(random.Random(SEED).sample(below, count))


async def check(html: Path, chapters: Sequence[str], *, alone: bool = False) -> Report:
    """Everything that is checked of a built book.

    Parameters
    ----------
    chapters
        The pages that are looked at closely.
    alone
        Whether no other page is looked at.
    """
    pages = list(chapters) if alone else pages_of(html)
    closely = list(dict.fromkeys([*chapters, *sample(pages, "items", CLOSELY)]))
    quickly = sample(pages, "items", ITEMS) + sample(pages, "_modules", SOURCES)
    quickly = [name for name in quickly if name not in closely]
    async with browser() as running:
        report = Report(running.version)
        context = await running.new_context(viewport=WIDE)
        plain = await running.new_context(viewport=WIDE, java_script_enabled=False)
        stage = await running.new_context(viewport=STAGE)
        await spare(stage)

        async def page(name: str) -> None:
            words = await look_at(context, html, name, report, closely=name in closely)
            if name in chapters:
                await read_page(plain, html, name, words, report)

        await in_tabs([*closely, *quickly], page, report)
        await _scenes(stage, html, closely, report)
        await use(context, html, report)
    for name in pages:
        path = html / f"{name}.html"
        report.add("links", name, dead_links(path, html))
    return report


async def in_tabs(
    names: Iterable[str], act: Callable[[str], Awaitable[None]], report: Report
) -> None:
    """Do something with pages, :data:`TABS` at a time; one that cannot be looked at is reported."""
    free = asyncio.Semaphore(TABS)

    async def one(name: str) -> None:
        async with free:
            try:
                await act(name)
            except Error as error:
                report.add("console", name, [str(error).splitlines()[0][:200]])

    await asyncio.gather(*map(one, names))


async def _scenes(
    context: BrowserContext, html: Path, names: Iterable[str], report: Report
) -> None:
    """Look at the scenes; a book in which none moves has lost its motions."""
    shown = [n for n in names if _SCENE_CLASS in (html / f"{n}.html").read_text(encoding="utf-8")]
    moving = 0
    for name in shown:
        try:
            moving += await look_at_scenes(context, html, name, report)
        except Error as error:
            report.add("scenes", name, [str(error).splitlines()[0][:200]])
    if shown and not moving:
        report.add("scenes", "book", ["no scene moves"])


def main(arguments: Sequence[str] | None = None) -> int:
    """Check the built book and publish the report in it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--html", type=Path, default=ROOT / "_build" / "html")
    parser.add_argument("--pages", nargs="*", help="look at these alone; nothing is published")
    chosen = parser.parse_args(arguments)
    if unknown := [n for n in chosen.pages or () if not (chosen.html / f"{n}.html").is_file()]:
        parser.error(f"no page {unknown[0]} below {chosen.html}")
    if executable() is None:
        print(f"browser: NOT RUN, {WHY_NOT}", file=sys.stderr)
        return NOT_RUN
    listed = toc_pages(ROOT / "book")  # index only leads to the first of them
    chapters = chosen.pages or [name for name in listed if (chosen.html / f"{name}.html").is_file()]
    if not chapters:
        print(f"browser: NOT RUN, no book in {chosen.html}; make book builds it", file=sys.stderr)
        return NOT_RUN
    report = asyncio.run(check(chosen.html, chapters, alone=bool(chosen.pages)))
    if not chosen.pages:
        publish(report, chosen.html)
    for problem in sorted(report.problems):
        print(problem, file=sys.stderr)
    print(f"browser: {len(report.pages)} pages, {len(report.problems)} problems")
    return 1 if report.problems else 0


if __name__ == "__main__":
    sys.exit(main())
