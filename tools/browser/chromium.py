"""The Chromium of the system, which playwright drives; no browser is downloaded."""

from __future__ import annotations

import os
import shutil
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from playwright.async_api import Browser, async_playwright

NAMES = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
#: WebGL without a graphics card; no sandbox, since Chromium refuses one to root.
_OPTIONS = ("--enable-unsafe-swiftshader", "--no-sandbox", "--disable-dev-shm-usage")
#: Exit code of whatever could not run for want of a browser.
NOT_RUN = 3
WHY_NOT = "no Chromium on this machine; tools/install_chromium.sh installs it where apt-get can"


def executable() -> Path | None:
    """The browser that ``CHROMIUM`` names, else the first on the path; None if there is none."""
    names = [os.environ["CHROMIUM"]] if "CHROMIUM" in os.environ else NAMES
    found = next(filter(None, map(shutil.which, names)), None)
    return Path(found) if found else None


@asynccontextmanager
async def browser() -> AsyncIterator[Browser]:
    """A running browser, closed at the end.

    Raises
    ------
    FileNotFoundError
        There is no browser.
    """
    path = executable()
    if path is None:
        raise FileNotFoundError(WHY_NOT)
    async with async_playwright() as driver:
        running = await driver.chromium.launch(executable_path=path, args=list(_OPTIONS))
        try:
            yield running
        finally:
            await running.close()
