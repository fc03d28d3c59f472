"""Every check of the built book can fail: a healthy book, and a change per kind of violation."""

from pathlib import Path

import check_book
import pandas as pd
import pytest

COUNTS = pd.DataFrame({"reproduced": [1, 1], "total": [1, 1]}, index=["toy", "total"])
RECORD = {"id": "toy.tab01", "verdict": "reproduced"}
INTRO = """<html><head><link href="_static/a.css" rel="stylesheet"></head><body>
<table id="verdict-counts"><tr><th>verdict</th><th>toy</th><th>total</th></tr>
<tr><th>reproduced</th><td>1</td><td>1</td></tr><tr><th>total</th><td>1</td><td>1</td></tr></table>
<a href="toy/page.html">page</a></body></html>"""
PAGE = """<html><body><div id="toy.tab01"><span class="verdict verdict-reproduced">ok</span>
<table><tr><td>obtained</td><td>2.784</td></tr></table></div>
<img src="data:image/png;base64,AA==" alt="a curve">
<div class="cell_output"><pre>2.784</pre><a href="../intro.html#verdict-counts">all</a></div>
</body></html>"""
STATUS = """<html><body><table><tr><th>Document</th><th>Status</th></tr>
<tr><td>intro</td><td>✅</td></tr><tr><td>toy/page</td><td>✅</td></tr></table></body></html>"""


@pytest.fixture
def html(tmp_path):
    for name, text in {
        "intro.html": INTRO,
        "toy/page.html": PAGE,
        "status.html": STATUS,
        "_static/a.css": "p { background: url(data:image/png;base64,AA==) }",
        "_static/a.js": 'const svg = "http://www.w3.org/2000/svg"; fetch("local.json")',
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path


def change(html: Path, page: str, old: str, new: str) -> dict:
    """Replace a piece of a file and read all pages again."""
    path = html / page
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    return check_book.read_pages(html)


def test_healthy_book_has_no_violation(html):
    pages = check_book.read_pages(html)
    assert check_book.missing_pages(pages, ["intro", "toy/page"]) == []
    assert check_book.misplaced_items(pages, {"toy.tab01": "toy/page"}) == []
    assert check_book.wrong_cards(pages, "toy/page", RECORD, ["obtained 2.784"]) == []
    assert check_book.wrong_counts(pages, "intro", COUNTS) == []
    assert check_book.broken_links(pages, html) == []
    assert check_book.images_without_alt(pages) == []
    assert check_book.not_executed(pages, "status", ["intro", "toy/page"]) == []
    assert check_book.failed_outputs(pages) == []
    assert check_book.network_use(pages, html) == []
    assert check_book.machine_paths(html, [Path("/home/someone")]) == []
    assert check_book.over_budget(html) == []


def test_missing_page(html):
    pages = check_book.read_pages(html)
    assert check_book.missing_pages(pages, ["intro", "toy/other"]) == [
        "toy/other: listed in _toc.yml, not built"
    ]


@pytest.mark.parametrize(
    ("page", "old", "new", "where"),
    [
        ("toy/page.html", 'id="toy.tab01"', 'id="toy.tab02"', "no page"),
        ("intro.html", '<a href="toy', '<p id="toy.tab01"></p><a href="toy', "intro, toy/page"),
        ("toy/page.html", "<img", '<p id="toy.tab01"></p><img', "toy/page, toy/page"),
    ],
)
def test_item_must_stand_once_on_its_page(html, page, old, new, where):
    lines = check_book.misplaced_items(change(html, page, old, new), {"toy.tab01": "toy/page"})
    assert lines == [f"toy.tab01: declared for toy/page, found on {where}"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('id="toy.tab01"', "", "no card of toy.tab01"),
        ("verdict-reproduced", "verdict-undecidable", "does not show reproduced"),
        ("<td>2.784</td>", "<td>2.785</td>", "does not show '2.784'"),
    ],
)
def test_card_must_show_the_record(html, old, new, message):
    pages = change(html, "toy/page.html", old, new)
    (line,) = check_book.wrong_cards(pages, "toy/page", RECORD, ["2.784"])
    assert message in line


@pytest.mark.parametrize(("old", "new"), [("<td>1</td>", "<td>2</td>"), ("verdict-counts", "x")])
def test_counts_must_be_those_of_the_registry(html, old, new):
    assert check_book.wrong_counts(change(html, "intro.html", old, new), "intro", COUNTS)


@pytest.mark.parametrize("new", ["../intro.html#elsewhere", "intro.html#verdict-counts"])
def test_link_of_an_output_must_lead_somewhere(html, new):
    pages = change(html, "toy/page.html", "../intro.html#verdict-counts", new)
    assert check_book.broken_links(pages, html) == [f"toy/page: the link {new} leads nowhere"]


def test_link_of_an_output_may_lead_down_its_page(html):
    pages = change(html, "toy/page.html", "../intro.html#verdict-counts", "#toy.tab01")
    assert check_book.broken_links(pages, html) == []
    pages = change(html, "toy/page.html", "#toy.tab01", "#toy.tab02")
    assert len(check_book.broken_links(pages, html)) == 1


def test_link_of_an_output_may_choose_what_the_ledger_shows(html):
    old = "../intro.html#verdict-counts"
    pages = change(html, "toy/page.html", old, "../intro.html#verdict=adopted")
    assert check_book.broken_links(pages, html) == []
    pages = change(html, "toy/page.html", "../intro.html#", "../nowhere.html#")
    assert len(check_book.broken_links(pages, html)) == 1


@pytest.mark.parametrize("name", ["ledger-legend", "ledger-line", "ledger-findings"])
def test_a_verdict_in_words_is_no_failure(html, name):
    told = f'<pre>2.784</pre><p class="{name}">not found: no choice</p>'
    assert check_book.failed_outputs(change(html, "toy/page.html", "<pre>2.784</pre>", told)) == []
    pages = change(html, "toy/page.html", name, "elsewhere")
    assert len(check_book.failed_outputs(pages)) == 1


def test_link_of_an_output_may_lead_to_a_file(html):
    pages = change(html, "toy/page.html", "../intro.html#verdict-counts", "../_static/all.zip")
    assert check_book.broken_links(pages, html) == [
        "toy/page: the link ../_static/all.zip leads nowhere"
    ]
    (html / "_static").mkdir(exist_ok=True)
    (html / "_static/all.zip").write_bytes(b"")
    assert check_book.broken_links(pages, html) == []


@pytest.mark.parametrize(
    ("scene", "count"),
    [
        ('<img class="scene-still" alt="x" src="data:image/webp;base64,AA==">', 0),
        ("<canvas></canvas>", 1),
        ('<img class="scene-still" alt="x" src="">', 1),
        ('<img class="scene-still" alt="x" src="data:image/webp;base64,' + "A" * 300_000 + '">', 1),
    ],
)
def test_scene_needs_a_still_picture_and_is_small(html, scene, count):
    figure = f'<figure class="ledger-scene">{scene}</figure></body>'
    pages = change(html, "toy/page.html", "</body>", figure)
    assert len(check_book.faulty_scenes(pages)) == count


@pytest.mark.parametrize("alt", ["", 'alt=""', 'alt="  "'])
def test_image_needs_alternative_text(html, alt):
    pages = change(html, "toy/page.html", 'alt="a curve"', alt)
    assert len(check_book.images_without_alt(pages)) == 1


@pytest.mark.parametrize(
    ("old", "new"),
    [("<td>toy/page</td><td>✅</td>", ""), ("<td>✅</td></tr></table>", "<td>❌</td>")],
)
def test_every_notebook_is_executed(html, old, new):
    pages = change(html, "status.html", old, new)
    assert check_book.not_executed(pages, "status", ["intro", "toy/page"]) == [
        "toy/page: a notebook that was not executed"
    ]


@pytest.mark.parametrize(
    "new",
    [
        "<pre>Traceback (most recent call last)</pre>",
        "<pre>Key: x not found</pre>",
        '</div><div class="system-message">undefined label</div><div>',
    ],
)
def test_output_must_not_be_a_failure(html, new):
    pages = change(html, "toy/page.html", "<pre>2.784</pre>", new)
    assert len(check_book.failed_outputs(pages)) == 1


@pytest.mark.parametrize(
    "new",
    [
        '<script src="https://cdn.example.org/a.js"></script>',
        '<link rel="stylesheet" href="//cdn.example.org/a.css">',
        '<img alt="x" src="http://example.org/a.png">',
        '<iframe src="https://example.org"></iframe>',
        '<a href="https://example.org">elsewhere</a>',
        '<p style="background: url(https://example.org/a.png)"></p>',
        '<style>@import "https://example.org/a.css";</style>',
        '<script>fetch("https://example.org/data.json")</script>',
        '<iframe srcdoc="&lt;script src=&quot;https://example.org/a.js&quot;&gt;"></iframe>',
    ],
)
def test_page_must_not_use_the_network(html, new):
    pages = change(html, "toy/page.html", "<img", f"{new}<img")
    assert len(check_book.network_use(pages, html)) == 1


@pytest.mark.parametrize(
    ("file", "new"),
    [
        ("a.css", 'p { background: url("https://example.org/a.woff") }'),
        ("a.css", "@import url(//example.org/a.css);"),
        ("a.js", 'import("https://example.org/a.js")'),
        ("a.js", 'import x from "https://example.org/a.js"'),
        ("a.js", 's.src = "https://example.org/a.js"'),
        ("a.js", 'request.open("GET", "http://example.org")'),
        ("a.js", 'new WebSocket("wss://example.org")'),
    ],
)
def test_asset_must_not_use_the_network(html, file, new):
    (html / "_static" / file).write_text(new, encoding="utf-8")
    assert len(check_book.network_use(check_book.read_pages(html), html)) == 1


def test_page_must_not_name_folders_of_the_machine(html):
    change(html, "toy/page.html", "2.784", "/home/someone/arm.urdf")
    lines = check_book.machine_paths(html, [Path("/home/someone")])
    assert lines == ["toy/page.html: names /home/someone"]


def test_bytes_are_limited(html):
    size = max(path.stat().st_size for path in html.rglob("*.html"))
    assert len(check_book.over_budget(html, page=size - 1)) == 1
    assert check_book.over_budget(html, page=size) == []
    (line,) = check_book.over_budget(html, book=100)
    assert line.startswith("book: ")


@pytest.mark.parametrize(
    "said",
    [
        '<dl class="ledger-line"><dd>not found in 300 tries</dd></dl>',
        '<details class="ledger-source"><pre>if not found:</pre></details>',
        '<div class="refused-files"><td>child link [Z] not found</td></div>',
    ],
    ids=["a verdict", "code", "a refused file"],
)
def test_words_of_a_verdict_of_code_and_of_a_refusal_are_no_failure(html, said):
    pages = change(html, "toy/page.html", "<pre>2.784</pre>", said)
    assert check_book.failed_outputs(pages) == []
    pages = change(html, "toy/page.html", said, said + "<p>file not found</p>")
    assert check_book.failed_outputs(pages) == ["toy/page: an output shows 'not found'"]
