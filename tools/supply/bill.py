"""Bill of materials in CycloneDX: every locked distribution, its licence, and who asks for it."""

from __future__ import annotations

import hashlib
import uuid
from pathlib import Path

from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model import Property
from cyclonedx.model.bom import Bom
from cyclonedx.model.bom_ref import BomRef
from cyclonedx.model.component import Component, ComponentScope, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
from packageurl import PackageURL

from .licences import read as read_licences
from .locks import LOCKS, PROJECT, Pinned, plain, reached, read_all

BILL = Path("data") / "sbom.cdx.json"
_NAMESPACE = uuid.UUID("6ba7b812-9dad-11d1-80b4-00c04fd430c8")


def bill(root: Path, project: dict[str, object]) -> str:
    """Text of the bill: the same bytes for the same locks, licences and project table.

    Its components are `required` if the plain package brings them in and `optional` otherwise; the
    locks, with the hashes of every file, are named by their own hashes.

    Raises
    ------
    ValueError
        What was made does not satisfy the schema of CycloneDX.
    """
    locks, licences = read_all(root), read_licences(root)
    every: dict[tuple[str, str], Pinned] = {}
    listed: dict[tuple[str, str], list[str]] = {}
    for lock, pinned in locks.items():
        for one in pinned:
            every.setdefault((one.name, one.version), one)
            listed.setdefault((one.name, one.version), []).append(lock)
    needed = reached(locks[LOCKS[0]], project["dependencies"])  # type: ignore[arg-type]
    factory = LicenseFactory()
    components = {}
    for (name, version), one in sorted(every.items()):
        properties = [Property(name="lock", value=lock) for lock in listed[name, version]]
        if one.marker:
            properties.append(Property(name="marker", value=one.marker))
        components[name, version] = Component(
            name=name,
            version=version,
            type=ComponentType.LIBRARY,
            bom_ref=f"{name}@{version}",
            purl=PackageURL("pypi", name=name, version=version),
            licenses=[factory.make_from_string(licences[name][0])],
            scope=ComponentScope.REQUIRED if name in needed else ComponentScope.OPTIONAL,
            properties=properties,
        )
    hashes = {name: hashlib.sha256((root / name).read_bytes()).hexdigest() for name in LOCKS}
    made = Bom(components=components.values(), version=1)
    made.serial_number = uuid.uuid5(_NAMESPACE, " ".join(hashes.values()))
    made.metadata.timestamp = None  # type: ignore[assignment]  # a clock would change the bytes
    made.metadata.properties = [
        Property(name=f"sha256 of {name}", value=value) for name, value in hashes.items()
    ]
    made.metadata.component = root_component = Component(
        name=PROJECT,
        version=str(project["version"]),
        type=ComponentType.LIBRARY,
        bom_ref=BomRef(PROJECT),
        licenses=[factory.make_from_string(str(project["license"]))],
    )
    children: dict[str, list[Component]] = {}
    for key, component in components.items():
        for parent in every[key].via:
            children.setdefault(plain(parent), []).append(component)
    made.register_dependency(root_component, children.get(PROJECT, ()))
    for (name, _), component in components.items():
        made.register_dependency(component, children.get(name, ()))
    text = JsonV1Dot6(made).output_as_string(indent=1) + "\n"
    if wrong := JsonStrictValidator(SchemaVersion.V1_6).validate_str(text):
        raise ValueError(f"the bill of materials is not valid: {wrong}")
    return text
