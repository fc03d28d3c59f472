"""A scene comes to life in a browser, and says so where it cannot."""

import re

import numpy as np
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.view.scene3d import Scene3D

from ..browser import dumped, needs_browser


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    arm, made = load_arm("es165d"), Scene3D("An arm and a ball.", camera=(1.0, 1.0, 1.0))
    made.add_arm("arm", arm, np.zeros(6))
    made.add_sphere("ball", np.array([1.0, 1.2, -0.5]), 0.2, "#E69F00", solid=True)
    made.animate({"arm": (arm, np.linspace(np.zeros(6), np.full(6, 1.2), 40))})
    path = tmp_path_factory.mktemp("scene") / "scene.html"
    path.write_text(made.html(), encoding="utf-8")
    return path


@needs_browser
def test_it_plays_and_measures(file, tmp_path):
    html = dumped(file, tmp_path, "--enable-unsafe-swiftshader")
    assert 'class="ledger-scene live"' in html
    assert re.search(r"closest: arm, link \d – ball, \d+ mm apart", html)
    step = re.search(r'class="scene-step"[^>]*>(\d+) / 39<', html)
    assert int(step[1]) > 0
    assert "scene-start" not in re.sub(r"<(style|script).*?</\1>", "", html, flags=re.DOTALL)


@needs_browser
def test_without_webgl_the_picture_stays(file, tmp_path):
    html = dumped(file, tmp_path, "--disable-3d-apis")
    assert 'class="ledger-scene live"' not in html
    assert "This browser draws no 3-D" in html
    assert 'class="scene-still"' in html
