"""Cards, badges, tables and static scenes."""

import base64
import re

import numpy as np
import pytest
import umsgpack

from dualarm_repro.arms import load_arm
from dualarm_repro.ledger import MEANING, Verdict
from dualarm_repro.papers import show
from dualarm_repro.view.badge import SIGN, badge
from dualarm_repro.view.card import card_html, head_html
from dualarm_repro.view.overview import counts_page, ledger_page, verdict_counts
from dualarm_repro.view.scene3d import Scene3D
from dualarm_repro.view.wording import short

from .full_record import EMPTY


def test_every_verdict_has_meaning_sign_and_badge():
    assert set(MEANING) == set(SIGN) == set(Verdict)
    assert len(set(SIGN.values())) == len(Verdict)
    for verdict in Verdict:
        assert f"verdict-{verdict}" in badge(verdict)


def test_short_numbers():
    assert short([0.12345678, {"a": True}, None]) == "(0.1235, a: yes, none)"


def test_card_escapes_text():
    made = {**EMPTY, "title": "a < b", "missing": ["<script>"], "printed": {"a": "<b>"}}
    html = head_html(made, "") + card_html(made)
    assert "<script>" not in html
    assert "a &lt; b" in html
    assert "&lt;b&gt;" in html
    assert html.count("<details>") == html.count("</details>") == 1


def test_page_of_an_item():
    html = show("xue.fig02").html
    assert 'id="xue.fig02"' in html
    assert re.search(r'<img alt="[^"]{30,}" src="data:image/svg\+xml;base64,', html)
    assert "verdict-regenerated" in html
    assert "http" not in re.sub(r"base64,[^\"]*", "", html)


def test_overview_counts_everything(registry):
    table = verdict_counts(registry)
    assert table.loc["total", "total"] == len(registry.items)
    assert (table.iloc[:-1].sum() == table.iloc[-1]).all()
    assert 'id="verdict-counts"' in counts_page(registry).html
    assert ledger_page(registry).html.count('<details class="ledger-row"') == len(registry.items)


def _commands(html):
    text = re.search(r"for \(const text of \[(.*?)\]\)", html, re.DOTALL).group(1)
    return [umsgpack.unpackb(base64.b64decode(part)) for part in re.findall(r'"([^"]+)"', text)]


@pytest.fixture(scope="module")
def scene():
    arm = load_arm("es165d")
    made = Scene3D("One arm & a box", camera=(3.0, -3.0, 2.0))
    made.add_arm("arm", arm, np.zeros(6))
    made.add_points("cloud", np.zeros((10, 3)), "#0072B2")
    made.add_path("path", np.zeros((3, 3)), "#0072B2")
    made.add_box("box", np.ones(3), np.eye(4), "#D55E00")
    made.add_sphere("ball", np.zeros(3), 0.1, "#D55E00")
    made.animate({"arm": (arm, np.linspace(np.zeros(6), np.ones(6), 10))}, every=4)
    return made


def test_scene_is_complete_and_static(scene):
    commands = _commands(scene.html())
    paths = {command.get("path") for command in commands}
    assert {"/meshcat/cloud", "/meshcat/path", "/meshcat/box", "/meshcat/ball"} <= paths
    assert commands[-1]["type"] == "set_animation"
    keys = commands[-1]["animations"][0]["clip"]["tracks"][0]["keys"]
    assert [key["time"] for key in keys] == [0, 4, 8, 9]
    geometries = load_arm("es165d").geometry.ngeoms
    assert sum("/tube" in str(p) for p in paths) == geometries


def test_joint_nodes_carry_the_kinematics():
    arm = load_arm("es165d")
    q = np.array([0.3, -1.0, 0.5, 0.2, -0.4, 0.1])
    made = Scene3D("pose", camera=(3.0, -3.0, 2.0))
    made.add_arm("arm", arm, q)
    last = [c for c in _commands(made.html()) if c.get("path") == "/meshcat/arm/joint6"][-1]
    pose = np.array(last["matrix"]).reshape(4, 4).T
    np.testing.assert_allclose(pose, arm.fk(q), atol=1e-12)


def test_page_shares_one_viewer(scene):
    page, alone = scene.page_html(), scene.html()
    assert len(page) < 0.3 * len(alone)
    assert "_static/meshcat/main.min.js" in page
    assert 'title="One arm &amp; a box"' in page
    assert "http" not in page.replace("http-equiv", "")
