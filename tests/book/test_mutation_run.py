"""Mutants of a small tree: killed by a test, by the time limit, excused, or alive."""

import mutation_run
import pytest

from dualarm_repro.ledger.trust.mutants import Mutant, mutants

SOURCE = '''"""A room."""
def twice(x):
    return 2 * x
def count(n):
    while n > 0:
        n = n - 1
    return n
def idle(x):
    return x + 5 if x is None else x
'''
TESTS = """from dualarm_repro.arms.m import count, idle, twice
def test_twice(): assert twice(3) == 6
def test_count(): assert count(2) == 0
def test_idle(): assert idle(1) == 1
def test_that_fails_anyway(): assert False
"""


def test_the_list_of_equivalent_mutants_names_mutants_that_exist():
    for entry in mutation_run.equivalents():
        drawn = mutants(mutation_run.ROOT, entry["file"])
        assert [m for m in drawn if mutation_run.excused(m, [entry])], entry
        assert len(entry["reason"]) > 10


def test_of_a_line_with_the_token_twice_only_the_column_that_is_named_is_excused():
    twice = [
        Mutant("m.py", 3, column, "0.0", "0.01", "y if x > 0.0 else 0.0") for column in (9, 18)
    ]
    named = {name: getattr(twice[1], name) for name in ("file", "text", "old", "new", "column")}
    known = [named | {"reason": "it is multiplied by zero"}]
    found = [mutation_run.excused(mutant, known) for mutant in twice]
    assert found == [None, "it is multiplied by zero"]


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    root = tmp_path_factory.mktemp("mutated") / "root"
    for name in ("dualarm_repro/arms", "tests/arms", "data", "tools"):
        (root / name).mkdir(parents=True)
    (root / "dualarm_repro" / "__init__.py").write_text("")
    (root / "dualarm_repro" / "arms" / "m.py").write_text(SOURCE)
    (root / "tests" / "arms" / "test_m.py").write_text(TESTS)
    (root / "pyproject.toml").write_text("")
    (root / "CITATION.cff").write_text("")
    known = [
        {
            "file": "dualarm_repro/arms/m.py",
            "text": "return x + 5 if x is None else x",
            "old": "5",
            "new": "6",
            "reason": "nothing adds to nothing",
        }
    ]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(mutation_run, "ROOT", root)
        patch.setattr(mutation_run, "ROOMS", ("dualarm_repro/arms",))
        # Tests that need no plugin: each of ten processes starts in half the time without them.
        patch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
        patch.setattr(mutation_run, "TEST_LIMIT", 2)
        patch.setattr(mutation_run, "equivalents", lambda: known)
        yield root


@pytest.fixture(scope="module")
def rows(tree):
    return list(mutation_run.run(tree.parent / "work", per_room=99, limit=99))


def test_what_kills_each(tree, rows):
    fate = {(r["line"], r["old"], r["new"]): r["killed_by"] or r["equivalent"] for r in rows}
    test = "test tests/arms/test_m.py::test_"
    assert fate == {
        (3, "2", "3"): f"{test}twice",
        (3, "*", "/"): f"{test}twice",
        (5, ">", "<="): f"{test}count",
        (5, "0", "1"): f"{test}count",
        (6, "-", "+"): "time limit",
        (6, "1", "2"): None,
        (9, "+", "-"): None,
        (9, "5", "6"): "nothing adds to nothing",
    }
    assert (tree.parent / "work" / "tree" / "dualarm_repro" / "arms" / "m.py").read_text() == SOURCE


def test_what_is_known_to_be_killed_is_not_tried_again(rows, tmp_path, monkeypatch):
    known = mutation_run.killers(rows)
    assert len(known) == sum(bool(row["killed_by"]) for row in rows)
    tried = []
    monkeypatch.setattr(mutation_run.Copy, "killer", lambda self, mutant: tried.append(mutant))
    again = list(mutation_run.run(tmp_path / "again", per_room=99, noticed=known))
    assert [row["killed_by"] for row in again] == [row["killed_by"] for row in rows]
    assert tried
    assert all(mutation_run._place(one._asdict()) not in known for one in tried)


def test_two_of_one_line_are_told_apart():
    row = {"file": "f.py", "line": 3, "column": 8, "old": "0", "new": "1", "killed_by": "test t"}
    known = mutation_run.killers([row, {**row, "column": 11, "killed_by": None}])
    assert len(known) == 1
    assert mutation_run._place({**row, "column": 11}) not in known
