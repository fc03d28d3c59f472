"""A page of the book opened from its file, with everything the browser said while it was open."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote, urlsplit
from weakref import WeakKeyDictionary

from playwright.async_api import BrowserContext, ConsoleMessage, Page, Request

WIDE = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
#: Milliseconds after which a page that does not get ready is a problem.
PATIENCE = 60_000
_AT_HOME = ("file", "data", "blob", "about")
#: Until the page is loaded and its formulas are typeset.
READY = """async () => {
  if (document.readyState !== "complete") await new Promise((go) => addEventListener("load", go));
  if (window.MathJax?.startup?.promise) await MathJax.startup.promise;
}"""
#: Tabs that are open and idle: a new one for every page would take longer than the page.
_idle: WeakKeyDictionary[BrowserContext, list[Page]] = WeakKeyDictionary()


@dataclass
class Visit:
    """An open page and what happened on it."""

    page: Page
    said: list[str] = field(default_factory=list)
    files: set[Path] = field(default_factory=set)

    def _console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.said.append(f"console: {message.text[:200]}")

    def _error(self, error: Exception) -> None:
        self.said.append(f"script error: {str(error)[:200]}")

    def _request(self, request: Request) -> None:
        address = urlsplit(request.url)
        if address.scheme not in _AT_HOME:
            self.said.append(f"external request: {request.url[:200]}")
        elif address.scheme == "file":
            self.files.add(Path(unquote(address.path)))

    def _failed(self, request: Request) -> None:
        self.said.append(f"failed request: {request.url[-120:]} ({request.failure})")

    def listen(self, on: bool) -> None:
        """Begin or end to write down what happens."""
        handlers = {
            "console": self._console,
            "pageerror": self._error,
            "request": self._request,
            "requestfailed": self._failed,
        }
        for event, handler in handlers.items():
            (self.page.on if on else self.page.remove_listener)(event, handler)


@asynccontextmanager
async def visit(
    context: BrowserContext, path: Path, query: str = "", ready: str = READY
) -> AsyncIterator[Visit]:
    """Open a page and wait for what makes it ready; the tab is used again."""
    idle = _idle.setdefault(context, [])
    page = idle.pop() if idle else await context.new_page()
    page.set_default_timeout(PATIENCE)
    made = Visit(page)
    made.listen(True)
    try:
        await page.goto(path.resolve().as_uri() + query)
        await page.evaluate(ready)
        yield made
    except BaseException:
        await page.close()  # whatever state it is in
        raise
    made.listen(False)
    idle.append(page)
