"""The one registry: documents with their items, and the functions that compute them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

from ..datafiles import data_path
from ..errors import LedgerError, UnknownNameError
from .result import Assumed, Proof, Result
from .rules import Rule
from .schema import Erratum, Item, PaperFile, load_paper
from .sensitivity import Robustness
from .study import Study

Compute = Callable[[Assumed], Result]
Prove = Callable[[], Proof]


@dataclass(frozen=True)
class Checker:
    """How one item is computed and judged."""

    compute: Compute
    rules: tuple[Rule, ...]
    page: str
    change: str | None = None
    samples: int = 0
    robust: Callable[[], Robustness] | None = None


@dataclass
class Registry:
    """Documents read from YAML and the code registered for their items and errata."""

    papers: dict[str, PaperFile] = field(default_factory=dict)
    checkers: dict[str, Checker] = field(default_factory=dict)
    proofs: dict[str, Prove] = field(default_factory=dict)
    studies: dict[str, Study] = field(default_factory=dict)

    def checks(
        self,
        item_id: str,
        rules: Sequence[Rule],
        *,
        page: str,
        change: str | None = None,
        samples: int = 0,
        robust: Callable[[], Robustness] | None = None,
    ) -> Callable[[Compute], Compute]:
        """Decorator: the function computes ``item_id`` and ``rules`` judge it.

        Parameters
        ----------
        page
            Page of the book that shows the item, without suffix ("xue/kinematics").
        change
            For an input that is not used as printed: what was changed.
        samples
            How many draws of the assumptions the robustness of the verdict is based on (0: none).
        robust
            Where a draw is too heavy for that: reads the robustness from a stored study.

        Raises
        ------
        LedgerError
            The item has a checker already, or there is no rule.
        """
        if item_id in self.checkers:
            raise LedgerError(f"{item_id}: a second checker")
        if not rules:
            raise LedgerError(f"{item_id}: a checker without rules cannot fail")

        def register(compute: Compute) -> Compute:
            self.checkers[item_id] = Checker(compute, tuple(rules), page, change, samples, robust)
            return compute

        return register

    def proves(self, erratum_id: str) -> Callable[[Prove], Prove]:
        """Decorator: the function proves an erratum (``xue.table1_shift``)."""
        if erratum_id in self.proofs:
            raise LedgerError(f"{erratum_id}: a second proof")

        def register(prove: Prove) -> Prove:
            self.proofs[erratum_id] = prove
            return prove

        return register

    def keeps(self, study: Study) -> Study:
        """Register a stored study."""
        if study.name in self.studies:
            raise LedgerError(f"{study.name}: a second study of that name")
        self.studies[study.name] = study
        return study

    def load(self, folder: Path | None = None) -> None:
        """Read every ``*.yaml`` below ``data/papers`` (or ``folder``)."""
        found = []
        for path in (folder or data_path("papers")).glob("*.yaml"):
            paper = load_paper(path)
            if paper.document.id != path.stem:
                raise LedgerError(f"{path.name}: document.id is {paper.document.id!r}")
            found.append(paper)
        for paper in sorted(found, key=lambda paper: (paper.document.order, paper.document.id)):
            self.papers[paper.document.id] = paper

    def paper(self, name: str) -> PaperFile:
        """A document; a process that has read none yet, such as a worker of a study, reads them."""
        if not self.papers:
            self.load()
        return self.papers[name]

    @property
    def items(self) -> dict[str, Item]:
        """All items by full id, in the order of the documents."""
        return {
            f"{name}.{key}": item
            for name, paper in self.papers.items()
            for key, item in paper.items.items()
        }

    @property
    def errata(self) -> dict[str, Erratum]:
        """All errata by full id."""
        return {
            f"{name}.{key}": erratum
            for name, paper in self.papers.items()
            for key, erratum in paper.errata.items()
        }

    def item(self, item_id: str) -> Item:
        """The item of that id.

        Raises
        ------
        UnknownNameError
            With the nearest ids that exist.
        """
        items = self.items
        if item_id not in items:
            near = get_close_matches(item_id, items, n=3, cutoff=0.5)
            hint = f"an item id such as {', '.join(near or list(items)[:3])}"
            raise UnknownNameError("ledger", "item id", item_id, f"{hint} (see `dualarm list`)")
        return items[item_id]

    def paper_of(self, item_id: str) -> PaperFile:
        """The document an item id belongs to."""
        self.item(item_id)
        return self.papers[item_id.partition(".")[0]]

    def errata_of(self, item_id: str) -> dict[str, Erratum]:
        """The errata that touch an item."""
        return {key: erratum for key, erratum in self.errata.items() if item_id in erratum.affects}


#: The registry the papers register with and every view reads.
REGISTRY = Registry()
