"""Sphinx extension: a rebuild reads and writes only the pages that a change can reach.

Sphinx sees that the text of a page has changed. It does not see that the cells of a page compute
something else now (``tools/prerun.py`` keeps a key for each page), that an extension or the lock of
the environment is another one (then nothing that was built before is kept, so that no page of what
no longer exists remains), nor that a page shows the title, a label or an entry of the contents
of a page that changed. After a build that did not succeed, everything is read again, so that its
warnings come again.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path
from shutil import rmtree
from typing import Any

from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

from dualarm_repro.ledger.closure import hash_file

#: Beside the pages that Sphinx has read: what the last successful build knew.
_KEPT = "changed_pages.json"


class ChangedPages:
    """What the last build knew, what this one knows, and the pages between.

    Attributes
    ----------
    keys
        File that holds the key of every executed page.
    common
        Files on which all pages depend, and folders of such files.
    library
        Folder of the library, whose modules are listed in the reference.
    """

    def __init__(self, keys: Path, common: Iterable[Path], library: Path) -> None:
        self.keys, self.common, self.library = keys, list(common), library
        self.before: dict[str, Any] = {}
        self.now: dict[str, Any] = {}

    def begin(self, app: Sphinx) -> None:
        """Take what the last successful build knew, and keep nothing until this one succeeds.

        Where what concerns all pages has changed, nothing that was built is kept either.
        """
        kept = Path(app.doctreedir, _KEPT)
        try:
            self.before = json.loads(kept.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            self.before = {}
        kept.unlink(missing_ok=True)
        self.now = {"common": self._common_digest(), "pages": self._page_keys(app)}
        if self.before.get("common") != self.now["common"]:
            rmtree(app.outdir, ignore_errors=True)
            Path(app.outdir).mkdir(parents=True)

    def outdated(self, app: Sphinx, env: BuildEnvironment, *others: set[str]) -> set[str]:
        """Names of the pages to read again beside those whose text has changed.

        The root is always one of them: Sphinx makes no pages of items where nothing is outdated.
        """
        before, now = self.before.get("pages"), self.now["pages"]
        if not before or not now or self.before["common"] != self.now["common"]:
            return set(env.found_docs)
        changed = {name for name in env.found_docs if before.get(name) != now.get(name)}
        return changed | {app.config.root_doc}

    def touched(self, app: Sphinx, env: BuildEnvironment) -> set[str]:
        """Names of all pages if one of them now tells another page something else."""
        self.now["told"] = _told(env)
        return set() if self.before.get("told") == self.now["told"] else set(env.all_docs)

    def restore(self, app: Sphinx, env: BuildEnvironment) -> None:
        """Give the search the index entries of pages not written again, which it forgets."""
        for name, entries in self.before.get("entries", {}).items():
            env._search_index_index_entries.setdefault(name, entries)

    def finish(self, app: Sphinx, failure: Exception | None) -> None:
        """Keep what this build knew if it succeeded."""
        if failure is None and not app._warncount:
            self.now["entries"] = app.env._search_index_index_entries
            Path(app.doctreedir, _KEPT).write_text(json.dumps(self.now), encoding="utf-8")

    def _common_digest(self) -> str:
        paths = (path.rglob("*.py") if path.is_dir() else [path] for path in self.common)
        found = sorted(path for several in paths for path in several)
        modules = sorted(str(p.relative_to(self.library)) for p in self.library.rglob("*.py"))
        return _digest([modules, *([path.name, hash_file(path)] for path in found)])

    def _page_keys(self, app: Sphinx) -> dict[str, str]:
        try:
            keys = json.loads(self.keys.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}  # nothing was executed, or not by the tool that keeps keys
        return {app.env.path2doc(path) or path: key for path, key in keys.items()}


def _told(env: BuildEnvironment) -> str:
    """Digest of what pages tell one another: contents, titles, labels and documented objects."""
    titles = {name: title.astext() for name, title in env.titles.items()}
    contents = {name: tree.astext() for name, tree in env.tocs.items()}
    labels = env.get_domain("std").data.get("labels", {})
    objects = {name: entry[:2] for name, entry in env.get_domain("py").data["objects"].items()}
    return _digest([titles, contents, env.toctree_includes, labels, objects])


def _digest(value: Any) -> str:
    return sha256(json.dumps(value, sort_keys=True, default=str).encode()).hexdigest()


def connect(app: Sphinx, pages: ChangedPages) -> None:
    """Let Sphinx ask what is outdated."""
    app.connect("builder-inited", pages.begin, priority=100)  # before others write there
    app.connect("env-get-outdated", pages.outdated)
    app.connect("env-updated", pages.touched)
    app.connect("env-updated", pages.restore)
    app.connect("build-finished", pages.finish)


def setup(app: Sphinx) -> dict[str, Any]:
    """Entry point of Sphinx."""
    root = Path(__file__).resolve().parents[2]
    items = root / "data" / "papers" / "inventory.csv"
    common = [Path(__file__).parent, root / "requirements.lock", items]
    pages = ChangedPages(
        root / "_build" / ".jupyter_cache" / "pages.json", common, root / "dualarm_repro"
    )
    connect(app, pages)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
