"""Search from both ends, its joined path, and the sampling planner beside it."""
