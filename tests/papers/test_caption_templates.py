"""Long captions stand in templates beside the pages, whose blocks are those that are used."""

import ast
import re
from pathlib import Path

import pytest

import dualarm_repro

PAPERS = Path(dualarm_repro.__file__).parent / "papers"
PAGES = sorted(PAPERS.glob("*/pages/**/*.py"))
_SENTENCE_ENDS = re.compile(r"[a-z0-9)%]\.(?= [A-Z{]| *$)")
#: A caption in the code has no more sentences than this.
MOST_SENTENCES = 2


def blocks(template: Path) -> set[str]:
    source = template.read_text(encoding="utf-8") if template.is_file() else ""
    return set(re.findall(r"{%-? block (\w+)", source))


def words(code: ast.AST) -> str:
    """The texts of an expression; a placeholder counts as a word."""
    if isinstance(code, ast.Constant):
        return code.value if isinstance(code.value, str) else ""
    if isinstance(code, ast.FormattedValue):
        return "{x"
    return "".join(words(child) for child in ast.iter_child_nodes(code))


def sentences(source: str) -> list[tuple[int, int]]:
    """Line and number of sentences of every ``caption=`` of a module."""
    return [
        (node.value.lineno, len(_SENTENCE_ENDS.findall(words(node.value))))
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.keyword) and node.arg == "caption"
    ]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(PAPERS)))
def test_blocks_and_their_uses(page):
    source = page.read_text(encoding="utf-8")
    template = page.with_suffix(".j2")
    named = {
        node.value
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    there = blocks(template)
    inner = set(re.findall(r"self\.(\w+)\(\)", template.read_text())) if there else set()
    assert there <= named | inner, "a block that nothing fills"
    used = set(re.findall(r'\bcaption\(\s*"(\w+)"', source))
    assert used <= there, "a block that is not there"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(PAPERS)))
def test_captions_in_the_code_are_short(page):
    long = [
        found for found in sentences(page.read_text(encoding="utf-8")) if found[1] > MOST_SENTENCES
    ]
    assert long == [], "line and sentences: into the template beside the page"


def test_every_template_has_a_page():
    for template in PAPERS.rglob("*.j2"):
        assert template.with_suffix(".py").is_file(), template


def test_sentences_are_counted():
    assert sentences('Result(caption=f"{a} of {b} miss. The rest hold. All are {c}. No.")') == [
        (1, 4)
    ]
    assert sentences('Result(caption="One " + f"at {x:.2f} m. Two.")') == [(1, 2)]
