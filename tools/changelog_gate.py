"""A change of the library needs a line in CHANGELOG.md, or a reason why it needs none.

Compares with where the branch left ``--base``. What counts is a line that the top section of the
changelog did not have there. A commit that changes nothing for a user says so in a trailer:
``Changelog: none, REASON``. Ends with 1 if neither is there.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIBRARY = "dualarm_repro/"
CHANGELOG = "CHANGELOG.md"
_TRAILER = re.compile(r"^Changelog: none, \S+", re.MULTILINE)


def top_section(text: str) -> set[str]:
    """Lines of the first section of a changelog, its headings left out."""
    sections = re.split(r"^## ", text, flags=re.MULTILINE)
    lines = sections[1].splitlines()[1:] if len(sections) > 1 else []
    return {line.strip() for line in lines if line.strip() and not line.startswith("#")}


def verdict(changed: Sequence[str], before: str, after: str, messages: str) -> str | None:
    """What is wrong with a change, or None: its files, the changelog before and after."""
    touched = [name for name in changed if name.startswith(LIBRARY)]
    if not touched or top_section(after) - top_section(before) or _TRAILER.search(messages):
        return None
    return (
        f"{len(touched)} files of {LIBRARY} changed, {touched[0]} for one, and the top section of "
        f"{CHANGELOG} has no new line; add one, or the trailer `Changelog: none, REASON`"
    )


def gate(root: Path, base: str) -> str | None:
    """As `verdict`, for the checked-out branch of a clone.

    Raises
    ------
    subprocess.CalledProcessError
        The base is not known.
    """

    def git(*arguments: str) -> str:
        done = subprocess.run(
            ["git", *arguments], cwd=root, capture_output=True, text=True, check=True
        )
        return done.stdout

    start = git("merge-base", base, "HEAD").strip()
    changed = git("diff", "--name-only", start, "HEAD").splitlines()
    known = CHANGELOG in git("ls-tree", "--name-only", start).splitlines()
    before = git("show", f"{start}:{CHANGELOG}") if known else ""
    after = git("show", f"HEAD:{CHANGELOG}")
    return verdict(changed, before, after, git("log", "--format=%B", f"{start}..HEAD"))


def main(arguments: Sequence[str] | None = None) -> int:
    """Judge the branch; 1 if a line is missing, 2 if the base is not known."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--base", default="origin/main", help="branch that the change goes to")
    chosen = parser.parse_args(arguments)
    try:
        wrong = gate(ROOT, chosen.base)
    except subprocess.CalledProcessError as error:
        print(f"changelog: {chosen.base}: {error.stderr.strip()}", file=sys.stderr)
        return 2
    print(f"changelog: {wrong or 'in order'}")
    return int(wrong is not None)


if __name__ == "__main__":
    sys.exit(main())
