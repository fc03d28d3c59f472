"""Where there is no browser and none can be installed, that is said and the rest is run."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def script(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


def run(command, cwd, path):
    done = subprocess.run(
        [command], cwd=cwd, env={"PATH": path}, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("apt", "code", "said"),
    [
        ("exit 100", 3, "NOT INSTALLED: apt-get could not install chromium"),
        ("exit 0", 3, "NOT INSTALLED: apt-get could not install chromium"),
        (None, 3, "NOT INSTALLED: no Chromium, and no apt-get"),
        ("touch $BIN/chromium; chmod +x $BIN/chromium", 0, "chromium: "),
    ],
    ids=["apt fails", "apt installs nothing", "no apt", "apt installs it"],
)
def test_the_installer_says_whether_there_is_a_browser(tmp_path, apt, code, said):
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("sh", "id", "env", "timeout", "touch", "chmod"):
        (folder / name).symlink_to(shutil.which(name))
    script(folder / "sudo", 'shift\nexec "$@"')
    if apt is not None:
        script(folder / "apt-get", apt.replace("$BIN", str(folder)))
    got, text = run(ROOT / "tools" / "install_chromium.sh", tmp_path, str(folder))
    assert (got, said in text) == (code, True), text


@pytest.mark.parametrize(
    ("installer", "browser", "code", "last"),
    [
        (0, 0, 0, "== passed"),
        (0, 1, 1, "== make browser"),
        (3, 0, 0, "== passed; NOT RUN: the checks in a browser, for want of one"),
    ],
    ids=["a browser", "a problem", "no browser"],
)
def test_all_is_run_but_what_needs_a_browser(tmp_path, installer, browser, code, last):
    (tmp_path / ".ci").mkdir()
    shutil.copy2(ROOT / ".ci" / "run", tmp_path / ".ci" / "run")
    script(tmp_path / "tools" / "install_chromium.sh", f"exit {installer}")
    script(tmp_path / ".venv" / "bin" / "python", "exit 0")
    script(
        tmp_path / "bin" / "make",
        f'echo "$1" >>asked\n[ "$1" = browser ] && exit {browser}\nexit 0',
    )
    path = os.pathsep.join([str(tmp_path / "bin"), os.environ["PATH"]])
    got, text = run(tmp_path / ".ci" / "run", tmp_path, path)
    assert (got, text.splitlines()[-1]) == (code, last)
    asked = (tmp_path / "asked").read_text().split()
    assert ("browser" in asked) == (installer == 0)
    assert {"test", "lint", "book"} <= set(asked)
    assert ("claims" in asked) == (code == 0)


def test_a_page_that_does_not_exist_is_one_line(tmp_path):
    command = [sys.executable, ROOT / "tools" / "browser_check.py", "--html", tmp_path]
    done = subprocess.run([*command, "--pages", "nowhere"], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].endswith(f"error: no page nowhere below {tmp_path}")
