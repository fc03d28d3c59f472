"""A document of its own for the tests of the ledger: it knows no robot."""

from dualarm_repro.ledger import Assumed, Bounded, Is, Proof, Registry, Result, Rounds

YAML = """
document: {id: toy, type: misc, title: A toy, authors: ["Doe, Jane"]}
assumptions:
  width: {statement: w, value: 1.0, unit: m, why: unprinted, evidence: assumed, range: [0.0, 4.0]}
  shape: {statement: s, value: round, why: unprinted, evidence: assumed, choices: [round, square]}
errata:
  slip: {place: "1", problem: p, resolution: r, affects: [toy.claim_area]}
  word: {place: "1", problem: p, resolution: r, no_proof: wording only}
items:
  claim_area:
    kind: claim
    place: "1"
    title: The area
    printed: {area: "1.00"}
    needs: area
    assumptions: [width, shape]
  claim_count: {kind: claim, place: "1", title: The count, printed: {n: "3"}, needs: count}
  fig01: {kind: figure, place: "1", title: A sketch, needs: sketch, pending: not drawn yet}
"""


def toy_registry(folder, text=YAML):
    """Registry with the toy document and its checkers."""
    (folder / "toy.yaml").write_text(text)
    registry = Registry(folder)

    @registry.checks(
        "toy.claim_area",
        [Bounded(key="area", label="area below two", high=2.0)],
        page="toy/page",
        samples=64,
    )
    def area(assumed: Assumed) -> Result:
        width = assumed["width"]
        value = width**2 if assumed["shape"] == "square" else 0.75 * width**2
        return Result({"area": value}, caption=f"area {value}")

    @registry.checks(
        "toy.claim_count",
        [Is(key="n", label="count", to="n"), Rounds(key="n", label="count rounds", to="n")],
        page="toy/page",
    )
    def count(assumed: Assumed) -> Result:
        return Result({"n": 3}, caption="three", measured={"seconds": 0.1})

    @registry.proves("toy.slip")
    def slip() -> Proof:
        return Proof("one is one", True, {"one": 1})

    return registry


INVENTORY = {"toy.claim_area": "claim", "toy.claim_count": "claim", "toy.fig01": "figure"}
