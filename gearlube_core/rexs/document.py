"""Writing REXS files: components, attributes with units, relations."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from lxml import etree

from gearlube_core import __version__
from gearlube_core.storage.atomic_file import atomic_write

_VERSION = "1.4"
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"  # [fva_2022] wants it


class Document:
    """A REXS model that grows: a gear unit, one stage, two gears on shafts.

    References
    ----------
    [fva_2022]: file format, and relations that a stage needs.
    """

    def __init__(self) -> None:
        self.root = etree.Element(
            "model",
            version=_VERSION,
            applicationId="gearlube",
            applicationVersion=__version__,
            date=datetime.now().astimezone().isoformat(timespec="seconds"),
            applicationLanguage="en",
        )
        self.relations = etree.SubElement(self.root, "relations")
        self.components = etree.SubElement(self.root, "components")
        self.unit = self.component("gear_unit", "")

    def component(self, kind: str, name: str) -> etree._Element:
        """Add a component and return it."""
        number = str(len(self.components) + 1)
        element = etree.SubElement(self.components, "component", id=number, type=kind)
        if name:
            element.set("name", name)
        return element

    def value(self, component: etree._Element, name: str, unit: str, value: float | str) -> None:
        """Add an attribute; numbers keep 12 digits."""
        element = etree.SubElement(component, "attribute", id=name, unit=unit)
        element.text = value if isinstance(value, str) else f"{value:.12g}"

    def relation(self, kind: str, **roles: etree._Element) -> None:
        """Add a relation between components in their roles."""
        number = str(len(self.relations) + 1)
        relation = etree.SubElement(self.relations, "relation", id=number, type=kind)
        for role, one in roles.items():
            etree.SubElement(relation, "ref", id=one.get("id"), role=role, hint=one.get("type"))

    def stage(self, stage: etree._Element, *gears: etree._Element) -> None:
        """Put a stage of two gears into the gear unit, each gear on a shaft without sections."""
        self.relation("assembly", assembly=self.unit, part=stage)
        self.relation("stage", stage=stage, gear_1=gears[0], gear_2=gears[1])
        for gear in gears:
            shaft = self.component("shaft", f"shaft of {gear.get('name')}")
            self.relation("assembly", assembly=self.unit, part=shaft)
            self.relation("assembly", assembly=shaft, part=gear)

    def flanks(self, gear: etree._Element, left: etree._Element, right: etree._Element) -> None:
        """Give a gear its flanks."""
        self.relation("flank", gear=gear, left=left, right=right)

    def text(self) -> str:
        """Return the file as text; its heading says UTF-8."""
        etree.indent(self.root)
        text = etree.tostring(self.root, xml_declaration=True, encoding="UTF-8")
        return f"{text.decode('utf-8')}\n"

    def write(self, path: Path) -> None:
        """Write the file, in UTF-8."""
        with atomic_write(path) as partial:
            partial.write_bytes(_BYTE_ORDER_MARK + self.text().encode("utf-8"))
