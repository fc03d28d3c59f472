"""The one registry: documents with their items, and the functions that compute them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from typing import Any

from pydantic_core import to_jsonable_python

from ..datafiles import data_path
from ..errors import LedgerError, UnknownNameError
from ..tracking import forget, note, unnoted
from .result import Assumed, Proof, Result
from .rules import Rule
from .schema import Assumption, Erratum, Item, PaperFile, load_paper
from .study import Study

#: Draws of the assumptions that are stored where a checker asks for no other number.
SAMPLES = 32

Compute = Callable[[Assumed], Result]
Prove = Callable[[], Proof]


@dataclass(frozen=True)
class Checker:
    """How one item is computed and judged; ``samples`` draws tell how firmly."""

    compute: Compute
    rules: tuple[Rule, ...]
    page: str
    change: str | None = None
    samples: int = SAMPLES


class Registry:
    """Documents read from YAML and the code registered for their items and errata.

    Both are read when they are asked for: a question about one item reads its document alone.

    Parameters
    ----------
    folder
        Where the ``*.yaml`` of the documents are; default ``data/papers``.
    rooms
        Package whose module ``<rooms>.<document>`` registers the checkers of a document when it is
        imported; without it, whoever makes the registry registers them.
    reopen
        Gives the same registry in another process; default the registry itself, pickled.

    Attributes
    ----------
    nudge : callable, optional
        Makes the inputs of all that this process computes from now on differ by round-off, other
        inputs for every seed; shows what hangs on it, see :mod:`.round_off`.
    """

    def __init__(
        self,
        folder: Path | None = None,
        rooms: str | None = None,
        reopen: Callable[[], Registry] | None = None,
    ) -> None:
        self._folder, self._rooms = folder, rooms
        self._papers: dict[str, PaperFile] = {}
        self._entered: set[str] = set()
        self._checkers: dict[str, Checker] = {}
        self._proofs: dict[str, Prove] = {}
        self._studies: dict[str, Study] = {}
        self._digests: dict[str, tuple[PaperFile, str]] = {}
        self.reopen = reopen or (lambda: self)
        self.nudge: Callable[[int], None] | None = None

    @property
    def documents(self) -> tuple[str, ...]:
        """Ids of the documents, in the order of the listings."""
        return tuple(self.papers)

    @property
    def papers(self) -> dict[str, PaperFile]:
        """Every document by its id."""
        for path in sorted((self._folder or data_path("papers")).glob("*.yaml")):
            self._read(path.stem)
        order = sorted(self._papers.values(), key=lambda p: (p.document.order, p.document.id))
        self._papers = {paper.document.id: paper for paper in order}
        return self._papers

    def _read(self, name: str) -> None:
        if name not in self._papers:
            path = (self._folder or data_path("papers")) / f"{name}.yaml"
            with unnoted():  # a computation depends on the parts that it asks for
                paper = load_paper(path)
            if paper.document.id != name:
                raise LedgerError(f"{path.name}: document.id is {paper.document.id!r}")
            self._papers[name] = paper

    def enter(self, name: str) -> None:
        """Import the room of a document, which registers its checkers, proofs and studies."""
        if self._rooms and name not in self._entered:
            self._entered.add(name)
            try:
                import_module(f"{self._rooms}.{name}")
            except ModuleNotFoundError as error:
                if error.name != f"{self._rooms}.{name}":
                    raise
                raise LedgerError(f"{name}: a document without a room in {self._rooms}") from None

    def _all_rooms(self) -> None:
        for name in self.documents:
            self.enter(name)

    @property
    def checkers(self) -> dict[str, Checker]:
        """The checkers of all documents by item id."""
        self._all_rooms()
        return self._checkers

    @property
    def proofs(self) -> dict[str, Prove]:
        """The proofs of all documents by erratum id."""
        self._all_rooms()
        return self._proofs

    @property
    def studies(self) -> dict[str, Study]:
        """The stored studies of all documents by name."""
        self._all_rooms()
        return self._studies

    def checker(self, item_id: str) -> Checker | None:
        """The checker of an item; only the room of its document is imported."""
        self.enter(item_id.partition(".")[0])
        return self._checkers.get(item_id)

    def proof(self, erratum_id: str) -> Prove | None:
        """The proof of an erratum; only the room of its document is imported."""
        self.enter(erratum_id.partition(".")[0])
        return self._proofs.get(erratum_id)

    def checks(
        self,
        item_id: str,
        rules: Sequence[Rule],
        *,
        page: str,
        change: str | None = None,
        samples: int = SAMPLES,
    ) -> Callable[[Compute], Compute]:
        """Decorator: the function computes ``item_id`` and ``rules`` judge it.

        Parameters
        ----------
        page
            Page of the book that shows the item, without suffix ("xue/kinematics").
        change
            For an input that is not used as printed: what was changed.
        samples
            How many draws of the assumptions are stored with the verdict.

        Raises
        ------
        LedgerError
            The item has a checker already, or there is no rule.
        """
        if item_id in self._checkers:
            raise LedgerError(f"{item_id}: a second checker")
        if not rules:
            raise LedgerError(f"{item_id}: a checker without rules cannot fail")

        def register(compute: Compute) -> Compute:
            self._checkers[item_id] = Checker(compute, tuple(rules), page, change, samples)
            return compute

        return register

    def proves(self, erratum_id: str) -> Callable[[Prove], Prove]:
        """Decorator: the function proves an erratum (``xue.table1_shift``)."""
        if erratum_id in self._proofs:
            raise LedgerError(f"{erratum_id}: a second proof")

        def register(prove: Prove) -> Prove:
            self._proofs[erratum_id] = prove
            return prove

        return register

    def keeps(self, study: Study) -> Study:
        """Register a stored study."""
        if study.name in self._studies:
            raise LedgerError(f"{study.name}: a second study of that name")
        self._studies[study.name] = study
        return study

    def paper(self, name: str) -> PaperFile:
        """A document, whole; a computation that reads it depends on all of the file.

        Raises
        ------
        UnknownNameError
            No such document.
        """
        if not (self._folder or data_path("papers")).joinpath(f"{name}.yaml").is_file():
            raise UnknownNameError("ledger", "document", name, f"one of {', '.join(self.papers)}")
        self._read(name)
        note(f"papers/{name}.yaml")
        return self._papers[name]

    def printed(self, item_id: str) -> Any:
        """What an item prints; a computation that reads it depends on that part alone."""
        return self.look(item_id, "printed").printed

    def assumption(self, name: str) -> Any:
        """The value of an assumption ``<document>.<key>``, on which the computation then depends.

        Raises
        ------
        UnknownNameError
            No such assumption.
        """
        return self.declared(name, "value").value

    def declared(self, name: str, *fields: str) -> Assumption:
        """An assumption, for a computation that depends on these fields of it."""
        paper, _, key = name.partition(".")
        self._read(paper)
        known = self._papers[paper].assumptions
        if key not in known:
            raise UnknownNameError("ledger", "assumption", name, f"one of {', '.join(known)}")
        note(*(_part(name, "assumptions", field) for field in fields))
        return known[key]

    def nominal(self, paper: str) -> dict[str, Any]:
        """The values of all assumptions of a document."""
        self._read(paper)
        return {key: self.assumption(f"{paper}.{key}") for key in self._papers[paper].assumptions}

    def part(self, name: str) -> Any:
        """The part of a document that a recorded input ``papers/xue.yaml#items.tab01`` names.

        Looking at it to see whether it changed is no dependency, so nothing is noted.
        """
        paper, _, fields = name.partition("#")
        found: Any = self._document(paper)
        for field in fields.split(".") if fields else ():
            found = found.get(field) if isinstance(found, dict) else getattr(found, field, None)
        return to_jsonable_python(found)

    def part_digest(self, name: str) -> str:
        """SHA-256 of a part; computed once for a document, since records name the same parts."""
        paper = self._document(name.partition("#")[0])
        if name not in self._digests or self._digests[name][0] is not paper:
            text = json.dumps(self.part(name), sort_keys=True, ensure_ascii=False)
            self._digests[name] = paper, sha256(text.encode()).hexdigest()
        return self._digests[name][1]

    def _document(self, path: str) -> PaperFile:
        """The document of ``papers/<id>.yaml``."""
        name = path.rpartition("/")[2].removesuffix(".yaml")
        self._read(name)
        return self._papers[name]

    @contextmanager
    def with_printed(self, item_id: str, value: Any) -> Iterator[None]:
        """While the context lasts, an item prints something else; no memo answers with the old.

        What was read before, and what is read within, are kept apart by the inputs that
        computations note.
        """
        paper, (name, _, key) = self.paper_of(item_id), item_id.partition(".")
        item = paper.items[key].model_copy(update={"printed": value})
        part = _part(item_id, "items", "printed")
        self._papers[name] = paper.model_copy(update={"items": {**paper.items, key: item}})
        forget(part)
        try:
            yield
        finally:
            self._papers[name] = paper
            forget(part)

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
        item = self._find(item_id)
        note(_part(item_id, "items"))
        return item

    def look(self, item_id: str, *fields: str) -> Item:
        """The item, for a computation that depends on these fields of it alone."""
        item = self._find(item_id)
        note(*(_part(item_id, "items", field) for field in fields))
        return item

    def _find(self, item_id: str) -> Item:
        paper, _, key = item_id.partition(".")
        if (
            paper.isidentifier()
            and (self._folder or data_path("papers")).joinpath(f"{paper}.yaml").is_file()
        ):
            self._read(paper)
            if key in self._papers[paper].items:
                return self._papers[paper].items[key]
        items = self.items
        near = get_close_matches(item_id, items, n=3, cutoff=0.5)
        hint = f"an item id such as {', '.join(near or list(items)[:3])}"
        raise UnknownNameError("ledger", "item id", item_id, f"{hint} (see `dualarm list`)")

    def paper_of(self, item_id: str) -> PaperFile:
        """The document an item id belongs to."""
        self._find(item_id)
        return self._papers[item_id.partition(".")[0]]

    def errata_of(self, item_id: str) -> dict[str, Erratum]:
        """The errata that touch an item."""
        name = item_id.partition(".")[0]
        return {
            f"{name}.{key}": erratum
            for key, erratum in self.paper_of(item_id).errata.items()
            if item_id in erratum.affects
        }


def _part(name: str, kind: str, *fields: str) -> str:
    paper, _, key = name.partition(".")
    return f"papers/{paper}.yaml#" + ".".join((kind, key, *fields))


def _reopened() -> Registry:
    return REGISTRY


#: The registry the papers register with and every view reads; each document has a room there.
REGISTRY = Registry(rooms="dualarm_repro.papers", reopen=_reopened)
