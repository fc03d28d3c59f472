"""A page read without scripts: its words and its pictures are there."""

from __future__ import annotations

from pathlib import Path

from playwright.async_api import BrowserContext

from .report import Report
from .visit import visit

#: Share of the words with scripts that is left without. Formulas do not count: typeset they are
#: one word a symbol, and without scripts they are their source.
LEAST_WORDS = 0.9
#: What an open page says: its words, and the pictures of it that are blank.
READ = """() => {
  const count = (part) => (part?.innerText.match(/\\S+/g) || []).length;
  const formulas = [...document.querySelectorAll("article .math")].map(count);
  return {
    words: count(document.querySelector("article")) - formulas.reduce((a, b) => a + b, 0),
    blank: [...document.querySelectorAll("article img")]
      .filter((one) => one.complete && !one.naturalWidth).length,
  };
}"""


async def read_page(
    plain: BrowserContext, html: Path, name: str, usual: int, report: Report
) -> None:
    """Compare what a page says without scripts with the number of its words with them."""
    async with visit(plain, html / f"{name}.html", ready="() => true") as made:
        without = await made.page.evaluate(READ)
    lines = []
    if without["words"] < LEAST_WORDS * usual or not without["words"]:
        lines.append(f"{without['words']} of {usual} words without scripts")
    if without["blank"]:
        lines.append(f"{without['blank']} pictures are blank")
    report.add("scripts", name, lines)
