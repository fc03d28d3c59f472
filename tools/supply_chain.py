"""Write data/licences.csv and data/sbom.cdx.json from the locks, or say that they are not current.

Licences are read from installed distributions; ``--site FOLDER`` names the site-packages of further
environments, those of the other locks for instance. A distribution that is installed nowhere here,
since its marker asks for another platform, keeps the licence that the table has. ``--check`` writes
nothing and ends with 1 if the bill is not what the locks give.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.metadata import distributions
from pathlib import Path

from installs.rows import project_table
from supply import licences
from supply.bill import BILL, bill
from supply.locks import read_all

ROOT = Path(__file__).resolve().parents[1]


def collected(sites: Sequence[Path]) -> tuple[dict[str, tuple[str, str]], list[str]]:
    """Licences of all locked distributions, and the names of those without one."""
    installed = licences.by_name(distributions(path=[*sys.path, *map(str, sites)]))
    before = licences.read(ROOT) if (ROOT / licences.TABLE).is_file() else {}
    table, missing = {}, []
    for name in sorted({one.name for pinned in read_all(ROOT).values() for one in pinned}):
        found = licences.licence(name, installed.get(name)) or before.get(name)
        if found:
            table[name] = found
        else:
            missing.append(name)
    return table, missing


def main(arguments: Sequence[str] | None = None) -> int:
    """Write or check; 1 if something is missing or not current."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing")
    parser.add_argument("--site", type=Path, action="append", default=[], help="site-packages")
    chosen = parser.parse_args(arguments)
    if not chosen.check:
        table, missing = collected(chosen.site)
        if missing:
            print(f"no licence known: {', '.join(missing)}", file=sys.stderr)
            return 1
        licences.write(ROOT, table)
        (ROOT / BILL).write_text(bill(ROOT, project_table(ROOT)), encoding="utf-8")
        print(f"{len(table)} distributions in {licences.TABLE} and {BILL}")
        return 0
    current = (ROOT / BILL).read_text(encoding="utf-8") == bill(ROOT, project_table(ROOT))
    print(f"{BILL}: {'current' if current else 'not what the locks give: make supply-chain'}")
    return 0 if current else 1


if __name__ == "__main__":
    sys.exit(main())
