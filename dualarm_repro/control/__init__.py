"""Velocity-level control of arms that share a workspace: problem, exact solvers, closed loop."""
