"""Tests that can fail: each asserts something, and no tolerance is wide without a reason.

A reason is a comment beside the tolerance, on the line above the statement, or above the constant
that holds it.
"""

import ast
import io
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
FILES = sorted(TESTS.rglob("*.py"))
#: Keywords of approximate comparisons, and what needs no reason.
TOLERANCES = {"rel", "abs", "atol", "rtol"}
WIDEST = 1e-3
#: Calls that fail by themselves.
FAILING = {"raises", "warns", "fail", "deprecated_call", "check_call", "check_output"}


def _name(call: ast.Call) -> str:
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _asserts(function: ast.AST, asserting: frozenset[str]) -> bool:
    for node in ast.walk(function):
        if isinstance(node, ast.Assert):
            return True
        if isinstance(node, ast.Call):
            name = _name(node)
            if name in FAILING or name in asserting or name.startswith("assert"):
                return True
            if any(
                k.arg == "check" and getattr(k.value, "value", 0) is True for k in node.keywords
            ):
                return True
    return False


def functions(tree: ast.AST) -> list[ast.FunctionDef]:
    """Functions of a module, those of its classes too."""
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    return [node for node in ast.walk(tree) if isinstance(node, kinds)]


def asserting_functions(trees: list[ast.AST]) -> frozenset[str]:
    """Names of functions beside the tests that assert, or call one that does."""
    known: frozenset[str] = frozenset()
    beside = [f for tree in trees for f in functions(tree) if not f.name.startswith("test")]
    while True:
        found = frozenset(f.name for f in beside if _asserts(f, known))
        if found == known:
            return known
        known = found


def empty_tests(tree: ast.AST, asserting: frozenset[str] = frozenset()) -> list[str]:
    """Names of tests that assert nothing."""
    tests = [f for f in functions(tree) if f.name.startswith("test_")]
    return [f.name for f in tests if not _asserts(f, asserting)]


def _numbers(value: ast.AST, constants: dict[str, ast.Assign]) -> Iterator[tuple[float, int]]:
    """Numbers of an expression with their lines, through constants of the module."""
    for node in ast.walk(value):
        if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
            yield float(node.value), node.lineno
        elif isinstance(node, ast.Name) and node.id in constants:
            yield from _numbers(constants[node.id].value, {})


def wide_tolerances(text: str) -> list[int]:
    """Lines of a module with a tolerance beyond `WIDEST` and no comment that says why."""
    tree = ast.parse(text)
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    comments = {token.start[0] for token in tokens if token.type == tokenize.COMMENT}
    constants = {
        target.id: node
        for node in tree.body
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    wide = set()
    for statement in (node for node in ast.walk(tree) if isinstance(node, ast.stmt)):
        if hasattr(statement, "body"):
            continue
        for call in (node for node in ast.walk(statement) if isinstance(node, ast.Call)):
            for keyword in call.keywords:
                if keyword.arg not in TOLERANCES:
                    continue
                for number, line in _numbers(keyword.value, constants):
                    near = {line, line - 1, statement.lineno - 1, keyword.value.lineno}
                    if number > WIDEST and not near & comments:
                        wide.add(keyword.value.lineno)
    return sorted(wide)


@cache
def _asserting() -> frozenset[str]:
    return asserting_functions([ast.parse(path.read_text(encoding="utf-8")) for path in FILES])


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.relative_to(TESTS).as_posix())
def test_every_test_asserts(path):
    assert empty_tests(ast.parse(path.read_text(encoding="utf-8")), _asserting()) == []


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.relative_to(TESTS).as_posix())
def test_wide_tolerances_have_a_reason(path):
    assert wide_tolerances(path.read_text(encoding="utf-8")) == []


def test_a_test_without_an_assertion_is_found():
    tree = ast.parse(
        "def test_a():\n    run()\n"
        "def test_b():\n    assert run()\n"
        "def test_c():\n    with pytest.raises(E):\n        run()\n"
        "def test_d():\n    same(1, 2)\n"
        "def test_e():\n    np.testing.assert_allclose(a, b)\n"
        "class TestF:\n    def test_f(self):\n        print()\n"
        "def same(a, b):\n    equal(a, b)\n"
        "def equal(a, b):\n    assert a == b\n"
    )
    assert asserting_functions([tree]) == {"same", "equal"}
    assert empty_tests(tree, asserting_functions([tree])) == ["test_a", "test_f"]


def test_a_wide_tolerance_without_a_reason_is_found():
    text = (
        "BARE = 0.02\n#: digits that are printed\nNAMED = 0.02\n"
        "assert a == approx(b, abs=0.35)\n"
        "assert a == approx(b, abs=0.35)  # half of the last printed digit\n"
        "assert a == approx(b, rel=1e-9)\n"
        "assert a == approx(b, rel=BARE)\n"
        "assert a == approx(b, rel=NAMED)\n"
        "# sampled: three standard errors\n"
        "assert_allclose(a, b, rtol=0, atol=3 * error)\n"
        "assert_allclose(\n    a,\n    b,\n    rtol=0.5,\n)\n"
    )
    assert wide_tolerances(text) == [4, 7, 14]
