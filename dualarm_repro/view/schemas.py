"""The JSON Schemas of everything the project reads and writes, for editors and other tools."""

from __future__ import annotations

from typing import Any


def schemas() -> dict[str, dict[str, Any]]:
    """Name of each published schema, with the schema."""
    from ..arms.robot_file import json_schema as robot
    from ..control.scenario import json_schema as scenario
    from ..ledger.record_schema import ledger_schema, published, record_schema
    from ..ledger.schema import json_schema as paper
    from ..planning.tasks.task_file import json_schema as task
    from ..scene.scene_file import json_schema as scene

    made = {
        "paper": paper(),
        "record": record_schema(),
        "ledger": ledger_schema(),
        "robot": robot(),
        "scene": scene(),
        "task": task(),
        "scenario": scenario(),
    }
    return {name: published(name, schema) for name, schema in made.items()}
