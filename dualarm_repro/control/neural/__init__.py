"""Neural solvers of the velocity problem, as differential equations and at a fixed rate."""
