"""Shared by the tests of the views: figures are closed, and what is drawn as a surface is kept."""

import sys

import pytest


@pytest.fixture(autouse=True)
def figures_closed():
    """Close what a test has drawn."""
    yield
    if "matplotlib.pyplot" in sys.modules:
        sys.modules["matplotlib.pyplot"].close("all")


@pytest.fixture
def surfaces(monkeypatch):
    """Arrays (x, y, z) of every surface that is drawn, with its options."""
    from mpl_toolkits.mplot3d import Axes3D

    kept, plain = [], Axes3D.plot_surface

    def drawn(self, x, y, z, **how):
        kept.append(((x, y, z), how))
        return plain(self, x, y, z, **how)

    monkeypatch.setattr(Axes3D, "plot_surface", drawn)
    return kept
