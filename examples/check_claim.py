"""Check a claim of a document of one's own: printed value, assumption, rule, computed verdict."""

from math import cos, hypot, sin
from pathlib import Path
from tempfile import TemporaryDirectory

from dualarm_repro.ledger import Registry, Result, Rounds, evaluate

CLAIMS = """
document: {id: mine, type: misc, title: An arm of two links}
assumptions:
  elbow: {statement: The elbow is bent so far., value: 0.1, unit: rad, why: It is not printed.,
          evidence: assumed, range: [0.0, 0.5]}
items:
  reach: {kind: claim, place: "1", title: Reach, printed: {reach: "0.70"}, unit: m,
          needs: the reach, assumptions: [elbow]}
"""


def verdict(links):
    """Obtained reach and verdict for two links [m]; every registry holds its own checkers."""
    with TemporaryDirectory() as folder:
        Path(folder, "mine.yaml").write_text(CLAIMS, encoding="utf-8")
        registry = Registry(Path(folder))

        @registry.checks(
            "mine.reach", [Rounds("reach", "as printed", to="reach")], page="mine/page"
        )
        def reach(assumed):
            (a, b), elbow = links, assumed["elbow"]
            return Result({"reach": hypot(a + b * cos(elbow), b * sin(elbow))}, caption="the reach")

        found = evaluate(registry, "mine.reach")
        return found.result.obtained["reach"], found.verdict


for links in ((0.4, 0.3), (0.4, 0.4)):
    print("links of {} and {} m: reach {:.4f} m, {}".format(*links, *verdict(links)))
