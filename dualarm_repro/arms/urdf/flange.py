"""Which frame of a URDF is the flange when nobody says so: the last one before a gripper."""

from __future__ import annotations

import re
from collections.abc import Collection
from xml.etree.ElementTree import Element

from .document import children
from .joints import Joints

_FINGER = re.compile(r"finger|thumb|jaw|knuckle|claw", re.IGNORECASE)
_GRIPPER = re.compile(rf"grip|hand|palm|{_FINGER.pattern}", re.IGNORECASE)
_LONGEST_FINGER = 4  # moving joints of a finger


def default_flange(root: Element, joints: Joints) -> str:
    """The last link of the chain with the most joints, without the joints and links of a gripper.

    A joint belongs to a gripper if it is named like a part of one or carries a finger by name,
    follows another joint, or is on one of several short branches (up to four joints) that start at
    the end of a longer chain. Links that only grippers carry are left out as well, unless nothing
    remains.
    """
    tree = _Tree(root, joints)
    gripper = {
        name
        for name in tree.moving
        if name in joints.gears or _GRIPPER.search(name) or _FINGER.search(tree.child[name])
    }
    gripper |= tree.fingers(gripper)
    if not set(tree.moving) - gripper:
        gripper = set()
    best = max(tree.links, key=lambda link: tree.depth(link, gripper))
    last = tree.last_moving(best, gripper)
    carried = [
        link
        for link in tree.links
        if tree.last_moving(link, gripper) == last and not tree.beyond(link, gripper)
    ]
    bare = [link for link in carried if not tree.named_like_a_gripper(link, last)]
    return (bare or carried)[-1]


class _Tree:
    """Links in the order from the base outwards, with the joints that lead to them."""

    def __init__(self, root: Element, joints: Joints) -> None:
        self.child: dict[str, str] = {}
        self._up: dict[str, tuple[str, str]] = {}
        below: dict[str, list[str]] = {}
        for name, joint in children(root, "joint").items():
            ends = [joint.find("parent"), joint.find("child")]
            parent, child = (e.get("link", "") if e is not None else "" for e in ends)
            self.child[name] = child
            self._up[child] = (name, parent)
            below.setdefault(parent, []).append(child)
        self.moving = [name for name in self.child if name in joints.types]
        self.links: list[str] = []
        waiting = [name for name in children(root, "link") if name not in self._up]
        while waiting:
            link = waiting.pop()
            self.links.append(link)
            waiting += sorted(below.get(link, []), reverse=True)

    def way(self, link: str) -> list[str]:
        """Moving joints from the base to a link."""
        found: list[str] = []
        while link in self._up:
            joint, link = self._up[link]
            if joint in self.moving:
                found.append(joint)
        return found[::-1]

    def depth(self, link: str, without: Collection[str]) -> int:
        """Moving joints to a link; none if one of them is left out."""
        way = self.way(link)
        return 0 if any(joint in without for joint in way) else len(way)

    def beyond(self, link: str, gripper: Collection[str]) -> bool:
        """Whether a joint of a gripper leads to a link."""
        return any(joint in gripper for joint in self.way(link))

    def last_moving(self, link: str, without: Collection[str]) -> str | None:
        """The last joint on the way to a link that is not left out."""
        kept = [joint for joint in self.way(link) if joint not in without]
        return kept[-1] if kept else None

    def named_like_a_gripper(self, link: str, last: str | None) -> bool:
        """Whether a link, or one between it and the last joint, is named like part of a gripper."""
        while link in self._up and self._up[link][0] != last:
            if _GRIPPER.search(link):
                return True
            link = self._up[link][1]
        return False

    def fingers(self, known: Collection[str]) -> set[str]:
        """Joints of short branches that start side by side at the end of a longer chain."""
        ways = [[j for j in self.way(link) if j not in known] for link in self.links]
        ends = [way for way in ways if way]
        found: set[str] = set()
        for trunk in {tuple(way[:k]) for way in ends for k in range(4, len(way))}:
            rest = [way[len(trunk) :] for way in ends if tuple(way[: len(trunk)]) == trunk]
            branches = {way[0] for way in rest if way}
            longest = max(len(way) for way in rest)
            if len(branches) > 1 and longest <= _LONGEST_FINGER and longest < len(trunk):
                found |= {joint for way in rest for joint in way}
        return found
