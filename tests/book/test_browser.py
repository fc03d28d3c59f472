"""Every check in a browser can fail: a healthy page, and one page per kind of problem."""

import asyncio

import pytest
from browser import chromium, links, page_checks, scenes, without_scripts
from browser.report import CHECKS, Report
from browser.visit import WIDE, visit

pytestmark = pytest.mark.skipif(
    chromium.executable() is None, reason=f"NOT RUN: {chromium.WHY_NOT}"
)

PAGE = """<!DOCTYPE html><html lang="en" data-theme="light"><head>
<meta charset="utf-8"><title>A page</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>{style}</style></head>
<body><main><article><h1>A page</h1><p id="there">Words that <a href="good.html#there">say</a>
something.</p>{body}</article></main></body></html>"""
#: A scene that draws what ``paint`` says once it is started; ``k`` counts the pictures.
SCENE = """<figure class="ledger-scene" data-moves="{moves}"><button class="scene-start">Go</button>
<script>const start = document.querySelector(".scene-start");
start.addEventListener("click", () => {{
const canvas = Object.assign(document.createElement("canvas"), {{width: 100, height: 80}});
start.replaceWith(canvas); const on = canvas.getContext("2d"); let k = 0;
(function draw() {{ k += 1; {paint} requestAnimationFrame(draw); }})(); }});</script></figure>"""
RED = "on.clearRect(0, 0, 100, 80); on.fillStyle = '#d00'; on.fillRect({x}, 20, 30, 30);"
BODIES = {
    "good": "<details><summary>More</summary><p>Folded words.</p></details>",
    "console": "<script>console.error('no such arm'); throw new Error('broken');</script>",
    "external": '<p style="background: url(http://localhost:1/x.png)">Far away.</p>',
    "missing": '<img alt="nothing" src="none.png">',
    "maths": '<span class="math">x^2</span>',
    "wide": '<p style="width: 1500px">A line</p>',
    "folded": '<details><summary>More</summary><p style="width: 500px">A line</p></details>',
    "cut": '<p style="overflow: hidden; text-overflow: ellipsis; white-space: nowrap">'
    + "A long title. " * 40
    + "</p>",
    "hidden": f'<div class="cell_input" style="overflow: auto"><pre>{"x = 1; " * 300}</pre></div>',
    "nameless": "<button></button>",
    "pale": '<p class="pale">Pale words.</p>',
    "large": '<img alt="large" src="large.svg">',
    "typeset": '<span class="math">x</span><script>document.querySelector(".math").innerHTML ='
    + " '<mjx-container>' + 'x '.repeat(60) + '</mjx-container>'</script>",
    "written": "<script>document.write('<p>' + 'word '.repeat(50) + '</p>')</script>",
}
STYLES = {"pale": 'html[data-theme="dark"] .pale { color: #ddd; background: #fff; }'}
STAGES = {
    "moves": SCENE.format(moves="yes", paint=RED.format(x="k % 5 * 15")),
    "stands": SCENE.format(moves="yes", paint=RED.format(x=10)),
    "still": SCENE.format(moves="no", paint=RED.format(x=10)),
    "dark": SCENE.format(moves="no", paint=RED.format(x=10).replace("#d00", "#5f6468")),
    "pale grey": SCENE.format(moves="no", paint=RED.format(x=10).replace("#d00", "#b0b0b0")),
    "blank": SCENE.format(moves="no", paint=""),
    "paused": SCENE.format(moves="yes", paint="k -= !play.playing;" + RED.format(x="k % 5 * 15")),
}
#: A button that has to be pressed before anything moves.
PLAY = """<button class="play">Play</button><script>const play = document.querySelector(".play");
play.addEventListener("click", () => { play.playing = true; });</script></figure>"""


@pytest.fixture(scope="module")
def html(tmp_path_factory):
    folder = tmp_path_factory.mktemp("html")
    for name, body in BODIES.items():
        text = PAGE.format(body=body, style=STYLES.get(name, ""))
        (folder / f"{name}.html").write_text(text)
    (folder / "large.svg").write_text(
        f"<!--{'x' * 3_000_000}--><svg xmlns='http://www.w3.org/2000/svg'/>"
    )
    for name, stage in STAGES.items():
        scene = stage.replace("</figure>", PLAY) if name == "paused" else stage
        (folder / f"{name}.html").write_text(PAGE.format(body=scene, style=""))
    return folder


@pytest.fixture(scope="module")
def found(html):
    """Problems by page and check, from one run of the browser."""

    async def run():
        async with chromium.browser() as running:
            context = await running.new_context(viewport=WIDE)
            plain = await running.new_context(java_script_enabled=False)
            await scenes.spare(context)
            report = Report(running.version)
            for name in BODIES:
                words = await page_checks.look_at(context, html, name, report, closely=True)
                await without_scripts.read_page(plain, html, name, words, report)
            for name in STAGES:
                await scenes.look_at_scenes(context, html, name, report)
        return report

    old, scenes.LOOKS = scenes.LOOKS, 6
    report = asyncio.run(run())
    scenes.LOOKS = old
    return report


def problems(report, page):
    return {problem.check: problem.text for problem in report.problems if problem.page == page}


def test_a_healthy_page_has_no_problem(found):
    assert problems(found, "good") == problems(found, "typeset") == {}
    assert found.tried.keys() >= CHECKS.keys() - {"links", "use"}


@pytest.mark.parametrize(
    ("page", "check", "text"),
    [
        ("console", "console", "broken"),
        ("external", "console", "external request"),
        ("missing", "console", "failed request"),
        ("missing", "scripts", "1 pictures are blank"),
        ("maths", "maths", "not typeset: x^2"),
        ("wide", "width", "1500px"),
        ("folded", "width", "on 390"),
        ("cut", "width", "cut off: A long title."),
        ("hidden", "width", "1440 px, cut off: x = 1;"),
        ("nameless", "access", "button-name (critical"),
        ("pale", "access", "dark: color-contrast (serious"),
        ("large", "size", "3.0 MB"),
        ("written", "scripts", "words without scripts"),
        ("stands", "scenes", "stands still"),
        ("blank", "scenes", "draws nothing"),
        ("pale grey", "scenes", "draws nothing"),
    ],
)
def test_each_problem_is_seen(found, page, check, text):
    seen = [p.text for p in found.problems if (p.page, p.check) == (page, check)]
    assert any(text in one for one in seen), problems(found, page)


def test_scenes_that_draw_and_move_are_no_problem(found):
    drawn = ("moves", "still", "paused", "dark")
    assert [problems(found, name) for name in drawn] == [{}] * len(drawn)


def test_numbers_are_searched_for_as_the_index_has_them(html):
    from item_pages import number_words

    script = page_checks.Path(__file__).parents[2] / "book/_static/search_numbers.js"
    query = "trapped in 0.53 of 1000 at -100.28502, 8 of 10"

    async def run():
        async with chromium.browser() as running:
            context = await running.new_context()
            async with visit(context, html / "good.html") as made:
                await made.page.add_script_tag(path=script)
                return await made.page.evaluate("(query) => splitQuery(query)", query)

    words = asyncio.run(run())
    assert number_words(query) == ["number_0_53", "number_1000", "number_100_28502"]
    assert words == [*number_words(query), "trapped", "in", "of", "at", "8", "of", "10"]


def test_links_lead_somewhere(html):
    page = html / "links.html"
    targets = (
        "good.html",
        "good.html#there",
        "good.html#nowhere",
        "none.html",
        "http://a.example/",
        "#x",
    )
    page.write_text(PAGE.format(body="".join(f'<a href="{t}">t</a>' for t in targets), style=""))
    assert links.dead_links(page, html) == [
        "no such place: good.html#nowhere",
        "no such file: none.html",
        "leaves the book: http://a.example/",
        "no such place: #x",
    ]
