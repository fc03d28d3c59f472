"""Look for secrets, paths of one machine and addresses of package registries in tracked files.

Each finding is one line: file, line, what it is. What looks like one and is none is listed in
``KNOWN`` with its reason. Ends with 1 if anything is found.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# Written in parts, so that this file holds none of what it looks for.
_REGISTRIES = (
    ("pypi", "org"), ("files", "pythonhosted", "org"), ("registry", "npmjs", "org"),
    ("registry", "yarnpkg", "com"), ("conda", "anaconda", "org"), ("repo", "anaconda", "com"),
    ("repo1", "maven", "org"), ("static", "crates", "io"), ("index", "crates", "io"),
    ("proxy", "golang", "org"), ("rubygems", "org"), ("registry-1", "docker", "io"),
    ("ghcr", "io"), ("quay", "io"), ("deb", "debian", "org"),
)  # fmt: skip
_OWN = r"(?:127\.0\.0\.1|0\.0\.0\.0|localhost)"
#: What a line must not hold.
PATTERNS: Mapping[str, re.Pattern[str]] = {
    "a private key": re.compile(r"-----BEGIN (?:[A-Z]+ )*PRIVATE KEY"),
    "a token": re.compile(
        r"\b(?:AKIA[0-9A-Z]{16}|gh[pousr]_[A-Za-z0-9]{36,}|github_pat_\w{40,}|glpat-[\w-]{20,}"
        r"|xox[abprs]-[\w-]{10,}|sk-[A-Za-z0-9_-]{32,}|pypi-AgE[\w-]{40,}|hf_[A-Za-z0-9]{30,}"
        r"|eyJ[\w-]{10,}\.eyJ[\w-]{10,}\.[\w-]{10,})"
    ),
    "a password": re.compile(
        r"""(?i)\b(?:password|passwd|secret|api_?key|token)["']?\s*[:=]\s*["'][^"'\s{}$<]{8,}["']"""
    ),
    "an address with a login": re.compile(r"[a-z]+://[^/\s:@\"']+:[^/\s:@\"']+@"),
    "a path of one machine": re.compile(
        r"(?<![\w.:/-])/(?:home|Users|root|work|mnt|media|scratch|builds)/[A-Za-z0-9._-]+"
        r"|\b[A-Z]:\\+Users\\"
    ),
    "an address of one network": re.compile(
        rf"://(?!{_OWN})\d{{1,3}}(?:\.\d{{1,3}}){{3}}|\b[\w-]+\.(?:internal|corp|lan)\b"
    ),
    "the host of a package registry": re.compile(
        r"\b(?:" + "|".join(re.escape(".".join(parts)) for parts in _REGISTRIES) + r")\b"
    ),
    "a setting of a package index": re.compile(
        r"(?i)(?:--(?:extra-)?index-url|--find-links|\b(?:extra-)?index-url\s*=)"
    ),
}
#: File and what it seems to hold, with the reason why it is none.
KNOWN: Mapping[tuple[str, str], str] = {
    ("tests/book/test_check_book.py", "a path of one machine"): "what the checker has to find",
    ("tests/ledger/test_trust.py", "a path of one machine"): "what the report has to leave out",
    ("tools/check_leaks.py", "a setting of a package index"): "the pattern itself",
}
#: Longer lines are data: a picture in text, a compressed script.
_LONGEST = 20_000


def found(text: str) -> Iterator[tuple[int, str]]:
    """Number of a line and what it holds, for every finding in a text."""
    for number, line in enumerate(text.splitlines(), 1):
        for what, pattern in PATTERNS.items():
            if len(line) <= _LONGEST and pattern.search(line):
                yield number, what


def tracked(root: Path) -> list[Path]:
    """Files that version control knows, relative to the root."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=root, capture_output=True, text=True, check=True
    )
    return [Path(name) for name in listed.stdout.split("\0") if name and (root / name).is_file()]


def leaks(root: Path, files: Sequence[Path]) -> list[str]:
    """One line per finding that is not known; binary files are read as their bytes."""
    lines = []
    for path in files:
        raw = (root / path).read_bytes()
        text = raw.decode("latin-1" if b"\0" in raw else "utf-8", errors="replace")
        for number, what in found(text):
            if (path.as_posix(), what) not in KNOWN:
                lines.append(f"{path.as_posix()}:{number}: {what}")
    return lines


def unused(root: Path) -> list[str]:
    """Entries of `KNOWN` that nothing matches any more."""
    held = {
        (name, what)
        for name, _ in KNOWN
        if (root / name).is_file()
        for _, what in found((root / name).read_text(encoding="utf-8"))
    }
    return [f"{name}: {what}" for name, what in KNOWN if (name, what) not in held]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print what is found; 1 if there is anything."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path, help="all tracked files without any")
    chosen = parser.parse_args(arguments)
    lines = leaks(ROOT, chosen.files or tracked(ROOT))
    print("\n".join(lines) if lines else "no secret, path of a machine or registry in any file")
    return int(bool(lines))


if __name__ == "__main__":
    sys.exit(main())
