"""Straight-line programs: what is folded, and that nothing else changes."""

from hypothesis import given
from hypothesis import strategies as st

from dualarm_repro.arms.codegen.program import ONE, ZERO, Program, Term

X, Y = Term(1, "x"), Term(1, "y")


def test_products_and_sums_that_leave_no_statement():
    program = Program()
    assert program.times(X, ZERO) == ZERO
    assert program.times(-X, -ONE) == X
    assert program.plus(ZERO, -X) == -X
    assert program.plus(X, -X) == ZERO
    assert program.plus(-ONE, -ONE).text == "-2.0"
    assert not program.statements


def test_a_value_is_computed_once():
    program = Program()
    assert program.times(X, Y) == -program.times(-Y, X)
    assert program.plus(X, -Y) == -program.plus(Y, -X)
    assert program.plus(-X, -Y) == -program.plus(Y, X)
    assert len(program.statements) == 3


def test_a_product_of_a_product_keeps_its_order():
    program = Program()
    z = program.times(Y, program.times(X, Term(1, "z")))
    assert program.lines([z])[0] == ["t1 = (x * z) * y"]


numbers = st.sampled_from([0, 1, -1, 0.5, -2.5, 1 / 3])
vectors = st.tuples(numbers, numbers, numbers)


@given(vectors, vectors)
def test_the_lines_give_what_the_numbers_give(a, b):
    values = {}

    def term(value):
        if value in (0, 1, -1):
            return Term(value)
        name = f"v{len(values)}"
        values[name] = value
        return Term(1, name)

    program = Program()
    u, v = tuple(map(term, a)), tuple(map(term, b))
    results = [program.inner(u, v), *program.cross(u, v), program.function("abs", u[0])]
    lines, expressions = program.lines(results)
    exec("\n".join(lines), values)
    expected = [
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
        abs(a[0]),
    ]
    assert [eval(text, values) for text in expressions] == expected
