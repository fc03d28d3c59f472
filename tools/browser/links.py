"""Every link and download of every page leads to a file of the book, and to a place in it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from html import unescape
from pathlib import Path
from urllib.parse import unquote, urlsplit

_TAG = re.compile(r"<(a|link|img|script|iframe|source)\s[^>]*>", re.IGNORECASE)
_TARGET = re.compile(r'\s(?:href|src)="([^"]*)"', re.IGNORECASE)
_PLACE = re.compile(r'\s(?:id|name)="([^"]+)"', re.IGNORECASE)
#: Places that a script or the browser itself makes.
_MADE = ("", "top")


@cache
def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@cache
def places(path: Path) -> frozenset[str]:
    """Anchors of a page."""
    return frozenset(unescape(found) for found in _PLACE.findall(_text(path)))


def targets(path: Path) -> Iterator[str]:
    """Addresses that a page names in links, pictures, scripts and frames."""
    for tag in _TAG.finditer(_text(path)):
        if found := _TARGET.search(tag[0]):
            yield unescape(found[1])


def dead_links(path: Path, html: Path) -> list[str]:
    """Addresses of a page that lead to no file, out of the book, or to no place in a page."""
    lines = []
    for target in dict.fromkeys(targets(path)):
        parts = urlsplit(target)
        if parts.scheme in ("data", "mailto", "javascript") or target.startswith("#"):
            there, place = path, parts.fragment
            if parts.scheme:
                continue
        elif parts.scheme or parts.netloc:
            lines.append(f"leaves the book: {target[:120]}")
            continue
        else:
            there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            place = parts.fragment
        if not there.is_file() or not there.is_relative_to(html.resolve()):
            lines.append(f"no such file: {target[:120]}")
        elif place and there.suffix == ".html" and unquote(place) not in places(there):
            if place not in _MADE and "=" not in place:
                lines.append(f"no such place: {target[:120]}")
    return lines
