"""A record as lines of text for a terminal."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from .wording import search_lines, share_of


def describe(made: dict[str, Any]) -> Iterator[str]:
    """Everything a record says, a line each."""
    yield f"{made['id']}  {made['title']}  [{made['kind']}, {made['place']}]"
    change = f" ({made['change']})" if made["change"] else ""
    yield f"verdict: {verdict_text(made)}{change}"
    if made["decided_by"]:
        yield f"  no original in the source; decided by the statement {made['decided_by']}"
    if made["pending"]:
        yield f"pending: {made['pending']}"
    if made["printed"] is not None:
        yield f"printed: {_json(made['printed'])}"
    if made["caption"]:
        yield made["caption"]
    for check in made["checks"]:
        found = f"obtained {_json(check['obtained'])}, expected {check['expected']}"
        yield f"  {check['outcome']}: {check['label']}: {found}"
    for name, value in (made["measured"] or {}).items():
        yield f"  measured: {name} = {value}"
    yield from _grounds(made)
    yield f"  robustness: {robustness_line(made['robustness'], made['verdict'], made['draws'])}"
    if code := made["code"]:
        yield f"  code: {code['file']}:{code['line']} {code['function']}; page {made['page']}"


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
            word = kind.removesuffix("s")
            yield f"  {word} {entry['id']}: {entry['statement']} ({entry['value']})"
    for entry in made["errata"]:
        yield f"  erratum {entry['id']}: {entry['problem']} [{_proof(entry)}]"
    for datum in made["missing"]:
        yield f"  not printed: {datum}"


def verdict_text(made: dict[str, Any]) -> str:
    """The verdict, with the share of the plausible choices that meet print where it has one."""
    found = made["robustness"]
    if found is None or made["decided_by"] or made["verdict"] != "reproduced-under-assumption":
        return made["verdict"]
    return f"{made['verdict']}, {found['meets_print']['share']:.0%}"


def robustness_line(found: dict[str, Any] | None, verdict: str, draws: str = "none") -> str:
    """Share of the draws that meet print, what it hangs on and what flips it."""
    if found is None:
        return "no assumption with another plausible value" if draws == "none" else f"draws {draws}"
    low, high = found["meets_print"]["interval"]
    text = (
        f"{share_of(verdict)} in {found['meets_print']['share']:.1%} of {found['samples']} draws "
        f"({low:.1%}-{high:.1%})"
    )
    if found["influence"]:
        name, index = next(iter(found["influence"].items()))
        text += f"; most influential: {name} ({index:.2f})"
    flip = found["flip"]
    if flip is None:
        return f"{text}; no single change within the plausible values flips it"
    return f"{text}; flips at {flip['assumption']} = {flip['value']} (nominal {flip['nominal']})"


def _proof(entry: dict[str, Any]) -> str:
    proof = entry["proof"]
    if proof is None:
        return entry.get("no_proof") or ""
    return f"{'proved' if proof['holds'] else 'PROOF FAILS'}: {proof['statement']}"


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)
