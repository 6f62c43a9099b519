"""modelDescription.xml and terminals of FMI 3.0, written from the table of variables."""

from __future__ import annotations

from importlib.metadata import version
from xml.etree import ElementTree

from fmu_src.definition import Definition
from fmu_src.model_description import (
    attributes_of,
    type_name,
    write_default_experiment,
    write_log_categories,
    write_units,
    xml_bytes,
)
from fmu_src.native.array_variables import ArrayVariable, array_variables
from fmu_src.variable import Variable

_TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
# flange -> its variables and what they are at a mechanical connection
_FLANGES = {
    "pinion": ("Pinion shaft", "pinion.torque", "pinion.speed", "pinion.angle"),
    "wheel": ("Shaft of the gear to the wheels", "wheel.torque", "wheel.speed", "wheel.angle"),
}
_MEMBERS = ("torque", "speed", "angle")
ICON = "terminalsAndIcons/icon.png"
_ICON_SIZE = 100.0  # of the drawing in its own units


def _variable(parent: ElementTree.Element, array: ArrayVariable) -> None:
    variable: Variable = array.variable
    attributes = {
        "name": variable.name,
        "valueReference": str(array.references[0]),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    if variable.initial is not None:
        attributes["initial"] = variable.initial
    element = ElementTree.SubElement(
        parent, _TYPES[variable.type], attributes | attributes_of(variable)
    )
    if len(array.references) > 1:
        ElementTree.SubElement(element, "Dimension", start=str(len(array.references)))


def _types(root: ElementTree.Element, definition: Definition) -> None:
    enumerations = [variable for variable in definition.variables if variable.literals]
    if not enumerations:  # an empty element is no valid one
        return
    parent = ElementTree.SubElement(root, "TypeDefinitions")
    for variable in enumerations:
        enumeration = ElementTree.SubElement(
            parent, "EnumerationType", name=type_name(variable), description=variable.description
        )
        for value, literal in enumerate(variable.literals, start=1):
            ElementTree.SubElement(enumeration, "Item", name=literal, value=str(value))


def model_description_3(definition: Definition, token: str) -> bytes:
    """Return modelDescription.xml of FMI 3.0 for co-simulation.

    Parameters
    ----------
    definition : Definition
        The FMU.
    token : str
        Instantiation token: identifier of its content.
    """
    root = ElementTree.Element(
        "fmiModelDescription",
        {
            "fmiVersion": "3.0",
            "modelName": definition.name,
            "instantiationToken": token,
            "description": definition.description,
            "author": "The gearlube developers",
            "version": version("gearlube"),
            "license": "MIT",
            "generationTool": f"gearlube {version('gearlube')}",
            "variableNamingConvention": "structured",
        },
    )
    ElementTree.SubElement(
        root,
        "CoSimulation",
        {
            "modelIdentifier": definition.name,
            "needsExecutionTool": "false",
            "canBeInstantiatedOnlyOncePerProcess": "false",
            "canGetAndSetFMUState": "true",
            "canSerializeFMUState": "true",
            "canHandleVariableCommunicationStepSize": "true",
        },
    )
    write_units(root, definition)
    _types(root, definition)
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
    arrays = array_variables(definition.variables)
    for array in arrays:
        _variable(parent, array)
    known = " ".join(
        str(array.references[0]) for array in arrays if array.variable.causality != "output"
    )
    structure = ElementTree.SubElement(root, "ModelStructure")
    outputs = [array for array in arrays if array.variable.causality == "output"]
    # Outputs hold the end of the last step: setting an input changes none of them by itself.
    for kind, dependencies in (("Output", ""), ("InitialUnknown", known)):
        for array in outputs:
            ElementTree.SubElement(
                structure,
                kind,
                valueReference=str(array.references[0]),
                dependencies=dependencies,
            )
    return xml_bytes(root)


def terminals(definition: Definition) -> bytes:
    """Return terminalsAndIcons.xml: the two flanges, and the icon."""
    root = ElementTree.Element("fmiTerminalsAndIcons", fmiVersion="3.0")
    box = {"x1": "0", "y1": "0", "x2": str(_ICON_SIZE), "y2": str(_ICON_SIZE)}
    graphics = ElementTree.SubElement(root, "GraphicalRepresentation")
    scale = {"suggestedScalingFactorTo_mm": "0.2"}
    ElementTree.SubElement(graphics, "CoordinateSystem", box | scale)
    ElementTree.SubElement(graphics, "Icon", box)
    parent = ElementTree.SubElement(root, "Terminals")
    for name, (words, *variables) in _FLANGES.items():
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
    return xml_bytes(root)
