"""Verify that results hold on any processor, on this one: run them with other machine code.

Compiled kernels, numpy, OpenBLAS and the C library choose their code by the processor they find.
Each setting takes one of these choices away, `everything` all of them, and `fused` lets the kernels
fuse multiplications with additions. Items are computed in a process of their own and compared with
data/results, as `dualarm verify` does; so are some cells of every stored study. ``--spread`` lists
what moves at all.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from machine_code import Setting, settings

from dualarm_repro.ledger.drift import differences
from dualarm_repro.ledger.files import to_json, write_text
from dualarm_repro.ledger.printed import leaves
from dualarm_repro.ledger.reference import declared, read_reference
from dualarm_repro.papers import load

ROOT = Path(__file__).resolve().parents[1]
#: The tests of this tool itself need a process without settings.
_TESTS = ("-m", "pytest", "--ignore", "tests/book/test_verify_portable.py")
COMBINED = "everything"
SEED = 20200344
#: Items of the short form, besides those that declare a tolerance.
SAMPLE = 20
#: Cells of every stored study that each setting computes again, and those of the short form.
CELLS, SHORT_CELLS = 5, 1
#: A stress that no compiler here applies by itself: a descent along a crease amplifies what it
#: changes, so that cells that come out otherwise are listed and fail nothing. Items have to hold.
STRESS = "fused"
#: Values that move by more than this, relative, are worth a look even where nothing drifts.
SPREAD = 1e-8


def environment_of(setting: Setting, scratch: Path) -> dict[str, str]:
    """Variables of a process under a setting, which has records of its own."""
    return {
        "NUMBA_CACHE_DIR": str(scratch / setting.kernels),
        "DUALARM_CACHE": str(scratch / "records" / setting.name),
        **dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"),
        **setting.environment,
    }


def run(
    arguments: Sequence[str], environment: Mapping[str, str], root: Path = ROOT
) -> subprocess.CompletedProcess:
    """Run Python in a tree, with these variables beside those that are there."""
    command = [sys.executable, *arguments]
    return subprocess.run(command, env={**os.environ, **environment}, cwd=root, check=False)


def computed(
    root: Path,
    environment: Mapping[str, str],
    item_ids: Sequence[str],
    cells: int,
    jobs: int,
    made: Path,
) -> dict[str, Any]:
    """What `portable_outcomes.py` of a tree writes to a file, with these variables.

    Raises
    ------
    RuntimeError
        The process failed.
    """
    made.unlink(missing_ok=True)
    program = str(root / "tools" / "portable_outcomes.py")
    done = run([program, str(made), str(cells), str(jobs), *item_ids], environment, root)
    if done.returncode or not made.is_file():
        raise RuntimeError(f"{made.stem}: the process ended with {done.returncode}")
    return dict(json.loads(made.read_text(encoding="utf-8")))


def outcomes(
    setting: Setting, item_ids: Sequence[str], scratch: Path, cells: int = CELLS
) -> dict[str, Any]:
    """Outcomes of items, and cells of studies that came out otherwise, under a setting.

    ``machine`` says what the process really used.

    Raises
    ------
    RuntimeError
        The process failed.
    """
    environment = environment_of(setting, scratch)
    return computed(ROOT, environment, item_ids, cells, 1, scratch / f"{setting.name}.json")


def compare(found: dict[str, Any]) -> tuple[list[str], list[str]]:
    """Lines about items that drifted, and about verdicts that changed."""
    registry, drifted, changed = load(), [], []
    reference = {
        key: part for paper in registry.papers for key, part in read_reference(paper).items()
    }
    for item_id, made in found.items():
        kept = reference.get(item_id)
        if lines := differences(kept, made, declared(registry, item_id)):
            drifted.append(f"{item_id} drifted: {'; '.join(lines)}")
        if kept and kept["verdict"] != made["verdict"]:
            changed.append(f"{item_id}: verdict {kept['verdict']} became {made['verdict']}")
    return drifted, changed


def spreads(runs: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """Every value that differs between settings, numbers by more than ``SPREAD`` relative."""
    table: dict[tuple[Any, ...], dict[str, Any]] = {}
    for name, items in runs.items():
        for path, leaf in leaves(items):
            table.setdefault(path, {})[name] = leaf
    rows = []
    for path, row in table.items():
        size = _spread(list(row.values())) if len(row) == len(runs) else float("inf")
        if size > SPREAD:
            rows.append({"path": ".".join(map(str, path)), "relative": size, "values": row})
    return sorted(rows, key=lambda row: -row["relative"])


def _spread(values: list[Any]) -> float:
    if all(value == values[0] for value in values):
        return 0.0
    if not all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
        return float("inf")
    return (max(values) - min(values)) / max(map(abs, values))


def sample(seed: int = SEED) -> list[str]:
    """Items of the short form: all that declare a tolerance, and a seeded share of the others."""
    registry = load()
    delicate = [key for key, item in registry.items.items() if item.tolerances]
    others = sorted(set(registry.items) - set(delicate))
    return delicate + random.Random(seed).sample(others, min(SAMPLE, len(others)))


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare under each setting; 1 if anything drifts, or a setting has no effect."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ids", nargs="*", help="items; default: all, or the sample of --short")
    parser.add_argument("--short", action="store_true", help=f"only `{COMBINED}`, on a sample")
    parser.add_argument("--setting", action="append", help="only this one; may be repeated")
    parser.add_argument("--spread", type=Path, help="write the values that move to this JSON file")
    parser.add_argument("--tests", action="store_true", help=f"then the tests under `{COMBINED}`")
    parser.add_argument("--cells", type=int, help=f"of every stored study, default {CELLS}")
    given = parser.parse_args(arguments)
    chosen = {setting.name: setting for setting in settings()}
    wanted = [COMBINED] if given.short else given.setting or list(chosen)
    if unknown := set(wanted) - set(chosen):
        parser.error(f"no setting {sorted(unknown)} here; there are {', '.join(chosen)}")
    ids = given.ids or (sample() if given.short else list(load().items))
    usual = SHORT_CELLS if given.short else CELLS
    cells = usual if given.cells is None else given.cells
    failed, runs = False, {}
    with tempfile.TemporaryDirectory() as folder:
        for name in wanted:
            failed |= not _report(chosen[name], ids, Path(folder), runs, cells)
        if given.tests:
            changed = environment_of(chosen[COMBINED], Path(folder))
            failed |= bool(run(_TESTS, changed).returncode)
    if given.spread:
        write_text(given.spread, to_json(spreads(runs)))
    return int(failed)


def _report(
    setting: Setting, ids: Sequence[str], scratch: Path, runs: dict[str, Any], cells: int
) -> bool:
    """Print one setting; whether it took effect and nothing moved."""
    made = outcomes(setting, ids, scratch, cells)
    runs[setting.name] = made["items"]
    without_effect = setting.without_effect(made["machine"])
    drifted, changed = compare(made["items"])
    for line in [*without_effect, *drifted, *changed, *made["wrong"]]:
        print(f"  {setting.name}: {line}")
    for line in made["unsettled"]:
        print(f"  {setting.name}, by round-off of the inputs too: {line}")
    print(
        f"{setting.name:14s} {len(made['items']):4d} checked, {len(drifted):3d} drifted, "
        f"{len(changed):3d} verdicts changed; {made['cells']:3d} cells of studies, "
        f"{len(made['wrong']):d} otherwise, {len(made['unsettled']):d} values by round-off",
        flush=True,
    )
    failing = [] if setting.name == STRESS else made["wrong"]
    return not (without_effect or drifted or changed or failing)


if __name__ == "__main__":
    sys.exit(main())
