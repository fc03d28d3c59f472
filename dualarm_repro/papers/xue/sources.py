"""What the stored studies of `xue` depend on: their outcome is stale once one of these changes."""

_PLANNING = (
    "batch", "certificate", "compiled", "control_points", "field_kernels", "link_clearance",
    "master_slave", "nearest_kernels", "obstacles", "outcome", "plan", "potentials", "problem",
    "settings", "termination", "update_kernels", "updates", "virtual_point",
)  # fmt: skip
_HERE = ("facts", "layout", "methods", "motions", "postures", "scenario", "trials", "truth")

SOURCES = (
    "arms",
    "scene",
    *(f"planning/{name}.py" for name in _PLANNING),
    *(f"papers/xue/{name}.py" for name in _HERE),
)
ROBOTS = ("robots/es165d.yaml", "robots/es165d-slave.yaml")
