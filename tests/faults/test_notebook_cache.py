"""The cache of executed notebooks: what is damaged is executed again, what is whole is kept."""

import re

import nbformat
import pytest
from jupyter_cache import get_cache
from jupyter_cache.cache.main import CacheBundleIn
from notebook_cache import REGISTER, SEALS, open_cache, seal


@pytest.fixture
def filled(tmp_path):
    """A sealed cache of two notebooks."""
    cache = get_cache(tmp_path / "cache")
    for k in range(2):
        outputs = [nbformat.v4.new_output("stream", text=f"{k}\n")]
        cell = nbformat.v4.new_code_cell(f"print({k})", execution_count=1, outputs=outputs)
        notebook = nbformat.v4.new_notebook(cells=[cell])
        cache.cache_notebook_bundle(CacheBundleIn(notebook, f"page{k}"))
    seal(cache, tmp_path / "cache")
    return tmp_path / "cache"


def kept(folder):
    return sorted(entry.uri for entry in open_cache(folder).list_cache_records())


def notebook(folder):
    return sorted((folder / "executed").rglob("*.ipynb"))[0]


def test_what_is_whole_is_kept(filled):
    assert kept(filled) == ["page0", "page1"]
    assert kept(filled / "new") == []


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe\x00", b"[]", None])
def test_a_notebook_that_cannot_be_read(filled, content):
    path = notebook(filled)
    path.unlink() if content is None else path.write_bytes(content)
    assert len(kept(filled)) == 1
    assert len(kept(filled)) == 1


def test_another_output_is_seen(filled):
    path = notebook(filled)
    content = path.read_text()
    path.write_text(re.sub(r'"[01]\\n"', r'"7\\n"', content))
    assert path.read_text() != content
    assert len(kept(filled)) == 1


@pytest.mark.parametrize("content", [b"", b"x" * 4096, b"SQLite format 3\x00" + b"\x07" * 4000])
def test_a_register_that_is_no_database(filled, content):
    (filled / REGISTER).write_bytes(content)
    assert kept(filled) == []
    seal(open_cache(filled), filled)


@pytest.mark.parametrize("name", [REGISTER, SEALS, "pages.json"])
def test_a_file_that_is_a_folder(filled, name):
    (filled / name).unlink(missing_ok=True)
    (filled / name).mkdir()
    assert kept(filled) == []


@pytest.mark.parametrize("content", ["", "[]", "{"])
def test_without_seals_a_notebook_is_believed_that_can_be_read(filled, content):
    (filled / SEALS).write_text(content)
    assert kept(filled) == ["page0", "page1"]
