"""The links of a URDF hang on one root: every other link has exactly one parent joint."""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element

from ...errors import DataFileError
from .document import children


def check_tree(path: Path, root: Element) -> None:
    """Check that joints join links of the file, and that these form one tree.

    Raises
    ------
    DataFileError
        A joint without parent or child, or to a link that the file does not have; a link with two
        parents; a loop of joints; several links that no joint leads to.
    """
    links, above = children(root, "link"), dict[str, tuple[str, str]]()
    for number, joint in enumerate(root.findall("joint")):
        name = joint.get("name") or f"number {number}"
        ends = []
        for tag in ("parent", "child"):
            end = joint.find(tag)
            link = "nothing" if end is None else end.get("link", "nothing")
            if link not in links:
                expected = "a link of the file"
                raise DataFileError(path, f"{tag} of joint {name}", link, expected)
            ends.append(link)
        parent, child = ends
        if child in above:
            both = f"{above[child][0]} and {name}"
            expected = "one: a loop of joints is no tree; leave one of them out"
            raise DataFileError(path, f"parent joints of link {child}", both, expected)
        above[child] = name, parent
    for link in links:
        _refuse_loop(path, link, above)
    if len(roots := [link for link in links if link not in above]) > 1:
        expected = "one: a joint leads to every other link"
        raise DataFileError(path, "links without parent joint", roots, expected)


def _refuse_loop(path: Path, link: str, above: dict[str, tuple[str, str]]) -> None:
    way: dict[str, str] = {}
    while link in above:
        joint, parent = above[link]
        if link in way:
            expected = "joints that lead away from one root, not in a loop"
            raise DataFileError(path, "joints", list(way.values()), expected)
        way[link], link = joint, parent
