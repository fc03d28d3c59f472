"""Licences of what the locks install, as SPDX expressions, from what distributions say themselves.

``data/licences.csv`` keeps them, so that a list of all platforms can be checked on one of them.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable
from importlib.metadata import Distribution
from pathlib import Path

from .locks import plain

TABLE = Path("data") / "licences.csv"
_FIELDS = ("distribution", "licence", "stated_in")
#: What the field and the classifiers of older distributions say, in SPDX.
_SPELLINGS = {
    "apache 2.0": "Apache-2.0",
    "apache license 2.0": "Apache-2.0",
    "apache license, version 2.0": "Apache-2.0",
    "apache software license": "Apache-2.0",
    "bsd": "BSD-3-Clause",
    "bsd license": "BSD-3-Clause",
    "bsd 2-clause license": "BSD-2-Clause",
    "bsd 3-clause license": "BSD-3-Clause",
    "gnu general public license v2 or later (gplv2+)": "GPL-2.0-or-later",
    "gplv2+": "GPL-2.0-or-later",
    "gnu lesser general public license v3 (lgplv3)": "LGPL-3.0-only",
    "isc license": "ISC",
    "isc license (iscl)": "ISC",
    "mit": "MIT",
    "mit license": "MIT",
    "mozilla public license 2.0 (mpl 2.0)": "MPL-2.0",
    "psfl": "PSF-2.0",
    "python software foundation license": "PSF-2.0",
}
_SPDX = re.compile(r"[A-Za-z0-9.+-]+(?: (?:AND|OR|WITH) [A-Za-z0-9.+-]+)*")
#: Read by hand where a distribution says nothing that a program could read, or says it wrongly.
READ_BY_HAND = {
    "axe-playwright-python": ("MIT", "LICENSE file of the distribution"),
    "cmeel-qhull": ("Qhull", "COPYING.txt of Qhull"),
    "deap": ("LGPL-3.0-or-later", "LICENSE.txt of the distribution"),
    "docutils": (
        "BSD-2-Clause AND PSF-2.0 AND GPL-3.0-or-later",
        "COPYING.txt; under the GPL is only a mode for an editor, which is not installed",
    ),
    "graphemeu": ("MIT", "LICENSE file of the distribution"),
    "ik-geo": ("BSD-3-Clause", "LICENSE file of the distribution"),
    "matplotlib": ("PSF-2.0", "classifier"),
    "pyglet": ("BSD-3-Clause", "LICENSE file of the distribution"),
    "vhacdx": ("MIT AND BSD-3-Clause", "LICENSE files of the distribution and of V-HACD"),
    "xacro": ("BSD-3-Clause", "LICENSE file of the distribution"),
}


def stated(distribution: Distribution) -> tuple[str, str] | None:
    """SPDX expression of a distribution and the place that states it; none where nothing does."""
    told = distribution.metadata
    if expression := told.get("License-Expression"):
        return expression, "License-Expression"
    lines = (told.get("License") or "").strip().splitlines()
    field = lines[0].strip() if lines else ""
    if found := _SPELLINGS.get(" ".join(re.sub(r"Copyright.*", "", field).lower().split())):
        return found, "License"
    if field not in ("UNKNOWN", "Copyright") and _SPDX.fullmatch(field) and "-" in field:
        return field, "License"
    classifiers = [c.split(" :: ")[-1] for c in told.get_all("Classifier") or () if "License" in c]
    named = [_SPELLINGS[c.lower()] for c in classifiers if c.lower() in _SPELLINGS]
    return (" AND ".join(named), "classifier") if named else None


def licence(name: str, distribution: Distribution | None) -> tuple[str, str] | None:
    """As `stated`, after what was read by hand."""
    if name in READ_BY_HAND:
        return READ_BY_HAND[name]
    return stated(distribution) if distribution is not None else None


def read(root: Path) -> dict[str, tuple[str, str]]:
    """The table: name to SPDX expression and where it is stated."""
    with (root / TABLE).open(encoding="utf-8", newline="") as file:
        return {
            row["distribution"]: (row["licence"], row["stated_in"]) for row in csv.DictReader(file)
        }


def write(root: Path, table: dict[str, tuple[str, str]]) -> None:
    """Write the table, sorted by name."""
    with (root / TABLE).open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(_FIELDS)
        writer.writerows((name, *table[name]) for name in sorted(table))


def by_name(distributions: Iterable[Distribution]) -> dict[str, Distribution]:
    """Installed distributions by normalised name, the first of each."""
    found: dict[str, Distribution] = {}
    for one in distributions:
        found.setdefault(plain(one.metadata["Name"] or ""), one)
    return found


def strong(expression: str) -> bool:
    """Whether an expression asks for the GPL, whatever else it offers besides."""
    choices = re.split(r"\bOR\b", expression)
    return all(re.search(r"\b(?:A?GPL)-", choice) for choice in choices)
