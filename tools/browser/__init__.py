"""Checks of the built book in a browser, one concern a module."""
