"""What a built book would fetch from, or link to, another host."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from lxml import etree
from lxml.html import HtmlElement, document_fromstring

_ATTRIBUTES = ("src", "href", "xlink:href", "srcset", "data", "poster", "action", "formaction")
_HOST = re.compile(r"^\s*(?:https?:|wss?:|ftp:)?//", re.IGNORECASE)
_CODE = re.compile(
    r"""(?:
        (?:url\(|@import)\s*["']?                                      # style sheets
      | \b(?:fetch|import|importScripts|Worker|EventSource|WebSocket)\(\s*["'`]
      | \bfrom\s*["']
      | \.(?:src|href)\s*=\s*["'`]
      | \.open\(\s*["'`][A-Za-z]+["'`]\s*,\s*["'`]
    )\s*(?:https?:|wss?:)?//[^\s"'`)]{0,80}""",
    re.VERBOSE,
)


def in_code(text: str) -> list[str]:
    """Requests to another host in JavaScript or a style sheet; a bare address in a text is none."""
    return [match[0] for match in _CODE.finditer(text)]


def in_page(page: HtmlElement) -> Iterator[str]:
    """Attributes, scripts, styles and embedded documents of a page that name another host."""
    for tag in page.iter(etree.Element):
        for name, value in tag.items():
            if name in _ATTRIBUTES and _HOST.match(value):
                yield f"<{tag.tag} {name}={value!r}>"
            elif name == "style":
                yield from in_code(value)
            elif name == "srcdoc":
                yield from in_page(document_fromstring(value))
        if tag.tag in ("script", "style"):
            yield from in_code(tag.text or "")


def in_assets(html: Path) -> Iterator[str]:
    """The same for the scripts and style sheets of a built book."""
    for path in sorted([*html.rglob("*.js"), *html.rglob("*.css")]):
        text = path.read_text(encoding="utf-8", errors="replace")
        yield from (f"{path.relative_to(html)}: loads {found}" for found in in_code(text))
