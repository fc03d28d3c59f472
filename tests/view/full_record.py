"""A record in which every part of a card occurs, with signs that HTML must not take for its own."""

POSSIBLE = "reproduced-under-assumption"
_CHECK = {
    "label": "a < b",
    "role": "supports",
    "expected": "at most 1 & 2",
    "obtained": [0.5, True, None],
    "holds": True,
}
_ASSUMPTION = {"id": "width", "value": 1.0, "evidence": "assumed", "statement": "<w>", "why": "&"}
_PROOF = {"statement": "1 < 2", "holds": True, "values": {"one": 1, "two": 2.5}}
_ERRATUM = {"place": "eq. (1)", "problem": "x > y", "resolution": "y", "no_proof": "only <words>"}
ROBUST = {
    "holds": 0.05,
    "samples": 32,
    "interval": [0.01, 0.16],
    "meets_print": {"share": 0.05, "interval": [0.01, 0.16]},
    "flip": {"assumption": "width", "nominal": 1.0, "value": 1.5, "change": 0.1,
             "verdict": "not-reproduced"},
    "influence": {"width": 0.61, "shape<": 0.2},
}  # fmt: skip
_RARE = {
    **ROBUST,
    "meets_print": {"share": 0.005, "interval": [0.0, 0.16]},
    "flip": {**ROBUST["flip"], "assumption": "w<", "value": "a&b"},
}
FULL = {
    "id": "toy.x", "paper": "toy", "kind": "claim", "place": "§ 1 & 2", "title": "a < b",
    "printed": {"a<": "1", "statement": "x & y"}, "unit": None, "obtained": {}, "caption": None,
    "verdict": POSSIBLE, "pending": None, "change": "x & y", "decided_by": "toy.claim",
    "checks": [{**_CHECK, "outcome": "holds"},
               {**_CHECK, "obtained": {"k": "<"}, "outcome": "open"}],
    "measured": {"time <s>": 0.25, "n": 3}, "robustness": _RARE,
    "witnesses": [{"choice": "draw 4", "verdict": "holds", "values": {"width": 2.0}},
                  {"choice": "nominal", "verdict": "fails", "values": {}}],
    "search": {"directed": True, "evaluations": 40,
               "nearest": {"choice": "draw <3>", "values": {}, "miss": 0.25}},
    "seek": "a posture", "thresholds": {"limit": {"value": 0.5, "reason": "half <"}},
    "assumptions": [{**_ASSUMPTION, "unit": "m"}, _ASSUMPTION], "context": [_ASSUMPTION],
    "errata": [{**_ERRATUM, "id": "toy.a", "proof": _PROOF},
               {**_ERRATUM, "id": "toy.b", "proof": {**_PROOF, "holds": False}},
               {**_ERRATUM, "id": "toy.c", "proof": None}],
    "missing": ["<script>"], "notes": "one & two",
    "code": {"file": "dualarm_repro/papers/xue/__init__.py", "line": 7, "function": "f.<locals>.g",
             "figure": {"file": "dualarm_repro/view/x.py", "line": 3, "function": "_draw"}},
}  # fmt: skip
#: Its variants: adapted input, nothing at all, code that is not of the library.
ADAPTED = {**FULL, "verdict": "adapted", "robustness": {**ROBUST, "flip": None, "influence": {}}}
EMPTY = {**FULL, **dict.fromkeys(("pending", "change", "decided_by", "measured", "robustness",
         "search", "seek", "notes", "code")), "verdict": "reproduced", "thresholds": {},
         **{key: [] for key in ("checks", "witnesses", "assumptions", "context", "errata",
                                "missing")}}  # fmt: skip
FOREIGN = {**EMPTY, "code": {"file": "/x/a<b.py", "line": None, "function": "f", "figure": None}}
