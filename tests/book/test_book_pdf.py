"""Printed pages are bound with contents, numbers and bookmarks, and their links stay inside."""

import book_pdf
import pytest
from browser import binding
from browser.binding import Sheet
from pypdf import PdfReader, PdfWriter
from pypdf.annotations import Link


def paper(path, count, *addresses):
    writer = PdfWriter()
    for _ in range(count):
        writer.add_blank_page(595, 842)
    for address in addresses:
        writer.add_annotation(0, Link(rect=(0, 0, 9, 9), url=address))
    writer.write(path)
    return path


@pytest.fixture
def sheets(tmp_path):
    to = (tmp_path / "html/b/two.html").as_uri()
    out = (tmp_path / "html/items/x.html").as_uri()
    return [
        Sheet("one", "One", "", 0, paper(tmp_path / "1.pdf", 2, to + "#place", out)),
        Sheet("b/two", "Two", "Part <B>", 1, paper(tmp_path / "2.pdf", 3)),
    ]


def test_contents_number_the_pages(tmp_path, sheets):
    first = binding.first_pages(sheets, 1)
    assert first == {"one": 2, "b/two": 4}
    text = binding.contents_html("Book", "Note.", sheets, first, tmp_path / "html")
    assert "Part &lt;B&gt;" in text
    assert ">Two<span></span>4</a>" in text
    assert binding.numbers_html(3).count("<div>") == 3


def test_one_pdf_with_bookmarks_and_links_inside(tmp_path, sheets):
    contents, numbers = paper(tmp_path / "c.pdf", 1), paper(tmp_path / "n.pdf", 6)
    target = tmp_path / "book.pdf"
    assert binding.bind(contents, sheets, numbers, tmp_path / "html", "Book", target) == 6
    made = PdfReader(target)
    titles = [
        entry.title
        for part in made.outline
        for entry in (part if isinstance(part, list) else [part])
    ]
    assert titles == ["One", "Part <B>", "Two"]
    assert made.metadata.title == "Book"
    (note,) = made.pages[1]["/Annots"]
    there = note.get_object()["/Dest"][0]
    assert made.get_page_number(there.get_object()) == 3


def test_every_page_of_the_contents_has_a_place(tmp_path):
    (tmp_path / "_toc.yml").write_text(
        "root: intro\nparts:\n- caption: P\n  chapters:\n  - file: a\n"
        "    sections:\n    - file: a/b\n"
    )
    assert list(book_pdf.outline(tmp_path)) == [("intro", "", 0), ("a", "P", 0), ("a/b", "P", 1)]


def test_nothing_to_print_is_said(tmp_path, capsys):
    assert book_pdf.main(["--html", str(tmp_path)]) == book_pdf.NOT_RUN
    assert "NOT MADE" in capsys.readouterr().err
