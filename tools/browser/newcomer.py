"""The way of somebody who opens the book for the first time, walked and counted.

From the front page to the verdict on Table 2 of ``xue``, its reason, the code behind it, a run with
one assumption changed and the citation. Every step starts from what is on the screen.
"""

from __future__ import annotations

from pathlib import Path

from playwright.async_api import BrowserContext, Locator, Page

from .visit import visit

START, ITEM = "intro", "xue.tab02"
#: Clicks and commands that the whole way may take.
MOST = 5
#: Milliseconds within which a thing on the way has to be seen.
_SOON = 5_000
_VERDICT = ".ledger-item .ledger-line .verdict"
_REASONS = ".ledger-item .ledger-checks li"


class Way:
    """Steps taken so far."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.steps: list[str] = []

    async def click(self, what: Locator, name: str) -> None:
        """Click something that is seen."""
        await self.see(what, name)
        await what.first.click()
        self.steps.append(name)

    async def see(self, what: Locator, name: str) -> str:
        """The text of something that has to be on the screen, or can be scrolled to.

        Raises
        ------
        LookupError
            It is not there.
        """
        try:
            await what.first.wait_for(state="visible", timeout=_SOON)
        except Exception:
            raise LookupError(f"{name} is not to be seen after: {', '.join(self.steps)}") from None
        return (await what.first.text_content() or "").strip()

    async def unfold(self, title: str) -> Locator:
        """Open the fold of the card with this title."""
        fold = self.page.locator(".ledger-item details").filter(
            has=self.page.locator(":scope > summary", has_text=title)
        )
        await self.click(fold.first.locator("> summary"), f"the fold {title}")
        return fold.first


async def walk(context: BrowserContext, html: Path) -> list[str]:
    """Walk the way; what is in it, and a line if it is too long."""
    async with visit(context, html / f"{START}.html") as made:
        way = Way(made.page)
        try:
            await _all_steps(way)
        except LookupError as error:
            return [str(error)]
    steps = ", ".join(way.steps)
    return [f"{len(way.steps)} steps: {steps}"] if len(way.steps) > MOST else []


async def _all_steps(way: Way) -> None:
    page = way.page
    cell = page.locator(f".ledger-picture a[href*='items/{ITEM}.html']")
    await way.click(cell, "its cell in the picture of all verdicts")
    await page.wait_for_url(f"**/items/{ITEM}.html*")
    await way.see(page.locator(_VERDICT), "the verdict")
    await way.unfold("What was checked")
    await way.see(page.locator(_REASONS), "the reason")
    code = await way.unfold("Code")
    await way.see(code.locator(".highlight").first, "the code")
    command = code.locator("pre", has_text=f"dualarm run {ITEM} --set ")
    told = await way.see(command, "the command with an assumption changed")
    way.steps.append(told.splitlines()[-1])
    cite = await way.unfold("Cite")
    await way.see(cite.locator("pre", has_text="@"), "the citation")
