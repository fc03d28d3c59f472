"""The XML of a URDF file."""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path
from xml.etree.ElementTree import Element, ParseError, TreeBuilder, XMLParser

from ...errors import DataFileError
from ...input_files import contents

#: Largest file [bytes].
LARGEST_FILE = 50_000_000
#: Deepest nesting of elements; what copies and writes them goes down by recursion.
DEEPEST = 100
_XACRO = "{http://www.ros.org/wiki/xacro}"


class _Declared(ValueError):
    """The text declares a document type, with which entities can grow without bound."""


class _Deep(ValueError):
    """Elements are nested deeper than in any robot."""


class _Builder(TreeBuilder):
    _depth = 0

    def start(self, tag: str, attrs: dict[str, str]) -> Element:
        """Count the nesting."""
        self._depth += 1
        if self._depth > DEEPEST:
            raise _Deep(tag)
        return super().start(tag, attrs)

    def end(self, tag: str) -> Element:
        """Count the nesting."""
        self._depth -= 1
        return super().end(tag)

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        """Refuse it before any entity is declared."""
        raise _Declared(name)


def read(path: Path) -> Element:
    """The element ``robot`` of a file.

    Raises
    ------
    DataFileError
        Missing, broken, too large or too deep file, a document type, another root, macros that are
        not expanded.
    """
    written = contents(path, "a readable URDF file", LARGEST_FILE)
    parser = XMLParser(target=_Builder())
    try:
        parser.feed(written)
        root: Element = parser.close()
    except _Declared as error:
        raise DataFileError(path, "DOCTYPE", str(error), "a URDF without document type") from None
    except _Deep as error:
        expected = f"at most {DEEPEST} elements inside each other"
        raise DataFileError(path, "element", str(error), expected) from None
    except (ParseError, UnicodeDecodeError, LookupError, ValueError) as error:
        raise DataFileError(path, "file", str(error), "well-formed XML") from None
    if root.tag != "robot":
        raise DataFileError(path, "root element", root.tag, "robot")
    for element in root.iter():
        if isinstance(element.tag, str) and element.tag.startswith(_XACRO):
            tag = f"xacro:{element.tag.removeprefix(_XACRO)}"
            raise DataFileError(path, "element", tag, "a URDF: expand the macros with xacro first")
    return root


def children(root: Element, tag: str) -> dict[str, Element]:
    """The links or joints of a robot by name."""
    return {one.get("name", ""): one for one in root.findall(tag)}


def aliases(root: Element) -> dict[str, str]:
    """Other names for the links that are named like a joint, which Pinocchio cannot tell apart."""
    links, joints = children(root, "link"), children(root, "joint")
    found: dict[str, str] = {}
    for name in links:
        if name in joints:
            alias = f"{name}_link"
            while alias in links or alias in joints or alias in found.values():
                alias += "_"
            found[name] = alias
    return found


def renamed(root: Element, names: dict[str, str]) -> Element:
    """The robot with links of other names."""
    if not names:
        return root
    made = deepcopy(root)
    places = [(one, "name") for one in made.findall("link")]
    for joint in made.findall("joint"):
        places += [(one, "link") for tag in ("parent", "child") for one in joint.findall(tag)]
    for element, attribute in places:
        name = element.get(attribute, "")
        element.set(attribute, names.get(name, name))
    return made
