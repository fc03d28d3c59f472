"""Many runs of one planner: from perturbed starts, on random tasks, and what they come to."""
