"""A record as lines of text for a pipe."""

from __future__ import annotations

import json
from collections.abc import Iterator
from shlex import join
from typing import Any

from ..ledger.changed import setting, typed
from .assumption_rows import rerun
from .badge import percent
from .printed_beside import Row, check_rows, in_words, printed_rows
from .wording import search_lines, share_of, short

#: Colour of a verdict on a terminal; the word says the same.
_STYLES = {
    "reproduced": "green",
    "adopted": "green",
    "adapted": "green",
    "reproduced-under-assumption": "cyan",
    "regenerated": "cyan",
    "undecidable": "yellow",
    "inconsistent-in-print": "red",
    "not-reproduced": "red",
}


def describe(made: dict[str, Any]) -> Iterator[str]:
    """Everything a record says, a line each."""
    yield f"{made['id']}  {made['title']}  [{made['kind']}, {made['place']}]"
    yield from changed_lines(made)
    yield f"verdict: {verdict_text(made)}{verdict_note(made)}"
    if reason := made.get("unavailable"):
        yield f"  {reason}"
    if made["decided_by"]:
        yield f"  no original in the source; decided by the statement {made['decided_by']}"
    if made["pending"]:
        yield f"pending: {made['pending']}"
    if rows := printed_rows(made):
        yield f"printed{f' ({unit})' if (unit := made['unit']) else ''} | obtained:"
        yield from (_line(row) for row in rows)
        if told := in_words(made):
            yield f"  in words: {told}"
    if made["caption"]:
        yield made["caption"]
    for row, before in zip(check_rows(made), before_rows(made), strict=True):
        yield f"  {row.outcome}: {row.what}: {_expected(row)} | obtained {row.obtained}{before}"
    for name, value in (made["measured"] or {}).items():
        yield f"  measured: {name} = {short(value)}"
    yield from _grounds(made)
    if "changed" not in made:
        line = robustness_line(made)
        yield f"  robustness: {line}"
    yield from (f"  {line}" for line in place_lines(made))


def place_lines(made: dict[str, Any]) -> Iterator[str]:
    """Where the code and the page are, and which commands compute and cite the item again."""
    if code := made["code"]:
        yield f"code: {code['file']}:{code['line']} {code['function']}; page {made['page']}"
    changes = (setting(one["assumption"], one["value"]) for one in made.get("changed", ()))
    again = join(["dualarm", "run", made["id"], *(f"--set={change}" for change in changes)])
    yield f"again: {again}; cite: dualarm cite {made['id']}"
    if "changed" not in made and (other := rerun(made)):
        command, what = other
        yield f"{what}: {command}"


def changed_lines(made: dict[str, Any]) -> Iterator[str]:
    """What a run was changed in, and what that does to the verdict; nothing for a plain record."""
    for entry in made.get("changed", ()):
        unit = f" {entry['unit']}" if entry["unit"] else ""
        ledger = f"{_json(entry['nominal'])} in the ledger; {plausible_text(entry)}"
        yield f"changed: {entry['assumption']} = {_json(entry['value'])}{unit} ({ledger})"
    if "changed" in made and made["obtained"] == made["nominal"]["obtained"]:
        yield "no obtained value moved: it rests on stored draws, or the value does not matter here"


def verdict_note(made: dict[str, Any]) -> str:
    """What is to be said behind a verdict: the change of an input, or what the choice is."""
    if "changed" not in made:
        return f" ({made['change']})" if made["change"] else ""
    before = made["nominal"]["verdict"]
    same = "as" if before == made["verdict"] else f"{before}"
    return f" with these values alone; {same} with the declared ones"


def plausible_text(entry: dict[str, Any]) -> str:
    """The plausible values of an assumption, and whether a changed value is one of them."""
    if entry.get("range"):
        text = f"plausible {short(entry['range'][0])} to {short(entry['range'][1])}"
    elif entry.get("choices"):
        text = f"plausible: {', '.join(map(typed, entry['choices']))}"
    else:
        text = "no other value declared"
    return text if entry.get("plausible", True) else f"{text}; this is outside"


def before_rows(made: dict[str, Any]) -> list[str]:
    """For each check of a changed run what the declared values give, where that differs."""
    if "changed" not in made:
        return [""] * len(made["checks"])
    return [
        "" if before[2:] == now[2:] else f" (declared values: {before.obtained}, {before.outcome})"
        for before, now in zip(check_rows(made["nominal"]), check_rows(made), strict=True)
    ]


def verdict_text(made: dict[str, Any]) -> str:
    """The verdict, with the share of the plausible choices that meet print where it has one."""
    found = made["robustness"]
    if made["verdict"] is None:
        return "not available"
    if found is None or made["decided_by"] or made["verdict"] != "reproduced-under-assumption":
        return str(made["verdict"])
    return f"{made['verdict']}, {percent(found['meets_print']['share'])}"


def verdict_style(verdict: str | None) -> str:
    """Colour of a verdict on a terminal."""
    return _STYLES.get(verdict or "", "dim")


def robustness_line(made: dict[str, Any]) -> str:
    """Share of the draws that meet print, what it hangs on and what flips it."""
    found, draws = made["robustness"], made["draws"]
    if found is None:
        return "no assumption with another plausible value" if draws == "none" else f"draws {draws}"
    low, high = found["meets_print"]["interval"]
    what, share = share_of(made["verdict"], made["decided_by"]), found["meets_print"]["share"]
    text = f"{what} in {share:.1%} of {found['samples']} draws ({low:.1%}-{high:.1%})"
    if found["influence"]:
        name, index = next(iter(found["influence"].items()))
        text += f"; most influential: {name} ({index:.2f})"
    flip = found["flip"]
    if flip is None:
        return f"{text}; no single change within the plausible values flips it"
    return f"{text}; flips at {flip['assumption']} = {flip['value']} (nominal {flip['nominal']})"


def proof_text(entry: dict[str, Any]) -> str:
    """Whether an erratum is proved, or why it cannot be."""
    proof = entry["proof"]
    if proof is None:
        return entry.get("no_proof") or ""
    return f"{'proved' if proof['holds'] else 'PROOF FAILS'}: {proof['statement']}"


def _line(row: Row) -> str:
    return f"  {row.what}: {row.printed} | {row.obtained or '-'}"


def _expected(row: Row) -> str:
    return row.printed if row.printed.startswith("printed") else f"expected {row.printed}"


def _grounds(made: dict[str, Any]) -> Iterator[str]:
    for entry in made["witnesses"]:
        values = _json(entry["values"]) if entry["values"] else "the values as declared"
        yield f"  witness ({entry['choice']}): {entry['verdict']} with {values}"
    for line in search_lines(made):
        yield f"  {line}"
    for name, entry in made["thresholds"].items():
        yield f"  threshold {name} = {entry['value']:g}: {entry['reason']}"
    for kind in ("assumptions", "context"):
        for entry in made[kind]:
            unit = f" {entry['unit']}" if entry.get("unit") else ""
            value = f"{entry['value']}{unit}; {plausible_text(entry)}"
            yield f"  {kind.removesuffix('s')} {entry['id']}: {entry['statement']} ({value})"
    for entry in made["errata"]:
        yield f"  erratum {entry['id']}: {entry['problem']} [{proof_text(entry)}]"
    for datum in made["missing"]:
        yield f"  not printed: {datum}"


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)
