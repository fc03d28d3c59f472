"""Executable reproduction of four documents on robot arms that share a workspace."""
