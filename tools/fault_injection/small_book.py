"""Execute a book of three pages below the working folder as `make book` does, and write what they
give."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from notebook_cache import open_cache
from prerun import isolate_kernels, prerun

from dualarm_repro.ledger.files import to_json, write_text

TOC = "format: jb-book\nroot: sum\nchapters:\n  - file: product\n  - file: arm\n"
PAGES = {
    "sum": "print(6 + 7)",
    "product": "6 * 7",
    "arm": 'from dualarm_repro import load_arm\n\nload_arm("irb120").fk([0.1] * 6).round(6)',
}
PAGE = "---\nfile_format: mystnb\n---\n\n# Page\n\n```{{code-cell}} ipython3\n{code}\n```\n"


def main() -> int:
    """Execute the pages; 1 if one failed."""
    book, build = Path("book").resolve(), Path("_build").resolve()
    write_text(book / "_toc.yml", TOC)
    for name, code in PAGES.items():
        write_text(book / f"{name}.md", PAGE.format(code=code))
    isolate_kernels(build / ".ipython")
    if failed := prerun(book, build / ".jupyter_cache", timeout=900):
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
        return 1
    cache = open_cache(build / ".jupyter_cache")
    made = {
        Path(entry.uri).stem: [
            [output.get("text", output.get("data")) for output in cell.get("outputs", [])]
            for cell in cache.get_cache_bundle(entry.pk).nb.cells
        ]
        for entry in cache.list_cache_records()
    }
    write_text(Path("out") / "outputs.json", to_json(dict(sorted(made.items()))))
    return 0


if __name__ == "__main__":
    sys.exit(main())
