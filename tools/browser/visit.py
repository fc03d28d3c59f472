"""A page of the book opened from its file, with everything the browser said while it was open."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote, urlsplit

from playwright.async_api import BrowserContext, ConsoleMessage, Page, Request

WIDE = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
#: Milliseconds after which a page that does not get ready is a problem.
PATIENCE = 30_000
_AT_HOME = ("file", "data", "blob", "about")
#: Until the page is loaded and its formulas are typeset.
READY = """async () => {
  if (document.readyState !== "complete") await new Promise((go) => addEventListener("load", go));
  if (window.MathJax?.startup?.promise) await MathJax.startup.promise;
}"""


@dataclass
class Visit:
    """An open page and what happened on it."""

    page: Page
    said: list[str] = field(default_factory=list)
    files: set[Path] = field(default_factory=set)

    def _console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.said.append(f"console: {message.text[:200]}")

    def _request(self, request: Request) -> None:
        address = urlsplit(request.url)
        if address.scheme not in _AT_HOME:
            self.said.append(f"external request: {request.url[:200]}")
        elif address.scheme == "file":
            self.files.add(Path(unquote(address.path)))

    def _failed(self, request: Request) -> None:
        self.said.append(f"failed request: {request.url[-120:]} ({request.failure})")


@asynccontextmanager
async def visit(
    context: BrowserContext, path: Path, query: str = "", ready: str = READY
) -> AsyncIterator[Visit]:
    """Open a page and wait for what makes it ready."""
    page = await context.new_page()
    made = Visit(page)
    page.on("console", made._console)
    page.on("pageerror", lambda error: made.said.append(f"script error: {str(error)[:200]}"))
    page.on("request", made._request)
    page.on("requestfailed", made._failed)
    page.set_default_timeout(PATIENCE)
    try:
        await page.goto(path.resolve().as_uri() + query)
        await page.evaluate(ready)
        yield made
    finally:
        await page.close()
