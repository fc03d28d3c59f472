"""What is printed, as a reader knows it: words, values, tables, formulas, or that it is lost.

The parts of a printed value come in the order of the ledger. Every leaf of it occurs in the HTML of
a card and in the lines of a terminal; the tests compare them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from markupsafe import Markup, escape

from .mathml import formula, is_formula, matrix, symbol
from .names import phrase

#: What our copy of a document lacks, by kind of item.
_LOST = {
    "figure": "a drawing; our copy of the document has its text only",
    "equation": "a formula, which is lost in our copy of the document",
    "table": "a table, whose entries are not in our copy of the document",
    "claim": "nothing that could be compared",
}


#: Keys of an item with a unit to whose values it does not belong.
_NO_UNIT = {"q", "searches", "count", "trials"}


@dataclass(frozen=True)
class Part:
    """One part of what is printed.

    Attributes
    ----------
    kind
        ``words``, ``values``, ``formula``, ``matrix``, ``table``, ``list`` or ``lost``.
    label
        Its name in words, empty where there is only one part.
    content
        A text; a list of texts; rows of texts, for a table the heads first.
    """

    kind: str
    label: str
    content: Any


def parts(made: Mapping[str, Any]) -> list[Part]:
    """The printed value of a record, or of an item with ``printed``, ``kind`` and ``unit``."""
    printed = made["printed"]
    if printed is None:
        return [Part("lost", "", _LOST[str(made["kind"])])]
    if not isinstance(printed, Mapping):
        return [_part("", printed, made["unit"] or "")]
    return list(_parts(printed, made["unit"] or ""))


def _parts(printed: Mapping[str, Any], unit: str) -> Iterator[Part]:
    if table := _table(printed):
        yield table
        return
    columns = {k: v for k, v in printed.items() if isinstance(v, list) and _flat(v)}
    same = {len(v) for k, v in columns.items() if k != "header"}
    if "header" in printed and len(same) == 1:
        yield _columns(columns, printed["header"])
        return
    for key, value in printed.items():
        if isinstance(value, Mapping):
            for part in _parts(value, unit):
                named = f"{phrase(key)}, {part.label}" if part.label else phrase(key)
                yield Part(part.kind, named, part.content)
        else:
            yield _part(key, value, unit)


def _part(key: str, value: Any, unit: str) -> Part:
    label = "" if key in ("statement", "formula", "matrix", "") else phrase(key)
    if len(unit) > 4 or (key in _NO_UNIT and unit != "rad"):
        unit = ""
    if isinstance(value, list):
        if all(isinstance(row, list) for row in value):
            if key == "matrix":
                return Part("matrix", label, value)
            if all(_numeric(one) for row in value for one in row):
                return Part("values", label, "; ".join(_point(row, unit) for row in value))
            return Part("list", label, [one for row in value for one in row])
        if all(is_formula(one) and "=" in one for one in value):
            return Part("formula", label, value)
        if all(_numeric(one) for one in value):
            return Part("values", label, _point(value, unit))
        return Part("list", label, value)
    if key == "statement":
        return Part("words", "", value)
    if is_formula(value) and not _numeric(value):
        return Part("formula", label, [value])
    suffix = f" {unit}" if unit and _numeric(value) else ""
    return Part("values", label, f"{value}{suffix}")


def _point(values: list[str], unit: str) -> str:
    suffix = f" {unit}" if unit else ""
    return f"({', '.join(values)}){suffix}"


def _table(printed: Mapping[str, Any]) -> Part | None:
    """Mappings with the same keys are rows of a table."""
    rows = list(printed.values())
    if len(rows) < 2 or not all(isinstance(row, Mapping) for row in rows):
        return None
    heads = list(rows[0])
    if any(list(row) != heads for row in rows) or not all(
        isinstance(cell, str) for row in rows for cell in row.values()
    ):
        return None
    return Part(
        "table",
        "",
        [
            ["", *(phrase(head) for head in heads)],
            *([phrase(key), *row.values()] for key, row in printed.items()),
        ],
    )


def _columns(columns: Mapping[str, list[str]], header: list[str]) -> Part:
    """Lists of the same length are columns, under the printed heads; the first counts the rows."""
    body = [values for key, values in columns.items() if key != "header"]
    numbers = [str(k + 1) for k in range(len(body[0]))]
    if len(header) == len(body) + 1:
        body = [numbers, *body]
    return Part("table", "", [header, *(list(row) for row in zip(*body, strict=True))])


def _flat(value: list[Any]) -> bool:
    return all(isinstance(one, str) for one in value)


def _numeric(text: str) -> bool:
    """Whether a printed text is a number or a multiple of pi."""
    plain = text.replace("pi", "").strip("-+*/ ")
    return bool(text) and all(sign.isdigit() or sign in ".-+*/e " for sign in plain)


def printed_html(made: Mapping[str, Any]) -> Markup:
    """The printed value for a card: tables as tables, formulas typeset."""
    return Markup("".join(_html(part) for part in parts(made)))


def _html(part: Part) -> str:
    label = f'<span class="ledger-label">{escape(part.label)}:</span> ' if part.label else ""
    if part.kind == "formula":
        return (f"<p>{label}</p>" if label else "") + "".join(formula(t) for t in part.content)
    if part.kind == "matrix":
        return (f"<p>{label}</p>" if label else "") + matrix(part.content)
    if part.kind == "table":
        head, *rows = part.content
        top = "".join(f"<th>{_cell(cell)}</th>" for cell in head)
        body = "".join("<tr>" + "".join(f"<td>{_cell(c)}</td>" for c in row) + "</tr>"
                       for row in rows)  # fmt: skip
        return (
            f'<div class="ledger-scroll"><table class="ledger-print"><tr>{top}</tr>'
            f"{body}</table></div>"
        )
    if part.kind == "list":
        entries = "".join(f"<li>{_cell(one)}</li>" for one in part.content)
        return (f"<p>{label}</p>" if label else "") + f"<ol>{entries}</ol>"
    if part.kind == "lost":
        return f'<p class="ledger-lost">{escape(part.content)}</p>'
    return f"<p>{label}{escape(part.content)}</p>"


def _cell(text: str) -> str:
    """A cell of a printed table; symbols and multiples of pi are typeset."""
    if is_formula(text) or "_" in text or text in ("theta", "alpha"):
        return symbol(text)
    return str(escape(text))


def printed_lines(made: Mapping[str, Any]) -> list[str]:
    """The printed value as lines of a terminal."""
    lines: list[str] = []
    for part in parts(made):
        label = f"{part.label}: " if part.label else ""
        if part.kind in ("matrix", "table"):
            lines += [label.rstrip()] if label else []
            lines += _aligned(part.content)
        elif part.kind == "list":
            lines.append(label + "; ".join(part.content))
        elif part.kind == "formula":
            lines += [label + text for text in part.content]
        else:
            lines.append(label + part.content)
    return lines


def printed_words(made: Mapping[str, Any]) -> str:
    """The printed value on one line: words and values whole, a matrix by its size."""
    found = []
    for part in parts(made):
        if part.kind == "matrix":
            text = f"a {len(part.content)} × {len(part.content[0])} matrix"
        elif part.kind == "table":
            head, *rows = part.content
            cells = [zip(head[1:], row[1:], strict=True) for row in rows]
            told = [", ".join(f"{name} {cell}" for name, cell in pairs) for pairs in cells]
            text = "; ".join(f"{row[0]}: {line}" for row, line in zip(rows, told, strict=True))
            text = text if len(text) < 120 else f"a table of {len(rows)} × {len(head)} entries"
        elif isinstance(part.content, list):
            text = "; ".join(part.content)
        else:
            text = part.content
        found.append(f"{part.label}: {text}" if part.label else text)
    return "; ".join(found)


def _aligned(rows: list[list[str]]) -> list[str]:
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
