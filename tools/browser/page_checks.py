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
_AXE = """(rules) => axe.run(document, Object.assign(
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
    path = html / f"{name}.html"
    async with visit(context, path) as made:
        page = made.page
        words = (await page.evaluate(READ))["words"]
        report.add("maths", name, await page.evaluate(_MATHS))
        await page.evaluate(_UNFOLD, name.startswith("items/"))
        wide = await _widths(page, closely, report, name)
        report.add("width", name, wide)
        report.add("console", name, dict.fromkeys(made.said))
        report.add("size", name, _too_large(made.files, html))
        return words


async def _widths(page: Page, closely: bool, report: Report, name: str) -> list[str]:
    """Width in every state, and on the way accessibility where the screen is wide."""
    found, unfriendly = [], []
    for theme in ("light", "dark"):
        await set_theme(page, theme)
        if closely:
            rules = ["color-contrast"] if theme == "dark" else None  # the rest knows no colours
            unfriendly += [f"{theme}: {text}" for text in await unfriendly_to(page, rules)]
        for size in (WIDE, PHONE):
            await page.set_viewport_size(size)
            found += [f"{theme}, {text}" for text in await page.evaluate(_TOO_WIDE)]
        await page.set_viewport_size(WIDE)
    if closely:
        report.add("access", name, unfriendly)
    return found


async def set_theme(page: Page, theme: str) -> None:
    """Light or dark, as the button of the theme does it."""
    await page.evaluate(
        "(theme) => Object.assign(document.documentElement.dataset, {theme, mode: theme})", theme
    )
    await page.evaluate("() => Promise.all(document.getAnimations().map((one) => one.finish()))")


async def unfriendly_to(page: Page, rules: Collection[str] | None = None) -> list[str]:
    """Serious and critical findings of axe-core, all rules or some."""
    if not await page.evaluate("() => Boolean(window.axe)"):
        await page.evaluate(axe_script())
    found: dict[str, Any] = await page.evaluate(_AXE, list(rules) if rules else None)
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
