"""The chapters of the documents as programs: their cells, what these call, and what they do."""

import ast
import re
import warnings
from contextlib import redirect_stdout
from functools import cache
from io import StringIO
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

import matplotlib.pyplot as plt

from dualarm_repro import papers
from dualarm_repro.ledger.reference import read_reference
from dualarm_repro.view import cell as view_cell

BOOK = Path(__file__).parents[2] / "book"
_CELL = re.compile(r"^```\{code-cell\}[^\n]*\n(.*?)^```", re.DOTALL | re.MULTILINE)


class Ran(NamedTuple):
    """A chapter whose cells were run with the stored results, and without its cards.

    Attributes
    ----------
    names
        What the cells leave behind.
    compared
        Item, key and value of every number that was set beside the ledger.
    silent
        Cells that end in a call without showing anything.
    warned
        File and text of every warning.
    left
        Numbers of the figures that are still open.
    """

    names: dict
    compared: list
    silent: list
    warned: list
    left: list


def chapters_of(document):
    """Names of the chapters of a document, without its index."""
    found = sorted((BOOK / document).glob("*.md"))
    return [f"{document}/{path.stem}" for path in found if path.stem != "index"]


def cells_of(chapter):
    """Code of the cells of a chapter, without their options."""
    found = _CELL.findall((BOOK / f"{chapter}.md").read_text(encoding="utf-8"))
    assert found, chapter
    return ["\n".join(line for line in c.splitlines() if not line.startswith(":")) for c in found]


def calls_in(code):
    """What a cell calls: every function as it is written, and by its last name."""
    called = (node.func for node in ast.walk(ast.parse(code)) if isinstance(node, ast.Call))
    written = {ast.unparse(function) for function in called}
    return written | {name.rpartition(".")[2] for name in written}


def obtained_for(item_id):
    """What the stored results hold for an item."""
    return read_reference(item_id.partition(".")[0])[item_id]["obtained"]


@cache
def run(chapter):
    """Run the cells of a chapter."""
    names, compared, silent = {"__name__": chapter}, [], []
    before = plt.get_fignums()
    original = view_cell.beside_ledger

    def beside_ledger(item_id, computed):
        compared.extend((item_id, key, value) for key, value in computed.items())
        return original(item_id, computed)

    with (
        patch.object(papers, "show", lambda *ids: ids),
        patch.object(view_cell, "obtained", obtained_for),
        patch.object(view_cell, "beside_ledger", beside_ledger),
        warnings.catch_warnings(record=True) as caught,
    ):
        warnings.simplefilter("always")
        for number, code in enumerate(cells_of(chapter)):
            body, printed, value = ast.parse(code).body, StringIO(), None
            last = body.pop() if isinstance(body[-1], ast.Expr) else None
            with redirect_stdout(printed):
                exec(compile(ast.Module(body, []), f"<cell {number}>", "exec"), names)
                if last:
                    expression = compile(ast.Expression(last.value), f"<cell {number}>", "eval")
                    value = eval(expression, names)
            if last and value is None and not printed.getvalue():
                silent.append(code)
    warned = [(one.filename, str(one.message)) for one in caught]
    left = [number for number in plt.get_fignums() if number not in before]
    plt.close("all")
    return Ran(names, compared, silent, warned, left)
