"""Pictures that are files are referred to; what no browser loads is not in the book."""

from base64 import b64encode
from types import SimpleNamespace

import smaller_book

SVG, OTHER = b"<svg/>", b"<svg>other</svg>"


def image(data):
    return f'<img src="data:image/svg+xml;base64,{b64encode(data).decode()}" alt="a">'


def build(html):
    builder, env = SimpleNamespace(format="html"), SimpleNamespace(found_docs={"xue/page", "gone"})
    return SimpleNamespace(outdir=html, builder=builder, env=env)


def test_a_picture_of_an_item_becomes_a_reference(tmp_path):
    for folder in ("items", "xue", "_static/fonts/webfonts"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "items/xue.fig01.svg").write_bytes(SVG)
    page = tmp_path / "xue/page.html"
    page.write_text(image(SVG) + image(OTHER))
    unused = [tmp_path / "_static/a.js.map", tmp_path / "_static/fonts/webfonts/a.ttf"]
    used = [tmp_path / "_static/a.js", tmp_path / "_static/fonts/webfonts/a.woff2"]
    for path in (*unused, *used):
        path.write_text("")
    smaller_book.shrink(build(tmp_path), None)
    assert page.read_text() == '<img src="../items/xue.fig01.svg" alt="a">' + image(OTHER)
    assert [path.exists() for path in (*unused, *used)] == [False, False, True, True]


def test_a_build_that_failed_is_left_as_it_is(tmp_path):
    (tmp_path / "a.map").write_text("")
    smaller_book.shrink(build(tmp_path), ValueError())
    assert (tmp_path / "a.map").exists()
