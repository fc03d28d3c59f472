"""Faults that a machine, a disk or a user brings about, and what a command has to do under them."""
