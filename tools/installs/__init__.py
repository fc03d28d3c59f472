"""Installs of the wheel alone: which there are, how one is made, what is asked of it."""
