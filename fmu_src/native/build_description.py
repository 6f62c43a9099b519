"""buildDescription.xml of FMI 3.0: how the C sources become a library."""

from __future__ import annotations

from xml.etree import ElementTree

from fmu_src.model_description import xml_bytes
from fmu_src.native.sources import PLUMBING


def build_description(name: str) -> bytes:
    """Return buildDescription.xml.

    Parameters
    ----------
    name : str
        Model identifier.
    """
    root = ElementTree.Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = ElementTree.SubElement(
        root,
        "BuildConfiguration",
        modelIdentifier=name,
        description="FMI functions; the physics is an object file that `gearlube build-fmu` makes "
        "of the kernels, with the symbol gearlube_entry",
    )
    files = ElementTree.SubElement(
        configuration, "SourceFileSet", language="C99", compilerOptions="-ffp-contract=off"
    )
    names = [path.name for path in PLUMBING.glob("*.c")] + ["model_tables.c"]
    for file in sorted(names):
        ElementTree.SubElement(files, "SourceFile", name=file)
    ElementTree.SubElement(
        configuration, "Library", name="kernels", external="false", description="gearlube_entry"
    )
    return xml_bytes(root)
