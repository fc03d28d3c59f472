"""The book as a reader uses it, read from files: filters, folds, copying, search and dark mode."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from pathlib import Path

from playwright.async_api import BrowserContext, TimeoutError

from . import newcomer
from .report import Report
from .visit import visit

Use = Callable[[BrowserContext, Path], Awaitable[list[str]]]
#: Luminance, 0 to 1, below which a ground is dark.
DARK = 0.25
_SHOWN = """() => [...document.querySelectorAll(".ledger-row:not([hidden])")]
  .map((one) => one.dataset.paper)"""
_ALL_SHOWN = "() => !document.querySelector('.ledger-row[hidden]')"
_NUMBER = """() => [...document.querySelectorAll(".ledger-print td")]
  .map((one) => one.textContent.trim()).find((text) => /^-?\\d+\\.\\d+$/.test(text))"""
_UNFOLD = "() => document.querySelectorAll('details').forEach((one) => { one.open = true; })"
_GROUND = """() => {
  const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/[\\d.]+/g).map(Number);
  return (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255;
}"""


async def filters(context: BrowserContext, html: Path) -> list[str]:
    """The ledger narrows down to one document and to words, and keeps that in its address."""
    async with visit(context, html / "ledger.html") as made:
        page, lines = made.page, []
        everything = await page.evaluate(_SHOWN)
        menu = page.locator("#ledger-table select").first
        paper = await menu.locator("option").nth(1).inner_text()
        await menu.select_option(paper)
        chosen = await page.evaluate(_SHOWN)
        if chosen != [one for one in everything if one == paper] or not chosen:
            lines.append(f"filtered by {paper}: {len(chosen)} of {len(everything)} items")
        await page.reload()
        if await page.evaluate(_SHOWN) != chosen:
            lines.append("the address does not keep the filter")
        first = page.locator(".ledger-row:not([hidden]) summary code").first
        words = await first.inner_text()
        await page.locator("#ledger-table input[name=words]").fill(words)
        if not 1 <= len(await page.evaluate(_SHOWN)) < len(chosen):
            lines.append(f"the words {words!r} do not narrow the table down")
        await page.locator("#ledger-table button[type=reset]").click()
        try:
            await page.wait_for_function(_ALL_SHOWN, timeout=5_000)
        except TimeoutError:
            lines.append("clear does not show all items again")
        return lines


async def folds(context: BrowserContext, html: Path) -> list[str]:
    """A fold of a card opens by a click and by a key, and on paper all are open."""
    async with visit(context, _an_item(html)) as made:
        page = made.page
        fold = page.locator(".ledger-item details").first
        head = fold.locator("summary").first
        lines = []
        for act, how in ((head.click, "a click"), (lambda: head.press("Enter"), "Enter")):
            before = await fold.evaluate("(one) => one.open")
            await act()
            if await fold.evaluate("(one) => one.open") == before:
                lines.append(f"{how} does not turn a fold")
        await page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
        closed = await page.locator("article details:not([open])").count()
        if closed:
            lines.append(f"{closed} folds stay closed on paper")
        return lines


async def copying(context: BrowserContext, html: Path) -> list[str]:
    """The button beside a citation copies exactly its text."""
    async with visit(context, _an_item(html)) as made:
        page = made.page
        await page.evaluate(_UNFOLD)
        block = page.locator(".ledger-cite .highlight").first
        if not await block.count():
            return ["no citation to copy"]
        await block.hover()
        button = block.locator("button.copybtn")
        if not await button.count():
            return ["no button that copies beside a citation"]
        await button.click()
        await page.evaluate(
            "() => { const box = document.createElement('textarea'); box.id = 'paste';"
            " document.querySelector('article').prepend(box); box.focus(); }"
        )
        await page.keyboard.press("Control+V")
        got = (await page.locator("#paste").input_value()).strip()
        wanted = (await block.locator("pre").text_content() or "").strip()
        return [] if got and got == wanted else [f"copied {got[:60]!r} instead of {wanted[:60]!r}"]


async def search(context: BrowserContext, html: Path) -> list[str]:
    """The search finds an item by a printed number and by its name, and leads there."""
    item = _an_item(html)
    async with visit(context, item) as made:
        number = await made.page.evaluate(_NUMBER)
    lines = []
    page_name = f"items/{item.stem}"
    for words in filter(None, (number, item.stem)):
        async with visit(context, html / "search.html", f"?q={words}") as made:
            page = made.page
            hit = page.locator(f"#search-results a[href*='{page_name}.html']")
            try:
                await hit.first.wait_for(timeout=30_000)
            except TimeoutError:
                lines.append(f"{words!r} does not find {page_name}")
                continue
            await hit.first.click()
            await page.wait_for_url(f"**/{page_name}.html*")
    return lines


async def dark_mode(context: BrowserContext, html: Path) -> list[str]:
    """The button of the theme turns the page dark, and the next page is dark as well."""
    async with visit(context, html / "ledger.html") as made:
        page, lines = made.page, []
        button = page.locator("button.theme-switch-button:visible").first
        for _ in range(3):
            if await page.evaluate("() => document.documentElement.dataset.mode") == "dark":
                break
            await button.click()
        await page.wait_for_timeout(300)
        if await page.evaluate(_GROUND) > DARK:
            lines.append("the button does not turn the page dark")
        await page.goto(html.joinpath("intro.html").resolve().as_uri())
        if await page.evaluate(_GROUND) > DARK:
            lines.append("the next page is not dark")
        await page.evaluate("() => localStorage.clear()")
        return lines


USES: dict[str, Use] = {
    "ledger": filters,
    "a fold": folds,
    "a citation": copying,
    "search": search,
    "dark mode": dark_mode,
    "a newcomer": newcomer.walk,
}


async def use(context: BrowserContext, html: Path, report: Report) -> None:
    """Try all of it, one after the other, since some of it leaves a trace in the browser."""
    for name, act in USES.items():
        try:
            found = await act(context, html)
        except Exception as error:  # a step that cannot be done is a problem of the book
            found = [f"{type(error).__name__}: {str(error).splitlines()[0][:200]}"]
        report.add("use", name, found)


def _an_item(html: Path) -> Path:
    """The page of an item with a printed table, if there is one."""
    pages = sorted(p for p in html.joinpath("items").glob("*.html") if ".scene" not in p.name)
    if not pages:
        raise FileNotFoundError(f"{html}: no page of an item")
    tables = [page for page in pages if "ledger-print" in page.read_text(encoding="utf-8")]
    return (tables or pages)[0]
