"""What has to hold of every page: console, formulas, width, size, accessibility."""

from __future__ import annotations

from collections.abc import Collection
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from playwright.async_api import BrowserContext, Page

from .report import Report
from .visit import PHONE, WIDE, visit
from .without_scripts import READ

LARGEST_PAGE = 3_000_000
_SERIOUS = ("serious", "critical")
#: Code is coloured alike everywhere and is slow to look at: it is opened on sampled pages only.
_UNFOLD = """(all) => document.querySelectorAll("details").forEach((one) => {
  one.open = all || !one.matches(".ledger-source");
})"""
_MATHS = """() => [
  ...[...document.querySelectorAll("[data-mjx-error]")].map((one) => one.dataset.mjxError),
  ...[...document.querySelectorAll('mjx-container [mathcolor="red"], mjx-container [fill="red"]')]
    .map((one) => "red: " + one.textContent),
  ...[...document.querySelectorAll(".math")].filter((one) => !one.querySelector("mjx-container"))
    .map((one) => "not typeset: " + one.textContent.slice(0, 80)),
]"""
_TOO_WIDE = """() => {
  const wide = document.documentElement.clientWidth;
  const boxes = document.querySelectorAll("main, article, .bd-content");
  const places = [document.scrollingElement, ...boxes];
  if (places.every((one) => one.scrollWidth <= one.clientWidth + 1)) return [];
  const inside = (one) => {  // a box that scrolls by itself keeps what is in it
    for (let box = one.parentElement; box && !box.matches("article"); box = box.parentElement)
      if (getComputedStyle(box).overflowX !== "visible") return true;
    return false;
  };
  const sticks = (one) => one.getBoundingClientRect().right > wide + 1 ||
    (one.clientWidth && one.scrollWidth > one.clientWidth + 1);
  const found = [...document.querySelectorAll("article *")]
    .filter((one) => sticks(one) && !inside(one) && getComputedStyle(one).overflowX === "visible");
  return [`${document.scrollingElement.scrollWidth} px on ${wide}: ` +
    found.slice(-2).map((one) => one.outerHTML.slice(0, 120)).join(" | ")];
}"""
#: Words that end in dots because their box is too narrow, and code that a wide screen cuts off.
_CUT = """() => [...document.querySelectorAll("article *")]
  .filter((one) => one.scrollWidth > one.clientWidth + 1 &&
    (getComputedStyle(one).textOverflow === "ellipsis" ||
      (innerWidth > 1000 && one.matches(".cell_input pre"))))
  .map((one) => "cut off: " + one.textContent.trim().slice(0, 80))"""
#: Pages of which the frame that all share is looked at as well.
WHOLE = ("intro", "search")
_AXE = """([rules, within]) => axe.run(within || document, Object.assign(
  {resultTypes: ["violations"], iframes: false, preload: false},
  rules ? {runOnly: {type: "rule", values: rules}} : {}))"""


def axe_script() -> str:
    """The script of axe-core, from the installed package."""
    package = Path(find_spec("axe_playwright_python").origin).parent
    return package.joinpath("axe.min.js").read_text(encoding="utf-8")


async def look_at(
    context: BrowserContext, html: Path, name: str, report: Report, *, closely: bool
) -> int:
    """Open a page in both themes and widths and add what is wrong to the report; its words.

    Parameters
    ----------
    closely
        Whether accessibility is checked, too, which takes most of the time.
    """
    unfriendly, wide = [], []
    async with visit(context, html / f"{name}.html") as made:
        page = made.page
        words = (await page.evaluate(READ))["words"]
        report.add("maths", name, await page.evaluate(_MATHS))
        await page.evaluate(_UNFOLD, name.startswith("items/"))
        for size, themes in ((WIDE, ("light", "dark")), (PHONE, ("dark", "light"))):
            await page.set_viewport_size(size)
            wide += [f"{size['width']} px, {text}" for text in await page.evaluate(_CUT)]
            for theme in themes:
                await set_theme(page, theme)
                wide += [f"{theme}, {text}" for text in await page.evaluate(_TOO_WIDE)]
                if closely and size == WIDE:
                    rules = ["color-contrast"] if theme == "dark" else None  # all others know none
                    within = None if name in WHOLE else "main"
                    found = await unfriendly_to(page, rules, within)
                    unfriendly += [f"{theme}: {text}" for text in found]
        await page.set_viewport_size(WIDE)
        report.add("width", name, wide)
        report.add("console", name, dict.fromkeys(made.said))
        report.add("size", name, _too_large(made.files, html))
    if closely:
        report.add("access", name, unfriendly)
    return words


async def set_theme(page: Page, theme: str) -> None:
    """Light or dark, as the button of the theme does it."""
    await page.evaluate(
        "(theme) => Object.assign(document.documentElement.dataset, {theme, mode: theme})", theme
    )
    await page.evaluate("() => Promise.all(document.getAnimations().map((one) => one.finish()))")


async def unfriendly_to(
    page: Page, rules: Collection[str] | None = None, within: str | None = None
) -> list[str]:
    """Serious and critical findings of axe-core: all rules or some, the whole page or a part."""
    if not await page.evaluate("() => Boolean(window.axe)"):
        await page.evaluate(axe_script())
    found: dict[str, Any] = await page.evaluate(_AXE, [rules and list(rules), within])
    return [
        f"{one['id']} ({one['impact']}, {len(one['nodes'])}): {one['nodes'][0]['html'][:160]}"
        for one in found["violations"]
        if one["impact"] in _SERIOUS
    ]


def _too_large(files: Collection[Path], html: Path) -> list[str]:
    """The page and the files that it alone loads."""
    own = [path for path in files if path.is_file() and not path.is_relative_to(html / "_static")]
    total = sum(path.stat().st_size for path in own)
    return [f"{total / 1e6:.1f} MB"] if total > LARGEST_PAGE else []
