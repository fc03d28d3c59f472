"""Capsules that lie close around the shapes of links, and which of their pairs say nothing."""
