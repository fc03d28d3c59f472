"""Pages of the book on paper, printed by the browser: folds open, pictures instead of scenes."""

from __future__ import annotations

from pathlib import Path

from playwright.async_api import BrowserContext, Page

from .page_checks import set_theme
from .scenes import APART, LOOKS, SCENES, drawn, picture, pixels
from .visit import visit

_PICTURE = """(frame, source) => {
  const picture = document.createElement("img");
  picture.src = source;
  picture.alt = frame.title;
  picture.style.maxWidth = "100%";
  frame.replaceWith(picture);
  return picture.decode();
}"""
_LOADED = "() => Promise.all([...document.images].map((one) => one.decode().catch(() => {})))"


#: In a book with contents no page needs its own.
_BOUND = "#jb-print-toc { display: none; }"


async def print_page(context: BrowserContext, source: Path, target: Path) -> None:
    """One page of a bound book as a PDF."""
    async with visit(context, source) as made:
        page = made.page
        await set_theme(page, "light")
        await page.add_style_tag(content=_BOUND)
        await _picture_scenes(page)
        await print_open(page, target)


async def print_open(page: Page, target: Path) -> None:
    """What is open in a tab as a PDF, as a reader's *print* gives it."""
    await page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
    await page.evaluate(
        "() => document.querySelectorAll('img').forEach((one) => (one.loading = 'eager'))"
    )
    await page.evaluate(_LOADED)
    await page.pdf(path=target, prefer_css_page_size=True, print_background=True)


async def _picture_scenes(page: Page) -> None:
    """Put a picture in the place of every scene, since paper does not draw WebGL.

    The context has to be prepared by ``scenes.spare``.
    """
    frames = page.locator(SCENES)
    while count := await frames.count():
        frame = frames.first
        await frame.evaluate("(one) => one.scrollIntoView({block: 'center'})")
        for _ in range(LOOKS):
            if drawn(pixels(data := await picture(frame))):
                break
            await page.wait_for_timeout(APART)
        await frame.evaluate(_PICTURE, data)
        if await frames.count() >= count:
            raise RuntimeError("a scene could not be replaced by its picture")
