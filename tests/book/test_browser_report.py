"""The status page says that the checks in a browser were not run, until they were."""

import pytest

from dualarm_repro.view.browser_report import browser_page, report_html

FOUND = {
    "chromium": "1.2",
    "pages": 3,
    "problems": 1,
    "checks": [
        {"check": "width", "holds": "nothing too wide", "tried": 3, "problems": 1},
        {"check": "scenes", "holds": "scenes draw", "tried": 0, "problems": 0},
    ],
    "listed": [{"check": "width", "page": "a/b", "text": "600 px on 390: <p>"}],
}


def test_not_run_is_said():
    assert "Not run on this build" in browser_page().html
    assert "problems" not in browser_page().html


def test_what_was_found_is_said():
    html = report_html(FOUND)
    assert "3 pages, 1 problems" in html
    assert "<td>not run</td><td>0</td>" in html
    assert "a/b: width: 600 px on 390: &lt;p&gt;" in html
    assert "<details>" not in report_html(FOUND | {"listed": [], "problems": 0})


@pytest.mark.parametrize("times", [1, 2])
def test_the_report_is_written_into_the_build(tmp_path, times):
    from browser import report

    (tmp_path / "_static").mkdir()
    status = tmp_path / "status.html"
    status.write_text(f"<p>before</p>{browser_page().html}<p>after</p>")
    for _ in range(times):
        made = report.Report("1.2")
        made.add("width", "a", ["600 px"])
        report.publish(made, tmp_path)
    text = status.read_text()
    assert text.startswith("<p>before</p>")
    assert text.rstrip().endswith("<p>after</p>")
    assert text.count("1 pages, 1 problems") == 1
    assert "Not run" not in text
    status.write_text("<p>another page</p>")
    with pytest.raises(ValueError, match="no place"):
        report.publish(made, tmp_path)
