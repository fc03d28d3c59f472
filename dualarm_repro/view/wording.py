"""What is printed, obtained and decided, on one line each, for cards and for the terminal alike."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..ledger.finding import finding_of
from ..ledger.meaning import MEANING
from ..ledger.verdict import Verdict
from .badge import interval, percent
from .lines import line
from .numbers import words
from .printed_view import printed_words
from .rule_sentences import compared_with_print, finding

#: How many findings stand on the line of what is obtained.
_MOST = 2
_DECIDED = {
    Verdict.REPRODUCED: "print is met",
    Verdict.UNDER_ASSUMPTION: "possible",
    Verdict.INCONSISTENT: "the document contradicts itself",
    Verdict.NOT_REPRODUCED: "not found",
    Verdict.REGENERATED: "drawn or derived anew",
    Verdict.UNDECIDABLE: "open",
    Verdict.NOT_ATTEMPTED: "not attempted",
    Verdict.ADOPTED: "used as printed",
    Verdict.ADAPTED: "used with a change",
}
#: Verdicts about which the share of the choices that meet print says something.
_WITH_SHARE = {
    Verdict.UNDER_ASSUMPTION,
    Verdict.NOT_REPRODUCED,
    Verdict.REGENERATED,
    Verdict.UNDECIDABLE,
}


def short(value: Any) -> str:
    """A value on one line with the digits that a reader needs."""
    return words(value)


def printed_line(made: Mapping[str, Any]) -> str:
    """What the document prints, on one line."""
    return line(made, "printed") or printed_words(made)


def obtained_line(made: Mapping[str, Any]) -> str:
    """What is obtained at the choices shown, on one line."""
    if made["pending"]:
        return f"nothing yet: {made['pending']}"
    if told := line(made, "obtained"):
        return told
    if made["kind"] == "figure" and made["printed"] is None and made["caption"]:
        return finding_of(made["caption"])[0]
    checks = [c for c in made["checks"] if c["role"] != "regenerates"] or made["checks"]
    order = sorted(checks, key=_rank)  # stable: the first of equals stays in front
    return "; ".join(finding(check) for check in order[:_MOST])


def verdict_line(made: Mapping[str, Any]) -> str:
    """What the verdict says, with the share of the plausible choices where it has one."""
    verdict, found = Verdict(made["verdict"]), made["robustness"]
    text = _DECIDED[verdict]
    if made["decided_by"]:
        text += f", by the statement {made['decided_by']}"
    if verdict is Verdict.ADAPTED and made["change"]:
        text += f": {made['change']}"
    if found is None or verdict not in _WITH_SHARE:
        return text
    share = percent(found["meets_print"]["share"])
    low, high = found["meets_print"]["interval"]
    if verdict is Verdict.UNDER_ASSUMPTION and made["witnesses"]:
        text += ", by a stored witness"
    what = share_of(verdict, made["decided_by"]).replace("the properties", "its properties")
    return (
        f"{text}; {what} in {share} of {found['samples']} plausible choices of what is not "
        f"printed (95 % interval {interval(low, high)})"
    )


def summary_lines(made: Mapping[str, Any]) -> dict[str, str]:
    """``printed``, ``obtained`` and ``verdict`` of a record in words."""
    return {
        "printed": printed_line(made),
        "obtained": obtained_line(made),
        "verdict": f"{made['verdict']}: {verdict_line(made)}",
    }


def meaning(verdict: str) -> str:
    """One sentence on what a verdict means."""
    return MEANING[Verdict(verdict)]


def share_of(verdict: str, decided_by: str | None = None) -> str:
    """What the share of the draws counts: what has no original meets no print.

    Parameters
    ----------
    decided_by
        The statement that gives an item without an original its verdict.
    """
    no_original = decided_by is not None or verdict == Verdict.REGENERATED
    return "the properties hold" if no_original else "print is met"


def search_lines(made: Mapping[str, Any]) -> list[str]:
    """How a witness was sought where none was found, and which is still to be sought."""
    lines, found = [], made["search"]
    if found:
        nearest = found["nearest"]
        how = "directed climbs and draws" if found["directed"] else "draws only, no directed search"
        lines.append(
            f"{how}: {found['evaluations']} evaluations; the nearest choice ({nearest['choice']}) "
            f"misses by {short(nearest['miss'])} of what is printed or bounded."
        )
    if made["seek"]:
        lines.append(f"Still to be sought: {made['seek']}")
    return lines


def _rank(check: Mapping[str, Any]) -> int:
    """What a reader wants to know first: against print, contradictions, what fails, the rest."""
    if compared_with_print(check):
        return 0
    if check["role"] == "contradicts":
        return 1
    return 2 if check["outcome"] != "holds" else 3
