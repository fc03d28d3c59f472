"""What each verdict means, in one sentence; apart from what computes it, which a word must not
make stale."""

from __future__ import annotations

from .verdict import Verdict

#: One sentence per verdict, for legends.
MEANING = {
    Verdict.REPRODUCED: "print is met, and nothing that is not printed matters",
    Verdict.UNDER_ASSUMPTION: (
        "possible: print is met under a declared choice of what is not printed; the share says how "
        "many of the plausible choices meet it"
    ),
    Verdict.INCONSISTENT: "the document contradicts itself here; the proof is shown",
    Verdict.NOT_REPRODUCED: "not found: no choice within the declared ranges meets print",
    Verdict.REGENERATED: (
        "drawn or derived anew, since the source at hand holds no original to compare with; the "
        "properties it must have are checked"
    ),
    Verdict.UNDECIDABLE: (
        "declared choices disagree and print gives no way to prefer one; a witness is shown for "
        "each side, and it is no pass"
    ),
    Verdict.NOT_ATTEMPTED: "no checker is built yet; the reason is given",
    Verdict.ADOPTED: "an input, used exactly as printed",
    Verdict.ADAPTED: "an input, used with the change that is named",
}
