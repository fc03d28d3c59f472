"""What a page looks like to a program after a browser has run its scripts."""

import shutil
import subprocess

import pytest

CHROMIUM = shutil.which("chromium")
needs_browser = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")


def dumped(path, folder, *options):
    """The document of a file after three seconds of its own time."""
    command = [CHROMIUM, "--headless", "--no-sandbox", f"--user-data-dir={folder / 'profile'}"]
    command += ["--virtual-time-budget=3000", *options, "--dump-dom", path.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=120).stdout
