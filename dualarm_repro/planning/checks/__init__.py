"""What a plan is worth in truth: whole links, obstacles, floor, limits."""
