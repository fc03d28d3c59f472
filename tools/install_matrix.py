"""Install the wheel alone in many environments outside the clone, and use it there.

Rows: every released Python with locked and newest versions of the dependencies, the lowest versions
that `pyproject.toml` allows, and every extra. In each the wheel is imported, lists its items, runs
one, verifies it and plans the example. ``data/results/install_matrix.json`` says how each row
ended; one that could not be tried is `not run`, with the reason. ``--resume`` leaves out rows whose
demands have not changed since they passed. Ends with 1 if a row failed.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from installs.environment import InstallFailed, build_wheel, install, interpreter, run, variables
from installs.questions import answers
from installs.rows import Row, fingerprint, project_table, rows

ROOT = Path(__file__).resolve().parents[1]
STORED = ROOT / "data" / "results" / "install_matrix.json"
PASSED, FAILED, NOT_RUN = "passed", "failed", "not run"
#: Distributions whose versions a row reports, beside Python's.
SHOWN = ("numpy", "scipy", "numba", "pin", "coal", "cvxpy", "matplotlib", "pydantic", "sympy")


def tried(row: Row, uv: Path, wheel: Path, folder: Path, limit: float) -> dict[str, Any]:
    """Install a row and ask it; what is stored of it."""
    environment = folder / row.name
    record = row.record | {"demands": fingerprint(row, ROOT)}
    if interpreter(row.python) is None:
        return record | {"outcome": NOT_RUN, "reason": f"no Python {row.python} on this machine"}
    try:
        python = install(row, uv, wheel, ROOT, environment, limit)
        found = _versions(python, environment)
        record |= {"versions_found": found}
        passed = answers(python, row.extra, ROOT, environment, variables(environment), limit)
        return record | {"outcome": PASSED, "steps": passed}
    except InstallFailed as failure:
        return record | {"outcome": FAILED, "step": failure.step, "reason": failure.message}
    finally:
        shutil.rmtree(environment, ignore_errors=True)


def _versions(python: Path, environment: Path) -> dict[str, str]:
    ask = (
        "import json, platform; from importlib.metadata import version as v;"
        f"print(json.dumps({{'python': platform.python_version()}} | {{n: v(n) for n in {SHOWN}}}))"
    )
    return json.loads(run("versions", [python, "-c", ask], environment, variables(environment)))


def stored() -> dict[str, dict[str, Any]]:
    """Rows of the stored file by name."""
    if not STORED.is_file():
        return {}
    return {row["name"]: row for row in json.loads(STORED.read_text(encoding="utf-8"))["rows"]}


def write(found: dict[str, dict[str, Any]], order: Sequence[Row]) -> None:
    """Store rows in the order of the matrix, with counts; those not tried yet say so."""
    untried = {"outcome": NOT_RUN, "reason": "not tried yet"}
    ordered = [
        found.get(row.name) or row.record | {"demands": fingerprint(row, ROOT)} | untried
        for row in order
    ]
    counts = {o: sum(r["outcome"] == o for r in ordered) for o in (PASSED, FAILED, NOT_RUN)}
    text = json.dumps({"counts": counts, "rows": ordered}, indent=1, ensure_ascii=False)
    STORED.write_text(text + "\n", encoding="utf-8")


@contextmanager
def _scratch(given: Path | None) -> Iterator[Path]:
    """A folder that is there to stay if it was asked for."""
    if given is not None:
        given.mkdir(parents=True, exist_ok=True)
        yield given.resolve()
        return
    with tempfile.TemporaryDirectory(prefix="installs-") as name:
        yield Path(name)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the rows and store each as soon as it has ended."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rows", nargs="*", help="names of rows, all without any")
    parser.add_argument("--resume", action="store_true", help="leave out what passed before")
    parser.add_argument("--list", action="store_true", help="list the rows and run nothing")
    parser.add_argument("--uv", type=Path, default=ROOT / ".boot" / "bin" / "uv")
    parser.add_argument(
        "--scratch", type=Path, help="folder for environments and kernels; without, a new one"
    )
    parser.add_argument(
        "--limit", type=float, default=900, help="seconds of computing for each step"
    )
    chosen = parser.parse_args(arguments)
    order = rows(list(project_table(ROOT)["optional-dependencies"]))
    found, names = stored(), {row.name for row in order}
    if unknown := set(chosen.rows) - names:
        parser.error(f"no such row: {', '.join(sorted(unknown))}")
    if chosen.list:
        for row in order:
            print(f"{row.name:24s}{found.get(row.name, {}).get('outcome', 'not stored')}")
        return 0
    for name in set(found) - names:
        del found[name]
    with _scratch(chosen.scratch) as scratch:
        wheel = build_wheel(ROOT, scratch)
        for row in order:
            before = found.get(row.name, {})
            same = before.get("demands") == fingerprint(row, ROOT)
            if chosen.rows and row.name not in chosen.rows:
                continue
            if chosen.resume and same and before.get("outcome") == PASSED:
                continue
            found[row.name] = tried(row, chosen.uv.resolve(), wheel, scratch, chosen.limit)
            write(found, order)
            record = found[row.name]
            print(f"{row.name:24s}{record['outcome']:10s}{record.get('reason', '')}", flush=True)
    return int(any(record["outcome"] == FAILED for record in found.values()))


if __name__ == "__main__":
    sys.exit(main())
