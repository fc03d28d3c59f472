"""What a plan is to do: goals, postures, task files."""
