"""`run`: compute items, as declared or with assumptions changed, and write what comes out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from . import completion, output, progress
from .arguments import AsJson, Ids
from .examples import examples

if TYPE_CHECKING:
    from ..ledger import Registry
    from ..ledger.evaluation import Evaluation

#: Rows of a table that `run` prints.
_ROWS = 12
#: Where files go if nobody says where.
_OUT = Path("out")


@examples(
    "dualarm run xue.fig05 --out results",
    "dualarm run xue.tab01 xue.eq01 --json",
    "dualarm run xue.tab02 --set base_distance=3.0",
    "dualarm run xue.tab02 --set update_rule=gradient --set trial_seed=1 --out changed",
)
def run(
    ids: Ids,
    changes: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="ASSUMPTION=VALUE",
            help="change an assumption of the items for this run; `dualarm show ID` names them",
            autocompletion=completion.assumptions,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="folder for the files; default out, none with --set"),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Compute items and write their files.

    These are ID.json, ID.csv, ID.svg, ID.png and, where there is a 3-D scene, ID.html.

    With --set the items are computed at other values of what nobody printed, and compared with
    what the declared values give. Nothing of it is stored; files are written only where --out says.
    """
    from ..ledger.changed import read_changes
    from ..papers import load

    registry = load()
    values = {item_id: read_changes(registry, item_id, changes or ()) for item_id in ids}
    folder = out if changes else out or _OUT
    made = []
    for item_id, chosen in values.items():
        with progress.waiting(f"computing {item_id}"):
            one, evaluation = _computed(registry, item_id, chosen)
            files = _files(evaluation, one, folder) if folder else []
        if as_json:
            made.append({**one, "files": [str(path) for path in files]})
        else:
            _print(one, evaluation, files)
    if as_json:
        output.print_json(made)


def _computed(
    registry: Registry, item_id: str, changes: dict[str, Any]
) -> tuple[dict[str, Any], Evaluation]:
    if changes:
        from ..ledger.changed import evaluate_changed

        return evaluate_changed(registry, item_id, changes)
    from ..ledger.record import located, make

    entry, evaluation = make(registry, item_id)
    return located(entry["record"]), evaluation


def _files(evaluation: Evaluation, made: dict[str, Any], folder: Path) -> list[Path]:
    from ..ledger.export import export
    from ..ledger.file_set import write_together
    from ..view.card import card_figure

    return write_together(folder, lambda staged: export(evaluation, made, staged, card_figure))


def _print(made: dict[str, Any], evaluation: Evaluation, files: list[Path]) -> None:
    from .items import describe

    describe(made)
    if evaluation.result and (table := evaluation.result.table) is not None:
        print(table.head(_ROWS).to_string(index=False))
        if len(table) > _ROWS:
            where = f"all in {made['id']}.csv" if files else "all written with --out DIR"
            print(f"... {len(table)} rows, {where}")
    if files:
        output.print_written(files)
    elif made.get("changed"):
        print("nothing is stored or written (--out DIR writes the files of this run)")
