"""What the checks in a browser found in the built book, for its status page.

A page is built before a browser can look at it. So the page says that the checks were not run, and
``make browser`` writes what it found into the very build it looked at.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markupsafe import Markup

from .page import Page
from .rendering import render

#: Name of the place on the status page that is filled when the checks have run.
ANCHOR = "browser-checks"


def report_html(found: Mapping[str, Any] | None) -> Markup:
    """The outcome of ``make browser`` as a table; None: it was not run on this build."""
    return render("browser", found=found, anchor=ANCHOR)


def browser_page() -> Page:
    """The place of the outcome, which says that there is none yet."""
    return Page(report_html(None))
