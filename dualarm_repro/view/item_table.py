"""Items of the ledger as rows of one table: id, kind, verdict, what it is and why."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import Any

from ..ledger import Registry, record
from .badge import badge

_HEAD = "<tr><th>id</th><th>kind</th><th>verdict</th><th>item</th></tr>"


def item_table(registry: Registry, item_ids: Iterable[str], root: str = "") -> str:
    """HTML table of items; an id links to the page that shows the item.

    Parameters
    ----------
    root
        Way from the page with the table up to the top of the book, e.g. ``"../"``.
    """
    rows = "".join(_row(record(registry, item_id), root) for item_id in item_ids)
    return (
        '<div class="ledger-scroll"><table class="ledger-items">'
        f"<thead>{_HEAD}</thead><tbody>{rows}</tbody></table></div>"
    )


def _row(made: dict[str, Any], root: str) -> str:
    item_id = made["id"]
    code = f"<code>{item_id}</code>"
    name = f'<a href="{root}{made["url"]}">{code}</a>' if made["url"] else code
    why = made["pending"] or made["caption"] or ""
    return (
        f'<tr data-paper="{made["paper"]}" data-kind="{made["kind"]}" '
        f'data-verdict="{made["verdict"]}"><td>{name}</td><td>{made["kind"]}</td>'
        f"<td>{badge(made['verdict'], made['robustness'])}</td><td><b>{escape(made['title'])}</b> "
        f"({escape(made['place'])})<br>{escape(why)}</td></tr>"
    )
