"""Write what archives read of the project, from pyproject.toml, data/papers and the headlines.

CITATION.cff, codemeta.json, .zenodo.json, ro-crate-metadata.json and repro.yaml in the root are
never edited by hand: ``make metadata`` writes them, and a test compares them with what this gives.
"""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

from dualarm_repro.ledger.claims import reference_manifest
from dualarm_repro.ledger.crate import NAME, Part, crate
from dualarm_repro.ledger.descriptions import citation_cff, codemeta, zenodo
from dualarm_repro.ledger.files import write_text
from dualarm_repro.ledger.project import Project, from_table
from dualarm_repro.ledger.schema import Document, load_paper

ROOT = Path(__file__).resolve().parents[1]
_FILES = {
    "README.md": "What the project is and how to run it",
    "CHANGELOG.md": "What changed",
    "CONTRIBUTING.md": "How to add an item, an arm or a document",
    "LICENSE": "Licences of code, text and figures",
    "CITATION.cff": "How to cite the project",
    "codemeta.json": "The project in the CodeMeta vocabulary",
    "repro.yaml": "Numbers of the book, for `claims verify` to look up in data/results",
    "pyproject.toml": "Name, version, licence and dependencies",
    "requirements.lock": "Every dependency with its hashes",
    "SECURITY.md": "What is trusted input, and what is promised",
    "data/licences.csv": "Licences of everything that the locks install",
    "data/sbom.cdx.json": "Bill of materials of the locks, CycloneDX",
    "data/headlines.yaml": "Which numbers repro.yaml states",
    "data/results/benchmarks.json": "Times beside other libraries, one run on one machine",
    "data/papers/inventory.csv": "Every figure, table, equation and claim that must be handled",
}
_CODE = {"pyproject.toml", "requirements.lock"}
#: Folder and pattern, with what each file of it is.
_FOLDERS = {
    ("data/papers", "*.yaml"): "Items, assumptions and errata of document {}",
    ("data/robots", "*.yaml"): "Geometry and limits of robot {}, each number with its source",
    ("data/scenes", "*.yaml"): "Scene or task {}",
    ("data/benchmarks", "*.json"): "Public planning problems: {}",
    ("data/results", "*.json"): "Reference results or settings of a stored study: {}",
    ("data/results", "*.parquet"): "Cells of the stored study {}",
    ("data/results/robustness", "*.json"): "Settings of the draws behind the verdict on {}",
    ("data/results/robustness", "*.parquet"): "Draws behind the verdict on {}",
}
#: Files of those folders that are something else.
_ALONE = {
    "data/results/install_matrix.json": "Where the wheel was installed and used, and how it ended",
}


def project() -> Project:
    """The project as pyproject.toml describes it."""
    text = ROOT.joinpath("pyproject.toml").read_text(encoding="utf-8")
    return from_table(tomllib.loads(text)["project"])


def documents() -> list[Document]:
    """The bibliographic records of the documents, in the order of the listings."""
    found = [load_paper(path).document for path in ROOT.joinpath("data/papers").glob("*.yaml")]
    return sorted(found, key=lambda document: (document.order, document.id))


def parts() -> dict[str, Part]:
    """Every file the crate of the project describes."""
    found = {name: Part(text, name in _CODE) for name, text in _FILES.items()}
    for (folder, pattern), text in _FOLDERS.items():
        for path in ROOT.joinpath(folder).glob(pattern):
            name = f"{folder}/{path.name}"
            found.setdefault(name, Part(_ALONE.get(name, text.format(path.stem))))
    return found


def written() -> dict[str, str]:
    """Name of each file in the root, with its text."""
    made_by, cited = project(), documents()
    return {
        "CITATION.cff": citation_cff(made_by, cited),
        "codemeta.json": codemeta(made_by, cited),
        ".zenodo.json": zenodo(made_by, cited),
        NAME: crate(made_by, cited, parts()),
        "repro.yaml": reference_manifest(),
    }


def main() -> int:
    """Write every file."""
    for name, text in written().items():
        write_text(ROOT / name, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
