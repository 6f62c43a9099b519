"""modelDescription.xml of FMI 2.0, written from the table of variables."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from importlib.metadata import version
from typing import NamedTuple
from xml.etree import ElementTree

from fmu_src.definition import Definition
from fmu_src.native.model import Exchange
from fmu_src.variable import Variable
from gearlube_core.errors import ParameterError
from gearlube_core.units import ZERO_CELSIUS

LOG_CATEGORIES = {
    "logEvents": "What the model was initialised with.",
    "logStatusWarning": "Unusual, but computed.",
    "logStatusDiscard": "A step that was refused; the model stayed where it was.",
    "logStatusError": "A value that was refused when it was set.",
    "logStatusFatal": "Initialisation or a call that could not be carried out.",
    "logAll": "All messages.",
}

_TOLERANCE = 1e-6  # relative, for solvers of model exchange


_BASE = ("kg", "m", "s", "K", "rad")
_DERIVED = {"N": "kg.m/s2", "Pa": "kg/(m.s2)", "J": "kg.m2/s2", "W": "kg.m2/s3", "Hz": "1/s"}


class DisplayUnit(NamedTuple):
    """A display unit: shown value = factor * value + offset."""

    name: str
    factor: float
    offset: float = 0.0


class Unit(NamedTuple):
    """A coherent SI unit, and how it may be shown."""

    name: str
    display: tuple[DisplayUnit, ...] = ()

    @property
    def exponents(self) -> dict[str, int]:
        """Powers of the base units; raise KeyError where the name is no product of SI units."""
        found = dict.fromkeys(_BASE, 0)
        above, _, below = self.name.partition("/")
        for factors, sign in ((above, 1), (below.strip("()"), -1)):
            for symbol, power in _FACTOR.findall(factors.replace("1", "")):
                parts = Unit(_DERIVED[symbol]).exponents if symbol in _DERIVED else {symbol: 1}
                for base, exponent in parts.items():
                    found[base] += sign * exponent * int(power or 1)
        return {base: power for base, power in found.items() if power}


_FACTOR = re.compile(r"([^.\d]+)(\d?)")
_ALL = (
    Unit("1"),
    Unit("m", (DisplayUnit("um", 1e6), DisplayUnit("mm", 1e3))),
    Unit("m/s", (DisplayUnit("km/h", 3.6),)),
    Unit("rad", (DisplayUnit("deg", 180.0 / math.pi),)),
    Unit("rad/s", (DisplayUnit("rpm", 30.0 / math.pi),)),
    Unit("rad/s2"),
    Unit("m/s2"),
    Unit("Hz"),
    Unit("m3", (DisplayUnit("l", 1e3),)),
    Unit("kg"),
    Unit("kg.m2"),
    Unit("N", (DisplayUnit("kN", 1e-3),)),
    Unit("N/m"),
    Unit("N/m2", (DisplayUnit("N/(mm.um)", 1e-9),)),
    Unit("Pa", (DisplayUnit("GPa", 1e-9),)),
    Unit("N.m"),
    Unit("N.m/s"),
    Unit("N.m.s/rad"),
    Unit("J"),
    Unit("W"),
    Unit("K", (DisplayUnit("degC", 1.0, -ZERO_CELSIUS),)),
)
UNITS = {unit.name: unit for unit in _ALL}  # in the order of model descriptions, others behind


def units_of(variables: Iterable[Variable]) -> tuple[Unit, ...]:
    """Return the units that `variables` use, each with only the display units in use."""
    shown: dict[str, set[str]] = {}
    for variable in variables:
        if variable.unit:
            try:
                _ = Unit(variable.unit).exponents
            except KeyError:
                raise ParameterError(
                    f"The unit of {variable.name} must be one of the SI, such as N.m or W/(m.K); "
                    f"got {variable.unit!r}."
                ) from None
            shown.setdefault(variable.unit, set()).add(variable.display_unit)
    known = [name for name in UNITS if name in shown]
    return tuple(
        Unit(name, tuple(d for d in UNITS[name].display if d.name in shown[name]))
        if name in UNITS
        else Unit(name)
        for name in (*known, *(name for name in shown if name not in UNITS))
    )


def number_text(value: float) -> str:
    """Return a number as XML has it."""
    return repr(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(value)


def type_name(variable: Variable) -> str:
    """Return the name of the enumeration type of `variable`: mesh.damping -> MeshDamping."""
    return "".join(word.capitalize() for word in re.split(r"[._]", variable.name))


def write_units(root: ElementTree.Element, definition: Definition) -> None:
    """Add UnitDefinitions, the same in FMI 2 and 3."""
    parent = ElementTree.SubElement(root, "UnitDefinitions")
    for unit in units_of(definition.variables):
        element = ElementTree.SubElement(parent, "Unit", name=unit.name)
        exponents = {base: str(power) for base, power in unit.exponents.items()}
        ElementTree.SubElement(element, "BaseUnit", exponents)
        for display in unit.display:
            attributes = {"name": display.name, "factor": number_text(display.factor)}
            if display.offset:
                attributes["offset"] = number_text(display.offset)
            ElementTree.SubElement(element, "DisplayUnit", attributes)


def write_types(root: ElementTree.Element, definition: Definition, *tags: str) -> None:
    """Add TypeDefinitions: each type is an element of the first tag, others lie inside it."""
    enumerations = [v for v in definition.variables if v.literals]
    if not enumerations:
        return  # the element must not be empty
    parent = ElementTree.SubElement(root, "TypeDefinitions")
    for variable in enumerations:
        named = {"name": type_name(variable), "description": variable.description}
        element = parent
        for tag in tags:
            element = ElementTree.SubElement(element, tag, named if element is parent else {})
        for value, literal in enumerate(variable.literals, start=1):
            ElementTree.SubElement(element, "Item", name=literal, value=str(value))


def named_attributes(variable: Variable, reference: int) -> dict[str, str]:
    """Return the attributes that every variable has, the same in FMI 2 and 3."""
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    return attributes | ({"initial": variable.initial} if variable.initial else {})


def attributes_of(variable: Variable) -> dict[str, str]:
    """Return the attributes that depend on the type, the same in FMI 2 and 3."""
    attributes: dict[str, str] = {}
    if variable.type == "Enumeration":
        attributes["declaredType"] = type_name(variable)
    if variable.unit:
        attributes["unit"] = variable.unit
    if variable.display_unit:
        attributes["displayUnit"] = variable.display_unit
    numbers = {"min": variable.minimum, "max": variable.maximum, "nominal": variable.nominal}
    attributes |= {key: number_text(value) for key, value in numbers.items() if value is not None}
    if variable.start is not None:
        text = number_text(variable.start)
        attributes["start"] = ("false", "true")[bool(variable.start)] if (
            variable.type == "Boolean"
        ) else text  # fmt: skip
    return attributes


def _variables(
    root: ElementTree.Element, definition: Definition, exchange: Exchange | None
) -> None:
    parent = ElementTree.SubElement(root, "ModelVariables")
    for reference, variable in enumerate(definition.variables):
        scalar = ElementTree.SubElement(
            parent, "ScalarVariable", named_attributes(variable, reference)
        )
        of_type = attributes_of(variable)
        if exchange and variable.rate_of:
            of_type["derivative"] = str(definition.references[variable.rate_of] + 1)
        ElementTree.SubElement(scalar, variable.type, of_type)


def dependencies_of(
    references: Iterable[int], definition: Definition, exchange: Exchange | None
) -> dict[int, list[int]]:
    """Return the references of the inputs and states that each computed variable depends on.

    Without model exchange nothing: outputs hold the end of the last step, and setting an input
    changes none of them by itself.
    """
    if not exchange:
        return {reference: [] for reference in references}
    states = sorted(definition.references[name] for name in exchange.states)
    found = {}
    for reference in references:
        name = definition.variables[reference].name
        if name in exchange.states:
            found[reference] = [reference]
        elif name in exchange.of_states:
            found[reference] = states
        else:
            found[reference] = sorted(states + definition.references_of("input"))
    return found


def _structure(
    root: ElementTree.Element, definition: Definition, exchange: Exchange | None
) -> None:
    parent = ElementTree.SubElement(root, "ModelStructure")
    known = definition.references_of("input") + definition.references_of("parameter")
    outputs = definition.references_of("output")
    sections = {"Outputs": dependencies_of(outputs, definition, exchange)}
    if exchange:
        rates = [definition.references[name] for name in exchange.rates(definition)]
        states = [definition.references[name] for name in exchange.states]
        sections["Derivatives"] = dependencies_of(rates, definition, exchange)
        outputs = sorted({*outputs, *rates, *states})
    sections["InitialUnknowns"] = dict.fromkeys(outputs, sorted(known))
    for section, unknowns in sections.items():
        element = ElementTree.SubElement(parent, section)
        for reference, dependencies in unknowns.items():
            ElementTree.SubElement(
                element,
                "Unknown",
                index=str(reference + 1),
                dependencies=" ".join(str(one + 1) for one in dependencies),
            )


def write_log_categories(root: ElementTree.Element) -> None:
    """Add LogCategories, the same in FMI 2 and 3."""
    categories = ElementTree.SubElement(root, "LogCategories")
    for name, description in LOG_CATEGORIES.items():
        ElementTree.SubElement(categories, "Category", name=name, description=description)


def write_default_experiment(root: ElementTree.Element, definition: Definition) -> None:
    """Add DefaultExperiment, the same in FMI 2 and 3."""
    ElementTree.SubElement(
        root,
        "DefaultExperiment",
        startTime="0",
        stopTime=number_text(definition.stop_time),
        tolerance=number_text(_TOLERANCE),
        stepSize=number_text(definition.step_size),
    )


def xml_bytes(root: ElementTree.Element) -> bytes:
    """Return an indented XML file."""
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True) + b"\n"


def description_root(
    fmi: str, definition: Definition, identifier: str, guid: str, tool: str
) -> ElementTree.Element:
    """Return the root of a description, with what FMI 2 and 3 both ask for.

    `identifier` is the name that the version of the standard has for the GUID; `tool` is what
    makes the FMU beside gearlube.
    """
    release = version("gearlube")
    return ElementTree.Element(
        "fmiModelDescription",
        {
            "fmiVersion": fmi,
            "modelName": definition.name,
            identifier: guid,
            "description": definition.description,
            "author": "The gearlube developers",
            "version": release,
            "license": "MIT",
            "generationTool": f"gearlube {release}{tool}",
            "variableNamingConvention": "structured",
        },
    )


def model_description(
    definition: Definition, guid: str, *, native: bool = False, exchange: Exchange | None = None
) -> bytes:
    """Return modelDescription.xml as UTF-8 bytes; the same input gives the same bytes.

    Parameters
    ----------
    definition : Definition
        The FMU.
    guid : str
        Identifier of its content.
    native : bool
        Whether the FMU computes by itself, or in the installed package gearlube.
    exchange : Exchange, optional
        Of an FMU that is for model exchange too.

    Notes
    -----
    generationDateAndTime is optional in FMI 2.0 (section 2.2.1) and left out, so that a build can
    be repeated bit for bit.
    """
    tool = "" if native else f", PythonFMU {version('pythonfmu')}"
    root = description_root("2.0", definition, "guid", guid, tool)
    root.set("numberOfEventIndicators", str(len(exchange.indicators) if exchange else 0))
    common = {
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    }
    if exchange:
        ElementTree.SubElement(
            root,
            "ModelExchange",
            {
                "modelIdentifier": definition.name,
                "needsExecutionTool": "false",
                "completedIntegratorStepNotNeeded": "false",
                **common,
                "providesDirectionalDerivative": "true",
            },
        )
    ElementTree.SubElement(
        root,
        "CoSimulation",
        {
            "modelIdentifier": definition.name,
            "needsExecutionTool": "false" if native else "true",
            "canHandleVariableCommunicationStepSize": "true",
            "canInterpolateInputs": "false",
            "maxOutputDerivativeOrder": "0",
            "canRunAsynchronuously": "false",
            **common,
            "providesDirectionalDerivative": "false",
        },
    )
    write_units(root, definition)
    write_types(root, definition, "SimpleType", "Enumeration")
    write_log_categories(root)
    write_default_experiment(root, definition)
    _variables(root, definition, exchange)
    _structure(root, definition, exchange)
    return xml_bytes(root)
