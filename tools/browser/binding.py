"""Printed pages bound to one PDF: contents, page numbers, bookmarks, and links that stay inside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from urllib.parse import unquote, urlsplit

from jinja2 import Environment, FileSystemLoader
from pypdf import PdfReader, PdfWriter
from pypdf.generic import ArrayObject, DictionaryObject, NameObject, NumberObject

_TEMPLATES = Environment(loader=FileSystemLoader(Path(__file__).parent), autoescape=True)


@dataclass(frozen=True)
class Sheet:
    """A printed page of the book: where it stands in the contents, and its PDF."""

    name: str
    title: str
    part: str
    level: int
    pdf: Path


def first_pages(sheets: Sequence[Sheet], before: int) -> dict[str, int]:
    """Number of the first sheet of paper of every page, counted from 1.

    Parameters
    ----------
    before
        Sheets of paper taken by title and contents.
    """
    found, count = {}, before + 1
    for sheet in sheets:
        found[sheet.name] = count
        count += len(PdfReader(sheet.pdf).pages)
    return found


def contents_html(
    title: str, note: str, sheets: Sequence[Sheet], first: Mapping[str, int], html: Path
) -> str:
    """Title and contents, with a link to every page."""
    lines = [
        (sheet, (html / f"{sheet.name}.html").resolve().as_uri(), first[sheet.name])
        for sheet in sheets
    ]
    parts = [(part, list(group)) for part, group in groupby(lines, key=lambda one: one[0].part)]
    return _TEMPLATES.get_template("contents.html").render(title=title, note=note, parts=parts)


def numbers_html(count: int) -> str:
    """As many empty sheets of paper as there are, each with its number."""
    return _TEMPLATES.get_template("numbers.html").render(count=count)


def bind(
    contents: Path, sheets: Sequence[Sheet], numbers: Path, html: Path, title: str, target: Path
) -> int:
    """Write one PDF; the number of its sheets of paper.

    A link to a page that is bound in leads there; one to any other page is no link on paper.
    """
    writer = PdfWriter()
    writer.append(PdfReader(contents), import_outline=False)
    first = first_pages(sheets, len(writer.pages))
    for sheet in sheets:
        writer.append(PdfReader(sheet.pdf), import_outline=False)
    below, part = None, ""
    for sheet in sheets:
        if sheet.part != part:
            part = sheet.part
            below = writer.add_outline_item(title=part, page_number=first[sheet.name] - 1)
        writer.add_outline_item(title=sheet.title, page_number=first[sheet.name] - 1, parent=below)
    for page, number in zip(writer.pages, PdfReader(numbers).pages, strict=True):
        page.merge_page(number)
        _turn_inside(writer, page, first, html.resolve())
    writer.add_metadata({"/Title": title})
    writer.compress_identical_objects(remove_duplicates=True, remove_unreferenced=True)
    writer.write(target)
    return len(writer.pages)


def _turn_inside(
    writer: PdfWriter, page: DictionaryObject, first: Mapping[str, int], html: Path
) -> None:
    kept = ArrayObject()
    for reference in page.get("/Annots", []):
        note = reference.get_object()
        address = urlsplit(str(note.get("/A", {}).get("/URI", "")))
        if address.scheme == "file":
            path = Path(unquote(address.path))
            name = (
                path.relative_to(html).with_suffix("").as_posix()
                if path.is_relative_to(html)
                else ""
            )
            if name not in first:
                continue
            there = writer.pages[first[name] - 1].indirect_reference
            del note["/A"]
            note[NameObject("/Dest")] = ArrayObject([there, NameObject("/FitH"), NumberObject(842)])
        kept.append(reference)
    if "/Annots" in page:
        page[NameObject("/Annots")] = kept
