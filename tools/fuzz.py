"""Fuzz for so many minutes with new seeds, and write what was found with the seeds that show it.

    python tools/fuzz.py --minutes 60 --first-seed 100000 --out fuzz.json

With ``--cases N`` it tries so many with fixed seeds instead, which takes as long as it takes.
The targets, cases and rules are those of ``tests/fuzz``; a case is named by target and seed.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
import warnings
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "fuzz"))


def main() -> int:
    """Run until the time is over; exit code 1 if a defect was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--first-seed", type=int, default=100_000)
    parser.add_argument("--cases", type=int, default=None, help="so many, whatever the time")
    parser.add_argument("--only", default="", help="targets whose name holds this")
    parser.add_argument("--out", type=Path, default=Path("fuzz.json"))
    chosen = parser.parse_args()
    from targets import cases, targets

    warnings.simplefilter("ignore", RuntimeWarning)
    names = [name for name in targets() if chosen.only in name]
    end, seed = time.monotonic() + 60.0 * chosen.minutes, chosen.first_seed
    counts: Counter[str] = Counter()
    found: dict[str, dict[str, object]] = {}
    fixed, each = chosen.cases is not None, chosen.cases or 10 * len(targets())
    while fixed or time.monotonic() < end:
        for name in names:
            for k in range(cases(name, each)):
                kind, what, case = targets()[name](seed + k)
                counts[kind] += 1
                if kind == "defect":
                    entry = {"target": name, "seed": seed + k, "case": case[-2000:]}
                    found.setdefault(f"{name}: {what}", entry)
            if not fixed and time.monotonic() > end:
                break
        if fixed:
            break
        seed += 1000
    chosen.out.write_text(json.dumps({"cases": counts, "defects": found}, indent=1) + "\n")
    print(f"{sum(counts.values())} cases, {dict(counts)}, {len(found)} kinds of defect")
    for what, entry in found.items():
        print(f"  {what} (seed {entry['seed']})")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
