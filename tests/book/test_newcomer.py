"""The way of a newcomer is walked in a browser: a good one, one that ends early, one too long."""

import asyncio

import pytest
from browser import chromium, newcomer

pytestmark = pytest.mark.skipif(
    chromium.executable() is None, reason=f"NOT RUN: {chromium.WHY_NOT}"
)

FRONT = """<div class="ledger-picture"><a href="items/xue.tab02.html">Table 2</a></div>"""
CARD = """<div class="ledger-item"><dl class="ledger-line">
<dd><span class="verdict">open</span></dd></dl>
<details class="ledger-checks"><summary>What was checked</summary>
<ul><li>8 of 10</li></ul></details>
<details><summary>Code</summary><div class="highlight"><pre>def trials(): ...</pre></div>
<div><pre>dualarm run xue.tab02
dualarm run xue.tab02 --set base_distance=3.0</pre></div></details>
<details><summary>Cite</summary><pre>@misc{xue}</pre></details></div>"""


@pytest.fixture
def walked(tmp_path):
    def walk(front=FRONT, card=CARD):
        (tmp_path / "items").mkdir(exist_ok=True)
        (tmp_path / "intro.html").write_text(front)
        (tmp_path / "items" / "xue.tab02.html").write_text(card)

        async def run():
            async with chromium.browser() as running:
                return await newcomer.walk(await running.new_context(), tmp_path)

        return asyncio.run(run())

    return walk


def test_a_way_of_five_steps_is_good_and_a_longer_one_is_not(walked, monkeypatch):
    assert walked() == []
    monkeypatch.setattr(newcomer, "MOST", 4)
    (line,) = walked()
    assert line.startswith("5 steps: its cell in the picture of all verdicts, ")
    assert "dualarm run xue.tab02 --set base_distance=3.0, " in line


@pytest.mark.parametrize(
    ("part", "instead", "missing"),
    [
        ("<pre>@misc{xue}</pre>", "", "the citation"),
        (" --set base_distance=3.0", "", "the command"),
        ("<li>8 of 10</li>", "", "the reason"),
        ("<summary>Code", "<summary>Source", "the fold Code"),
    ],
)
def test_a_way_that_ends_early_is_seen(walked, monkeypatch, part, instead, missing):
    monkeypatch.setattr(newcomer, "_SOON", 300)
    (line,) = walked(card=CARD.replace(part, instead))
    assert line.startswith(missing)


def test_a_front_page_that_leads_nowhere_is_seen(walked, monkeypatch):
    monkeypatch.setattr(newcomer, "_SOON", 300)
    (line,) = walked(front="<p>Nothing</p>")
    assert line.startswith("its cell")
