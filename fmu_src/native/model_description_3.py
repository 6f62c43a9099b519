"""modelDescription.xml and terminals of FMI 3.0, written from the table of variables."""

from __future__ import annotations

from xml.etree import ElementTree

from fmu_src.definition import MAP, Definition
from fmu_src.model_description import (
    attributes_of,
    dependencies_of,
    description_root,
    named_attributes,
    number_text,
    write_default_experiment,
    write_log_categories,
    write_types,
    write_units,
    xml_bytes,
)
from fmu_src.native.model import Exchange
from fmu_src.native.sources import ArrayVariable, array_variables
from fmu_src.variable import Variable

_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
_MEMBERS = ("torque", "speed", "angle")
STRUCT = "extra/org.fmi-standard.fmi-ls-struct/fmi-ls-manifest.xml"
_LS_MANIFEST = "http://fmi-standard.org/fmi-ls-manifest"
ElementTree.register_namespace("fmi-ls", _LS_MANIFEST)
ICON = "terminalsAndIcons/icon.png"
_ICON_SIZE = 100.0  # of the drawing in its own units


def _variable(
    parent: ElementTree.Element, array: ArrayVariable, definition: Definition, state: int | None
) -> None:
    variable: Variable = array.variable
    attributes = named_attributes(variable, array.references[0])
    if state is not None:
        attributes["derivative"] = str(state)
    attributes |= attributes_of(variable)
    n = len(array.references)
    if n > 1 and variable.start is not None:
        members = (definition.variables[one] for one in array.references)
        attributes["start"] = " ".join(number_text(one.start or 0.0) for one in members)
    element = ElementTree.SubElement(parent, _TYPES[variable.type], attributes)
    of_map = (variable.name, f"{MAP}.codomain") in definition.map_members
    for length in definition.map_shape if of_map else (n,) * (n > 1):
        ElementTree.SubElement(element, "Dimension", start=str(length))


def _structure(
    root: ElementTree.Element, definition: Definition, exchange: Exchange | None
) -> None:
    arrays = array_variables(definition.variables)
    first = {reference: one.references[0] for one in arrays for reference in one.references}
    known = [one.references[0] for one in arrays if not one.variable.is_computed]
    outputs = [one.references[0] for one in arrays if one.variable.causality == "output"]
    sections = [("Output", dependencies_of(outputs, definition, exchange))]
    if exchange:
        references = definition.references
        rates = [references[name] for name in exchange.rates(definition)]
        states = [references[name] for name in exchange.states]
        sections.append(("ContinuousStateDerivative", dependencies_of(rates, definition, exchange)))
        outputs = sorted({*outputs, *rates, *states})
    sections.append(("InitialUnknown", dict.fromkeys(outputs, known)))
    if exchange:
        indicators = [definition.references[name] for name in exchange.indicators]
        sections.append(("EventIndicator", dependencies_of(indicators, definition, exchange)))
    parent = ElementTree.SubElement(root, "ModelStructure")
    for kind, unknowns in sections:
        for reference, dependencies in unknowns.items():
            ElementTree.SubElement(
                parent,
                kind,
                valueReference=str(reference),
                dependencies=" ".join(str(first[one]) for one in dependencies),
            )


def model_description_3(
    definition: Definition, token: str, exchange: Exchange | None = None
) -> bytes:
    """Return modelDescription.xml of FMI 3.0.

    Parameters
    ----------
    definition : Definition
        The FMU.
    token : str
        Instantiation token: identifier of its content.
    exchange : Exchange, optional
        Of an FMU that is for model exchange too.
    """
    root = description_root("3.0", definition, "instantiationToken", token, "")
    common = {
        "modelIdentifier": definition.name,
        "needsExecutionTool": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canGetAndSetFMUState": "true",
        "canSerializeFMUState": "true",
    }
    if exchange:
        ElementTree.SubElement(
            root,
            "ModelExchange",
            {
                **common,
                "providesDirectionalDerivatives": "true",
                "providesAdjointDerivatives": "true",
                "needsCompletedIntegratorStep": "true",
            },
        )
    ElementTree.SubElement(
        root, "CoSimulation", {**common, "canHandleVariableCommunicationStepSize": "true"}
    )
    write_units(root, definition)
    write_types(root, definition, "EnumerationType")
    write_log_categories(root)
    write_default_experiment(root, definition)
    parent = ElementTree.SubElement(root, "ModelVariables")
    ElementTree.SubElement(
        parent,
        "Float64",
        name="time",
        valueReference=str(len(definition.variables)),
        causality="independent",
        variability="continuous",
        description="Simulation time [s]",
    )
    for array in array_variables(definition.variables):
        state = array.variable.rate_of if exchange else ""
        of_rate = definition.references[state] if state else None
        _variable(parent, array, definition, of_rate)
    _structure(root, definition, exchange)
    return xml_bytes(root)


def terminals(definition: Definition) -> bytes:
    """Return terminalsAndIcons.xml: the flanges or the sampled map, and the icon."""
    root = ElementTree.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    box = {"x1": "0", "y1": "0", "x2": str(_ICON_SIZE), "y2": str(_ICON_SIZE)}
    graphics = ElementTree.SubElement(root, "GraphicalRepresentation")
    scale = {"suggestedScalingFactorTo_mm": "0.2"}
    ElementTree.SubElement(graphics, "CoordinateSystem", box | scale)
    ElementTree.SubElement(graphics, "Icon", box)
    parent = ElementTree.SubElement(root, "Terminals")
    for name, (words, *variables) in definition.flanges.items():
        terminal = ElementTree.SubElement(
            parent,
            "Terminal",
            name=name,
            matchingRule="plug",
            terminalKind="rotational flange",
            description=f"{words}: torque in, speed and angle out",
        )
        for member, variable in zip(_MEMBERS, variables, strict=True):
            ElementTree.SubElement(
                terminal,
                "TerminalMemberVariable",
                variableName=variable,
                memberName=member,
                variableKind="signal",
            )
    if definition.map_members:
        terminal = ElementTree.SubElement(
            parent,
            "Terminal",
            name="map",
            matchingRule=MAP,
            terminalKind=f"{MAP}.rectilinearGrid",
            description="Points of the map, and its value at the inputs",
        )
        for variable, kind in definition.map_members:
            ElementTree.SubElement(
                terminal,
                "TerminalMemberVariable",
                variableName=variable,
                memberName=variable,
                variableKind=kind,
            )
    return xml_bytes(root)


def manifest_root(tag: str, name: str, release: str, words: str) -> ElementTree.Element:
    """Return the root of the manifest of a layered standard."""
    root = ElementTree.Element(tag)
    for key, text in (("name", name), ("version", release), ("description", words)):
        root.set(f"{{{_LS_MANIFEST}}}fmi-ls-{key}", text)
    return root


def struct_manifest() -> bytes:
    """Return the manifest of FMI-LS-STRUCT."""
    words = "Layered standard for structuring of variables"
    tag, name = "fmiLayeredStandardManifest", "org.fmi-standard.fmi-ls-struct"
    return xml_bytes(manifest_root(tag, name, "1.0.0-rc.1", words))
