"""The SSP archive of a car and its axle: SystemStructure.ssd around two FMUs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from fmu_src.identity import write_archive

Values = Mapping[str, float | int]  # an int is an Integer parameter
_STANDARD = "http://ssp-standard.org/SSP1/"
_NAMESPACES = {
    "ssd": f"{_STANDARD}SystemStructureDescription",
    "ssc": f"{_STANDARD}SystemStructureCommon",
    "ssv": f"{_STANDARD}SystemStructureParameterValues",
}
# (element, output) -> (element, input)
CONNECTIONS = (
    (("car", "pinion.torque"), ("axle", "pinion.torque")),
    (("car", "wheel.torque"), ("axle", "wheel.torque")),
    (("axle", "pinion.angle"), ("car", "pinion.angle")),
    (("axle", "pinion.speed"), ("car", "pinion.speed")),
    (("axle", "wheel.angle"), ("car", "wheel.angle")),
    (("axle", "wheel.speed"), ("car", "wheel.speed")),
)
REQUEST = "vehicle.speed_request"  # input of the car, which only parameter sets set
_FMUS = {"car": "Driveline.fmu", "axle": "HypoidAxle.fmu"}


class ParameterSet(NamedTuple):
    """Start values of one component under a name."""

    name: str
    component: str
    values: Values


def write_ssp(
    path: Path,
    driveline: Path,
    axle: Path,
    sets: Sequence[ParameterSet],
    *,
    system_connectors: bool = False,
) -> Path:
    """Write the archive and return its path.

    Parameters
    ----------
    path : path
    driveline, axle : path
        The FMUs.
    sets : sequence of ParameterSet
        For each component, the first is the one that a host takes which cannot choose.
    system_connectors : bool
        Whether the system has a connector of its own, for the vehicle's speed. FMPy needs one,
        libcosim and Ecos know connections between elements only.
    """
    description = _described(sets, system_connectors)
    content = {
        "SystemStructure.ssd": description,
        "resources/Driveline.fmu": driveline.read_bytes(),
        "resources/HypoidAxle.fmu": axle.read_bytes(),
    }
    write_archive(path, content)
    return path


def write_ssv(path: Path, sets: Sequence[ParameterSet]) -> Path:
    """Write parameter sets of several components as one file of values, and return its path."""
    merged = {f"{one.component}.{name}": v for one in sets for name, v in one.values.items()}
    root = _root("ssv", "ParameterSet", version="1.0", name="start")
    _values(root, merged)
    path.write_bytes(_bytes(root))
    return path


def _described(sets: Sequence[ParameterSet], system_connectors: bool) -> bytes:
    root = _root("ssd", "SystemStructureDescription", version="1.0", name="car_and_axle")
    system = _child(root, "ssd", "System", name="system")
    if system_connectors:
        own = _child(system, "ssd", "Connectors")
        _connector(own, "vehicle.speed", "output")
    elements = _child(system, "ssd", "Elements")
    for name, fmu in _FMUS.items():
        _component(elements, name, fmu, [s for s in sets if s.component == name], system_connectors)
    connections = _child(system, "ssd", "Connections")
    inner = [(*a, *b) for a, b in CONNECTIONS]
    outer = [("car", "vehicle.speed", "", "vehicle.speed")]
    for start, output, end, given in [*inner, *(outer if system_connectors else [])]:
        ends = {"startElement": start, "startConnector": output, "endElement": end,
                "endConnector": given}  # fmt: skip
        _child(connections, "ssd", "Connection", **{k: v for k, v in ends.items() if v})
    _child(root, "ssd", "DefaultExperiment", startTime="0", stopTime="1")
    return _bytes(root)


def _component(
    parent: ElementTree.Element,
    name: str,
    fmu: str,
    sets: Sequence[ParameterSet],
    system_connectors: bool,
) -> None:
    component = _child(
        parent, "ssd", "Component", name=name, type="application/x-fmu-sharedlibrary",
        source=f"resources/{fmu}",
    )  # fmt: skip
    connectors = _child(component, "ssd", "Connectors")
    for start, end in CONNECTIONS:
        for kind, (element, variable) in (("output", start), ("input", end)):
            if element == name:
                _connector(connectors, variable, kind)
    if name == "car" and system_connectors:
        _connector(connectors, "vehicle.speed", "output")
    if not sets:
        return
    bindings = _child(component, "ssd", "ParameterBindings")
    for one in sets:
        binding = _child(bindings, "ssd", "ParameterBinding")
        values = _child(binding, "ssd", "ParameterValues")
        _values(_child(values, "ssv", "ParameterSet", version="1.0", name=one.name), one.values)


def _values(parent: ElementTree.Element, values: Values) -> None:
    parameters = _child(parent, "ssv", "Parameters")
    for name, value in values.items():
        parameter = _child(parameters, "ssv", "Parameter", name=name)
        _child(parameter, "ssv", "Integer" if isinstance(value, int) else "Real", value=repr(value))


def _connector(parent: ElementTree.Element, name: str, kind: str) -> None:
    _child(_child(parent, "ssd", "Connector", name=name, kind=kind), "ssc", "Real")


def _root(prefix: str, tag: str, **attributes: str) -> ElementTree.Element:
    for short, address in _NAMESPACES.items():
        ElementTree.register_namespace(short, address)
    return ElementTree.Element(f"{{{_NAMESPACES[prefix]}}}{tag}", attributes)


def _child(
    parent: ElementTree.Element, prefix: str, tag: str, **attributes: str
) -> ElementTree.Element:
    return ElementTree.SubElement(parent, f"{{{_NAMESPACES[prefix]}}}{tag}", attributes)


def _bytes(root: ElementTree.Element) -> bytes:
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
