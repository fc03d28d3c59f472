"""The build of the book looks for garbage rarely, and first of all extensions."""

import gc
from pathlib import Path

import rare_collections
import yaml


def test_the_collector_waits_for_more_objects(monkeypatch):
    set_to = []
    monkeypatch.setattr(gc, "set_threshold", lambda *limits: set_to.append(limits))
    assert rare_collections.setup(None)["parallel_read_safe"]
    assert set_to[0][0] > 700, "after which Python looks"


def test_it_is_loaded_first():
    config = yaml.safe_load(Path(__file__).parents[2].joinpath("_config.yml").read_text())
    assert config["sphinx"]["config"]["extensions"][0] == "rare_collections"
