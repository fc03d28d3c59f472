"""What an item is in the vocabulary of schema.org: a review of a claim, and a data set.

Addresses are relative, since the book can stand anywhere. A verdict is a word on no scale, so the
rating carries it as its name and gives no number.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from markupsafe import Markup

from ..ledger.meaning import MEANING
from ..ledger.project import Project
from ..ledger.schema import Document
from ..ledger.verdict import Verdict
from .item_files import address
from .wording import obtained_line, printed_line, verdict_line

_MEDIA = {"json": "application/json", "csv": "text/csv", "svg": "image/svg+xml",
          "png": "image/png", "scene.html": "text/html"}  # fmt: skip
_LICENCE = "https://spdx.org/licenses/{}"


def structured_data(
    made: Mapping[str, Any],
    document: Document,
    project: Project,
    files: Sequence[tuple[str, str]] = (),
) -> dict[str, Any]:
    """JSON-LD of an item.

    Parameters
    ----------
    files
        Kind and address of each of its files.
    """
    return {
        "@context": "https://schema.org",
        "@graph": [_review(made, document, project), _dataset(made, document, project, files)],
    }


def script(data: Mapping[str, Any]) -> Markup:
    """The element that carries JSON-LD in the head of a page."""
    text = json.dumps(data, ensure_ascii=False, indent=1).replace("</", "<\\/")
    return Markup(f'<script type="application/ld+json">{text}</script>')


def _review(made: Mapping[str, Any], document: Document, project: Project) -> dict[str, Any]:
    verdict = Verdict(made["verdict"])
    return {
        "@type": "ClaimReview",
        "url": address(made["id"]),
        "name": f"{made['id']}: {made['title']}",
        "claimReviewed": f"{made['title']}: {printed_line(made)}",
        "reviewBody": f"Obtained: {obtained_line(made)}. Verdict: {verdict_line(made)}.",
        "author": _maker(project),
        "datePublished": project.year,
        "itemReviewed": {
            "@type": "Claim",
            "name": made["title"],
            "appearance": _article(document),
        },
        "reviewRating": {
            "@type": "Rating",
            "alternateName": str(verdict),
            "ratingExplanation": MEANING[verdict],
        },
    }


def _dataset(
    made: Mapping[str, Any],
    document: Document,
    project: Project,
    files: Sequence[tuple[str, str]],
) -> dict[str, Any]:
    return {
        "@type": "Dataset",
        "url": address(made["id"]),
        "identifier": made["id"],
        "name": f"{made['id']}: {made['title']}",
        "description": (
            f"What is printed, what was recomputed and the verdict on {made['kind']} "
            f"{made['id'].partition('.')[2]} of “{document.title}”. {made['caption'] or ''}"
        ).strip(),
        "creator": _maker(project),
        "version": project.version,
        "license": _LICENCE.format(project.text_licence),
        "isBasedOn": _article(document),
        "isPartOf": {"@type": "Dataset", "name": f"The ledger of {project.name}"},
        "distribution": [
            {
                "@type": "DataDownload",
                "encodingFormat": _MEDIA[kind],
                "contentUrl": where.removeprefix("../"),
            }
            for kind, where in files
        ],
    }


def _article(document: Document) -> dict[str, Any]:
    kinds = {"article": "ScholarlyArticle", "inproceedings": "ScholarlyArticle"}
    found = {
        "@type": kinds.get(document.type, "CreativeWork"),
        "name": document.title,
        "alternateName": document.title_original,
        "author": [{"@type": "Person", "name": name} for name in document.authors],
        "datePublished": document.year,
        "isPartOf": document.journal and {"@type": "Periodical", "name": document.journal},
        "inLanguage": document.language,
    }
    return {key: value for key, value in found.items() if value}


def _maker(project: Project) -> list[dict[str, str]]:
    return [{"@type": "Organization", "name": name} for name in project.authors]
