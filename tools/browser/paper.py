"""Pages of the book on paper, printed by the browser: folds open, scenes as still pictures."""

from __future__ import annotations

from pathlib import Path

from playwright.async_api import BrowserContext, Page

from .page_checks import set_theme
from .visit import visit

_LOADED = "() => Promise.all([...document.images].map((one) => one.decode().catch(() => {})))"
#: In a book with contents no page needs its own.
_BOUND = "#jb-print-toc { display: none; }"


async def print_page(context: BrowserContext, source: Path, target: Path) -> None:
    """One page of a bound book as a PDF."""
    async with visit(context, source) as made:
        page = made.page
        await set_theme(page, "light")
        await page.add_style_tag(content=_BOUND)
        await print_open(page, target)


async def print_open(page: Page, target: Path) -> None:
    """What is open in a tab as a PDF, as a reader's *print* gives it."""
    await page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
    await page.evaluate(
        "() => document.querySelectorAll('img').forEach((one) => (one.loading = 'eager'))"
    )
    await page.evaluate(_LOADED)
    await page.pdf(path=target, prefer_css_page_size=True, print_background=True)
