"""Document `xue`: improved artificial potential field for two Motoman ES165D around a window."""

from . import (
    chain,
    chain_errata,
    claims,
    drawings,
    flow_chart,
    inputs,
    link_truth,
    method_errata,
    new_potentials,
    potentials,
    search,
    statements,
    table_2,
    tracks,
    workspace,
)

__all__ = [
    "chain",
    "chain_errata",
    "claims",
    "drawings",
    "flow_chart",
    "inputs",
    "link_truth",
    "method_errata",
    "new_potentials",
    "potentials",
    "search",
    "statements",
    "table_2",
    "tracks",
    "workspace",
]
