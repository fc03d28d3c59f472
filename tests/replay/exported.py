"""What the command line exports, read back by the standard library and numpy alone."""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

#: Writes files as the command line does, without drawing.
WRITER = Path(__file__).parents[1] / "published_files.py"


class Export:
    """Files of items in a folder: ``ID.json`` and ``ID.csv``."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @classmethod
    def of(cls, ids, folder):
        """What the command line writes of these items, but for pictures, by another process."""
        command = [sys.executable, str(WRITER), str(folder), *ids]
        subprocess.run(command, check=True, capture_output=True, timeout=600)
        return cls(folder)

    @classmethod
    def drawn(cls, ids, folder):
        """Run ``dualarm run ID... --out FOLDER`` in a process of its own."""
        command = [sys.executable, "-m", "dualarm_repro.cli", "run", *ids, "--out", str(folder)]
        subprocess.run(command, check=True, capture_output=True, timeout=600)
        return cls(folder)

    def record(self, item_id):
        """The whole record of an item."""
        return json.loads((self.folder / f"{item_id}.json").read_text(encoding="utf-8"))

    def obtained(self, item_id):
        """What was obtained for an item."""
        return self.record(item_id)["obtained"]

    def assumed(self, item_id):
        """Values of all assumptions that an item reads, by name."""
        made = self.record(item_id)
        return {entry["id"]: entry["value"] for entry in made["assumptions"] + made["context"]}

    def table(self, item_id):
        """Columns of the CSV by name: numbers where all are, else texts."""
        with (self.folder / f"{item_id}.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        return {name: _column([row[name] for row in rows]) for name in rows[0]}


def columns(table, *names):
    """Some columns of a table side by side (N, n)."""
    return np.stack([table[name] for name in names], axis=1)


def number(text):
    """A printed number: a decimal, or a multiple of pi such as "-pi/8"."""
    sign, text = (-1.0, text[1:]) if text.startswith("-") else (1.0, text)
    if not text.startswith("pi"):
        return sign * float(text)
    return sign * np.pi / float(text.partition("/")[2] or 1.0)


def _column(texts):
    try:
        return np.array([float(text) for text in texts])
    except ValueError:
        return np.array(texts)
