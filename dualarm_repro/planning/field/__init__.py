"""The potential field: control points, obstacles, attraction and repulsion."""
