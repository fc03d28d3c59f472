"""Write the JSON and CSV that ``dualarm run ID... --out FOLDER`` writes, and nothing that is drawn.

``python tests/published_files.py FOLDER ID...``. Records come from the cache; tables are computed.
"""

import sys
from pathlib import Path

from dualarm_repro.ledger import evaluate, record
from dualarm_repro.ledger.export import data_table
from dualarm_repro.ledger.files import to_json
from dualarm_repro.papers import load


def publish(folder, item_ids):
    """``ID.json`` and ``ID.csv`` of each item."""
    registry = load()
    for item_id in item_ids:
        made = record(registry, item_id)
        (folder / f"{item_id}.json").write_text(to_json(made), encoding="utf-8")
        table = data_table(evaluate(registry, item_id), made).to_csv(index=False)
        (folder / f"{item_id}.csv").write_text(table, encoding="utf-8")


if __name__ == "__main__":
    publish(Path(sys.argv[1]), sys.argv[2:])
