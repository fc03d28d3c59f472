"""Templates of sentences: filled on one line, refused where a value is missing."""

import pytest

from dualarm_repro.errors import LedgerError
from dualarm_repro.view.sentences import close_up, condition, fill


def test_a_template_is_filled_on_one_line():
    text = "It is {{ x | number }} m\n  in {{ share | percent }}, {{ names | words }}."
    assert fill(text, "here", x=0.123456, share=0.25, names=["a", "b"]) == (
        "It is 0.123 m in 25 %, (a, b)."
    )


@pytest.mark.parametrize(
    "text", ["{{ missing }}", "{{ x.y }}", "{{ x | nothing }}", "{{ x", "{{ x + 'a' }}"]
)
def test_what_cannot_be_filled_names_its_source(text):
    with pytest.raises(LedgerError, match=r"^findings\.yaml, it: "):
        fill(text, "findings.yaml, it", x=1)


@pytest.mark.parametrize(
    ("text", "true"),
    [("x > 1", True), ("x > 2", False), ("x.y > 1", False), ("y > 1", False), ("x / 0 > 1", False),
     ("x > 'a'", False), ("x in [2, 3]", True), ("not x", False), ("'a' in names", True)],
)  # fmt: skip
def test_a_condition_that_cannot_be_told_does_not_hold(text, true):
    assert condition(text, "here")(x=2, names=["a"]) is true


def test_no_expression_is_refused():
    with pytest.raises(LedgerError, match=r"^here: .*x >"):
        condition("x >", "here")


@pytest.mark.parametrize(
    ("text", "closed"),
    [("势场， 传统", "势场，传统"), ("有 8 次", "有 8 次"), ("a b", "a b"), ("“甲” 与", "“甲”与")],
)
def test_spaces_go_away_between_chinese_signs_only(text, closed):
    assert close_up(text) == closed
    assert close_up(closed) == closed
