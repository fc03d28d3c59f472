"""The finding of a caption: its first sentence, found among abbreviations, above a figure."""

import matplotlib.pyplot as plt
import pytest

from dualarm_repro.ledger.finding import entitled, finding_of


@pytest.mark.parametrize(
    ("caption", "finding", "rest"),
    [
        ("One finding.", "One finding", ""),
        ("One finding. And more. Much.", "One finding", "And more. Much."),
        ("  It is 0.5 m. Then 3 follow.", "It is 0.5 m", "Then 3 follow."),
        ("See Fig. 3 and Eq. 4 vs. X. Rest.", "See Fig. 3 and Eq. 4 vs. X", "Rest."),
        ("See Figs. 3 and 4. Rest.", "See Figs. 3 and 4", "Rest."),
        ("Some, e.g. This one, hold. Rest.", "Some, e.g. This one, hold", "Rest."),
        ("No stop", "No stop", ""),
        ("First. second in small letters. Third.", "First. second in small letters", "Third."),
        ("Found. (Two cases.) Rest.", "Found", "(Two cases.) Rest."),
        ("Found. [1] says so.", "Found", "[1] says so."),
    ],
)
def test_the_first_sentence(caption, finding, rest):
    assert finding_of(caption) == (finding, rest)


@pytest.fixture
def figure():
    made, axes = plt.subplots(figsize=(7.5, 3.0))
    axes.plot([0, 1], [0, 1], label="line")
    made.legend(loc="upper left")
    yield made
    plt.close(made)


def test_a_figure_has_its_finding_above_everything_drawn(figure):
    top = figure.get_tightbbox().y1
    entitled(figure, "The arms stay apart. More is said below.")
    (text,) = figure.texts
    assert text.get_text() == "The arms stay apart"
    figure.draw_without_rendering()
    extent = text.get_window_extent().transformed(figure.dpi_scale_trans.inverted())
    assert extent.y0 >= top
    assert figure.get_tightbbox().y1 >= extent.y1 - 1e-6


def test_the_legend_stays_where_it_was(figure):
    figure.draw_without_rendering()
    before = figure.legends[0].get_window_extent().p0
    entitled(figure, "A finding that is as wide as the page " * 3 + ".")
    figure.draw_without_rendering()
    assert figure.legends[0].get_window_extent().p0 == pytest.approx(before, abs=1.0)  # a pixel


@pytest.mark.parametrize(("width", "letters"), [(7.5, 92), (15.0, 92), (3.75, 46)])
def test_long_findings_are_wrapped_to_the_width_and_cut_at_three_lines(width, letters):
    made, _ = plt.subplots(figsize=(width, 3.0))
    try:
        entitled(made, "word " * 200)
        lines = made.texts[0].get_text().split("\n")
    finally:
        plt.close(made)
    assert len(lines) == 3
    assert all(0.8 * letters < len(line) <= letters for line in lines)
    assert lines[-1].endswith(" …")
