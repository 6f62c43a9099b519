"""SSP archives of a car and its axle, and of a car and its e-axle: a system around two FMUs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from fmu_src.identity import write_archive

Values = Mapping[str, float | int]  # an int is an Integer parameter
Ends = tuple[tuple[str, str], tuple[str, str]]  # (element, output) -> (element, input)
_STANDARD = "http://ssp-standard.org/SSP1/"  # of SSP 2.0 too
_NAMESPACES = {
    "ssd": f"{_STANDARD}SystemStructureDescription",
    "ssc": f"{_STANDARD}SystemStructureCommon",
    "ssv": f"{_STANDARD}SystemStructureParameterValues",
}
REQUEST = "vehicle.speed_request"  # input of the car, which only parameter sets set


class System(NamedTuple):
    """A system: the files of its elements in the archive, and what is connected."""

    name: str
    files: Mapping[str, str]
    connections: Sequence[Ends]


def _system(name: str, axle: str, pinion: tuple[str, str], wheel: tuple[str, str]) -> System:
    """Return a car around an axle, whose flanges have these names for (torque, motion)."""
    connections: list[Ends] = []
    for end, (torque, motion) in (("pinion", pinion), ("wheel", wheel)):
        connections.append((("car", f"{end}.torque"), ("axle", f"{torque}.torque")))
        for one in ("angle", "speed"):
            connections.append((("axle", f"{motion}.{one}"), ("car", f"{end}.{one}")))
    return System(name, {"car": "Driveline.fmu", "axle": axle}, connections)


CAR_AND_AXLE = _system("car_and_axle", "HypoidAxle.fmu", ("pinion", "pinion"), ("wheel", "wheel"))
CAR_AND_E_AXLE = _system("car_and_e_axle", "EAxle.fmu", ("motor", "input"), ("road", "output"))


class ParameterSet(NamedTuple):
    """Start values of one component under a name."""

    name: str
    component: str
    values: Values


def write_ssp(
    path: Path,
    system: System,
    fmus: Mapping[str, Path],
    sets: Sequence[ParameterSet],
    *,
    system_connectors: bool = False,
    version: str = "1.0",
) -> Path:
    """Write the archive and return its path.

    Parameters
    ----------
    path : path
    system : System
    fmus : mapping of str to path
        The FMU of each element.
    sets : sequence of ParameterSet
        For each component, the first is the one that a host takes which cannot choose.
    system_connectors : bool
        Whether the system has a connector of its own, for the vehicle's speed. FMPy needs one,
        libcosim and Ecos know connections between elements only.
    version : {"1.0", "2.0"}
        Version of SSP; 2.0 is that of SSP 2.0.1 too.
    """
    content = {f"resources/{system.files[name]}": fmu.read_bytes() for name, fmu in fmus.items()}
    content["SystemStructure.ssd"] = _described(system, sets, system_connectors, version)
    write_archive(path, content)
    return path


def write_ssv(path: Path, sets: Sequence[ParameterSet]) -> Path:
    """Write parameter sets of several components as one file of values, and return its path."""
    merged = {f"{one.component}.{name}": v for one in sets for name, v in one.values.items()}
    root = _root("ssv", "ParameterSet", version="1.0", name="start")
    _values(root, merged)
    path.write_bytes(_bytes(root))
    return path


def _described(
    described: System, sets: Sequence[ParameterSet], system_connectors: bool, version: str
) -> bytes:
    root = _root("ssd", "SystemStructureDescription", version=version, name=described.name)
    system = _child(root, "ssd", "System", name="system")
    if system_connectors:
        own = _child(system, "ssd", "Connectors")
        _connector(own, "vehicle.speed", "output")
    elements = _child(system, "ssd", "Elements")
    for name, fmu in described.files.items():
        own_sets = [one for one in sets if one.component == name]
        component = _child(
            elements, "ssd", "Component", name=name, type="application/x-fmu-sharedlibrary",
            source=f"resources/{fmu}",
        )  # fmt: skip
        connectors = _child(component, "ssd", "Connectors")
        for ends in described.connections:
            for kind, (element, variable) in zip(("output", "input"), ends, strict=True):
                if element == name:
                    _connector(connectors, variable, kind)
        if name == "car" and system_connectors:
            _connector(connectors, "vehicle.speed", "output")
        _bindings(component, own_sets, version)
    connections = _child(system, "ssd", "Connections")
    inner = [(*start, *end) for start, end in described.connections]
    outer = [("car", "vehicle.speed", "", "vehicle.speed")]
    for start, given_out, end, given_in in [*inner, *(outer if system_connectors else [])]:
        ends_of = {"startElement": start, "startConnector": given_out, "endElement": end,
                   "endConnector": given_in}  # fmt: skip
        _child(connections, "ssd", "Connection", **{k: v for k, v in ends_of.items() if v})
    _child(root, "ssd", "DefaultExperiment", startTime="0", stopTime="1")
    return _bytes(root)


def _bindings(component: ElementTree.Element, sets: Sequence[ParameterSet], version: str) -> None:
    if not sets:
        return
    bindings = _child(component, "ssd", "ParameterBindings")
    for one in sets:
        values = _child(_child(bindings, "ssd", "ParameterBinding"), "ssd", "ParameterValues")
        _values(_child(values, "ssv", "ParameterSet", version=version, name=one.name), one.values)


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
