"""A whole gearbox of REXS as the tables of a train file: shafts, bearings, stages, a load case."""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from gearlube_core.dynamics.train.gear_pair import GearPair
from gearlube_core.errors import ParameterError
from gearlube_core.rexs.cylindrical import pair_data
from gearlube_core.rexs.gearbox_shafts import MIDDLE, GearboxShaft, Reading, disc, read_shafts
from gearlube_core.rexs.model import Component, RexsModel
from gearlube_core.rexs.stage import ExchangeNote, Stage
from gearlube_core.shafts.section import ShaftDisc
from gearlube_core.units import DEGREE, MILLIMETRE

logger = logging.getLogger(__name__)
_BEARINGS = (
    "concept_bearing", "rolling_bearing_with_catalog_geometry",
    "rolling_bearing_with_detailed_geometry",
)  # fmt: skip
_OTHER_STAGES = ("planetary_stage", "bevel_stage", "worm_stage")
_READ = (
    "gear_unit", "gear_casing", "shaft", "shaft_section", "cylindrical_gear", "cylindrical_stage",
    "cylindrical_gear_flank", "material", "additional_mass", "external_load", *_BEARINGS,
)  # fmt: skip
_APART = 1e-3  # relative, of axes against the centre distance
_STEEL = 7850.0  # kg/m3
# what stands for numbers that the file lacks, in the units of train files
_RADIAL, _AXIAL, _TILT = 300.0, 100.0, 2e4  # N/um, N/um, N.m/rad
_RIGID, _RIGID_TILT = 1e4, 1e6  # the same: bearings that count as rigid
_DAMPER, _FRICTION, _BACKLASH, _RATIO = 1000.0, 0.05, 100.0, 0.02  # N.s/m, -, um, -
_SPEED, _TORQUE, _OIL, _OIL_TEMPERATURE = 1000.0, 100.0, "mohammadpour_2015", 60.0


class RexsTrain(NamedTuple):
    """The tables of a train file, and what became of every number."""

    data: dict[str, Any]
    notes: tuple[ExchangeNote, ...]

    def comments(self) -> str:
        """Return assumed, inferred and left-out numbers as comments of a TOML file."""
        meaning = {
            "lacking": "Assumed, because the REXS file does not say it; correct what matters:",
            "inferred": "Follows from other numbers:",
            "left out": "Left out:",
        }
        lines = []
        for kind, words in meaning.items():
            said = [f"{note.what}: {note.why}" for note in self.notes if note.kind == kind]
            found = [f"#   {' '.join(one.split())}" for one in said]  # names may have line breaks
            lines += [f"# {words}", *found] if found else []
        return "".join(f"{line}\n" for line in lines)


class _Mesh(NamedTuple):
    fields: dict[str, Any]
    pinion: GearboxShaft
    gear: GearboxShaft


def read_gearbox(path: str | Path) -> RexsTrain:
    """Return the train of a gearbox in a REXS file with shafts, bearings and cylindrical stages.

    Parameters
    ----------
    path : path
        XML (.rexs), JSON (.rexsj) or an archive (.rexsz) of one of them.

    Returns
    -------
    RexsTrain
        z of the train is u of the shafts, x is v and y is w. Gears become discs of their pitch
        diameter on the shafts, bearings springs; the first load case is the start.

    Raises
    ------
    ParameterError
        The file lacks what a train needs, which is named, its shafts are not parallel, or it has
        stages of other kinds.

    References
    ----------
    [fva_2022].

    Examples
    --------
    >>> found = read_gearbox("my_gearbox.rexs")  # doctest: +SKIP
    >>> print(found.comments())  # doctest: +SKIP
    """
    reading = Reading(RexsModel.read(path))
    model = reading.model
    for other in model.of_kind(*_OTHER_STAGES):
        raise ParameterError(
            f"{model.path} must have cylindrical stages alone, got {other}. Write a train file by "
            "hand: `gearlube drivetrain planetary --example` prints one with planets to start "
            "from, hypoid_axle one with bevel gears."
        )
    shafts = read_shafts(reading)
    meshes = {
        reading.named(one): _mesh(reading, one, shafts)
        for one in model.of_kind("cylindrical_stage")
    }
    if not meshes:
        raise ParameterError(f"{model.path} must have a cylindrical_stage, got none.")
    elements = {name: mesh.fields for name, mesh in meshes.items()}
    for one in model.of_kind(*_BEARINGS):
        elements[reading.named(one)] = _bearing(reading, one, shafts)
    stiff = [one for one in elements.values() if one.get("K_zz_n_per_um")]
    held = {one[side].partition(".")[0] for one in stiff for side in ("first", "second")}
    if loose := [one.name for one in shafts.values() if one.name not in held]:
        words = "%s: no bearing holds %s along the axis, so a run finds no static equilibrium. "
        cure = "Give each of these shafts a bearing with an axial_stiffness above 0."
        logger.warning(words + cure, model.path, ", ".join(loose))
    ports = _ports(reading, shafts, elements)
    if reading.absent:
        raise reading.incomplete()
    start = _start(reading, shafts, tuple(meshes.values()), ports, elements)
    reading.note("lacking", "damping_n_s_per_m and friction of gear meshes",
                 f"{_DAMPER:g} N s/m and {_FRICTION:g}")  # fmt: skip
    reading.note("lacking", "c_x, c_y and c_z of bearings", f"{_DAMPER:g} N s/m")
    reading.note("lacking", "damping_ratio of shafts", f"{_RATIO:g}")
    reading.note("lacking", "oil.name", f"{_OIL}, an oil of the package")
    for kind in sorted({one.kind for one in model.components.values()} - set(_READ)):
        reading.note("left out", kind, f"{len(model.of_kind(kind))} of this type")
    bodies = {
        one.name: {"kind": "shaft", "damping_ratio": _RATIO, "nodes_mm": one.nodes,
                   "sections": one.sections, "discs": one.discs}
        | ({"material": one.material} if one.material else {})
        for one in shafts.values()
    }  # fmt: skip
    data = {
        "name": model.path.stem, "source": model.source, "steps_per_highest_period": 8,
        "oil": {"name": _OIL}, "start": start, "bodies": bodies, "elements": elements,
    }  # fmt: skip
    return RexsTrain(data, tuple(reading.notes))


def _shaft_of(
    reading: Reading, part: Component, shafts: dict[int, GearboxShaft]
) -> GearboxShaft | None:
    related = reading.model.related("assembly", "part", part.number)
    numbers = [one.get("assembly", -1) for one in related]
    return next((shafts[one] for one in numbers if one in shafts), None)


def _mesh(reading: Reading, component: Component, shafts: dict[int, GearboxShaft]) -> _Mesh:
    """Return a mesh; which side drives is not known yet."""
    stage = Stage.chosen(reading.model, component.number)
    given = pair_data(stage, {})
    gears = stage.pinion, stage.gear
    on = [_shaft_of(reading, one, shafts) for one in gears]
    lost = [one for one, shaft in zip(gears, on, strict=True) if shaft is None]
    reading.absent += [f"an assembly of a shaft and {one}" for one in lost] + stage.absent
    places = [reading.needed(one, MIDDLE, "mm") for one in gears]
    pinion, gear = on
    if reading.absent or pinion is None or gear is None:
        raise reading.incomplete()
    name = f"elements.{reading.named(component)}"
    helix = given["pair.helix_angle_deg"]
    cos = math.cos(helix * DEGREE)
    module = given.get("pair.normal_module_mm")
    if module is None:
        module = given["pair.transverse_module_mm"] * cos
    pressure = given.get("pair.normal_pressure_angle_deg")
    if pressure is None:
        tan = math.tan(given["pair.transverse_pressure_angle_deg"] * DEGREE)
        pressure = math.atan(tan * cos) / DEGREE
    backlash = given.get("pair.backlash_mm")
    if backlash is None:
        reading.note("lacking", f"{name}.backlash_um", f"{_BACKLASH:g} um")
    fields = {
        "kind": "gear_mesh",
        "first": pinion.node(reading.named(stage.pinion), places[0]),
        "second": gear.node(reading.named(stage.gear), places[1]),
        "teeth_1": given["pinion.teeth"], "teeth_2": given["gear.teeth"],
        "normal_module_mm": module, "normal_pressure_angle_deg": pressure,
        "helix_angle_deg": helix, "drives_forward": True,
        "right_hand": (stage.pinion.value("helix_angle_reference_diameter", "deg") or 0.0) > 0.0,
        "centre_distance_mm": given["pair.centre_distance_mm"],
        "azimuth_deg": _azimuth(reading, stage, pinion, gear),
        "face_width_mm": given["pair.face_width_mm"],
        "backlash_um": _BACKLASH if backlash is None else 1e3 * backlash,
        "friction": _FRICTION, "damping_n_s_per_m": _DAMPER,
    }  # fmt: skip
    pair = GearPair(
        name=str(component), teeth_1=fields["teeth_1"], teeth_2=fields["teeth_2"],
        normal_module=module * MILLIMETRE, face_width=fields["face_width_mm"] * MILLIMETRE,
        normal_pressure_angle=pressure * DEGREE, helix_angle=helix * DEGREE,
        centre_distance=fields["centre_distance_mm"] * MILLIMETRE,
    )  # fmt: skip
    stiffness = f"{1e-6 * pair.iso_stiffness:.4g} N/um, that of ISO 6336-1, without waves"
    reading.note("lacking", f"{name}.stiffness_n_per_um", stiffness)
    for one, shaft, u, radius in zip(gears, (pinion, gear), places, pair.radii, strict=True):
        width = (one.value("face_width", "mm") or fields["face_width_mm"]) * MILLIMETRE
        _add_blank(reading, one, shaft, shaft.place[0] + u, (2.0 * radius, width))
    return _Mesh(fields, pinion, gear)


def _azimuth(reading: Reading, stage: Stage, pinion: GearboxShaft, gear: GearboxShaft) -> float:
    """Return the direction from the pinion's axis to the gear's, from v towards w [deg]."""
    v, w = (b - a for a, b in zip(pinion.place[1:], gear.place[1:], strict=True))
    if v or w:
        apart = math.hypot(v, w)
        wanted = reading.needed(stage.stage, "center_distance", "mm")
        if abs(apart - wanted) > _APART * wanted:
            raise ParameterError(
                f"Shafts {pinion.name} and {gear.name} must stand {wanted:g} mm apart, the "
                f"center_distance of {stage.stage}, got {apart:g} mm by their support_vector. "
                "Correct one of them."
            )
        return math.degrees(math.atan2(w, v))
    angle = stage.stage.value("rotating_angle_around_neg_u_axis", "deg")
    if angle is None:
        name = f"elements.{reading.named(stage.stage)}.azimuth_deg"
        reading.note("lacking", name, "90 deg from gear_1 to gear_2")
    way = 90.0 - (angle or 0.0)
    first = reading.model.related("stage", "stage", stage.stage.number)[0]["gear_1"]
    return way if first == stage.pinion.number else (way + 360.0) % 360.0 - 180.0


def _add_blank(
    reading: Reading, gear: Component, shaft: GearboxShaft, z: float, size: tuple[float, float]
) -> None:
    """Add a gear at z [mm]: a ring from the shaft to a diameter, of a width [m]."""
    inner = shaft.diameter(z)
    if inner is None:
        reading.absent.append(f"a shaft_section of {shaft.name} below {gear}, at {z:g} mm")
        return
    diameter, width = size
    if diameter <= inner * MILLIMETRE:
        return
    density = shaft.material.get("density_kg_m3", _STEEL)
    try:
        ring = ShaftDisc.ring(z * MILLIMETRE, diameter, inner * MILLIMETRE, width, density)
    except ParameterError as reason:
        raise ParameterError(f"{gear}, as a ring from the shaft: {reason}") from None
    shaft.discs.append(disc(z, ring.mass, ring.inertia, ring.polar_inertia))
    words = (
        f"{ring.mass:.4g} kg, a ring from {inner:g} mm to {1e3 * diameter:.4g} mm, its pitch circle"
    )
    reading.note("inferred", f"disc of {reading.named(gear)}", words)


def _bearing(
    reading: Reading, bearing: Component, shafts: dict[int, GearboxShaft]
) -> dict[str, Any]:
    """Return the springs of a bearing."""
    name = reading.named(bearing)
    sides = (reading.model.related("side", "assembly", bearing.number) or [{}])[0]
    joint: dict[str, Any] = {"kind": "joint"}
    for key, side in (("first", "inner"), ("second", "outer")):
        shaft = shafts.get(sides.get(f"{side}_part", -1))
        joint[key] = "ground"
        if shaft is not None:
            u = reading.needed(bearing, f"u_coordinate_on_shaft_{side}_side", "mm")
            joint[key] = shaft.node(name, u)
    if joint["first"] == joint["second"]:
        reading.absent.append(f"a relation of type side between {bearing} and a shaft")
    radial = 0.0 if bearing.word("radial_force_absorption") == "false" else _RADIAL
    axial = 0.0 if bearing.word("axial_force_absorption") == "no_direction" else _AXIAL
    of_force, of_tilt = (
        ("N / m", 1e-6, _RIGID, "N/um"),
        ("N mm / rad", 1e-3, _RIGID_TILT, "N m/rad"),
    )
    for keys, attribute, usual, (unit, factor, most, shown) in (
        (("K_xx_n_per_um", "K_yy_n_per_um"), "radial_stiffness", radial, of_force),
        (("K_zz_n_per_um",), "axial_stiffness", axial, of_force),
        (("K_ax_n_m_per_rad", "K_ay_n_m_per_rad"), "bending_stiffness", _TILT, of_tilt),
    ):
        given = bearing.value(attribute, unit)
        if given is not None and given <= 0.0 < usual and attribute == "radial_stiffness":
            raise ParameterError(
                f"radial_stiffness of {bearing} must be above 0, got {given:g} N/m: nothing would "
                f"hold its shaft. Correct it, leave it out for {usual:g} N/um, or say that the "
                'bearing takes no such force: radial_force_absorption = "false".'
            )
        value = usual if given is None else min(factor * given, most)
        joint |= dict.fromkeys(keys, value)
        if given is None:
            reading.note("lacking", f"elements.{name}.{keys[0]}", f"{value:g} {shown}")
        elif factor * given > most:
            why = f"{value:g} {shown}, as {factor * given:g} is rigid"
            reading.note("inferred", f"elements.{name}.{keys[0]}", why)
    if not any(value for key, value in joint.items() if key.startswith("K_")):
        raise ParameterError(
            f"{bearing} must have a stiffness, got 0 for all directions. Leave the bearing out, or "
            "give what it takes."
        )
    return joint | dict.fromkeys(("c_x_n_s_per_m", "c_y_n_s_per_m", "c_z_n_s_per_m"), _DAMPER)


class _PortOf(NamedTuple):
    shaft: GearboxShaft
    torque: float | None  # of the first load case [N.m]


def _case(reading: Reading) -> dict[int, Component]:
    return reading.model.cases[0] if reading.model.cases else {}


def _ports(
    reading: Reading, shafts: dict[int, GearboxShaft], elements: dict[str, Any]
) -> dict[str, _PortOf]:
    """Add a port for each load that carries torque; return them by name."""
    case, found = _case(reading), {}
    for load in reading.model.of_kind("external_load"):
        shaft = _shaft_of(reading, load, shafts)
        if shaft is None or load.word("transmits_torque") == "false":
            reading.note("left out", str(load), "forces, and what is on no shaft")
            continue
        said, name = case.get(load.number), reading.named(load)
        torque = None if said is None else said.value("torque_around_u_axis", "N m")
        node = shaft.node(name, reading.needed(load, MIDDLE, "mm"))
        elements[name] = {"kind": "port", "body": node}
        found[name] = _PortOf(shaft, torque)
    return found


def _start(
    reading: Reading,
    shafts: dict[int, GearboxShaft],
    meshes: Sequence[_Mesh],
    ports: dict[str, _PortOf],
    elements: dict[str, Any],
) -> dict[str, Any]:
    """Return the start in the first load case, with the side from which each mesh is driven."""
    case = _case(reading)
    if len(reading.model.cases) > 1:
        reading.note("left out", "load cases", f"{len(reading.model.cases) - 1} after the first")
    speeds = {n: one.value("rotational_speed", "1 / min") for n, one in case.items() if n in shafts}
    turning = next((n for n, one in speeds.items() if one), None)
    first = next(iter(shafts.values())) if turning is None else shafts[turning]
    first.speed = (None if turning is None else speeds[turning]) or _SPEED
    if turning is None:
        reading.note("lacking", f"start.speed_rpm of {first.name}", f"{_SPEED:g} rpm")
    _turn(reading, meshes, first)
    driving = (one.shaft for one in ports.values() if (one.torque or 0.0) * one.shaft.speed > 0.0)
    driver = next(driving, first)
    last = _turn(reading, meshes, driver)
    for name, shaft in (("drive", driver), ("load", last)):
        if all(one.shaft is not shaft for one in ports.values()):
            node = shaft.node(name, shaft.sections[-1]["end_mm"] - shaft.place[0])
            elements[name] = {"kind": "port", "body": node}
            ports[name] = _PortOf(shaft, None)
            reading.note("lacking", f"elements.{name}", f"a torque at the end of {shaft.name}")
    torques = {name: one.torque for name, one in ports.items() if one.torque is not None}
    if not any(torques.values()):
        name = next(name for name, one in ports.items() if one.shaft is driver)
        torques[name] = math.copysign(_TORQUE, driver.speed)
        reading.note("lacking", f"start.torque_n_m.{name}", f"{torques[name]:g} N m")
    power = sum(torque * ports[name].shaft.speed for name, torque in torques.items())
    free = [name for name in ports if name not in torques]
    for name in free:
        torques[name] = -power / len(free) / ports[name].shaft.speed
        why = f"{torques[name]:.5g} N m, the balance without losses"
        reading.note("lacking", f"start.torque_n_m.{name}", why)
    oil = [t for one in case.values() if (t := one.value("temperature_lubricant", "C")) is not None]
    if not oil:
        reading.note("lacking", "start.oil_temperature_degc", f"{_OIL_TEMPERATURE:g} degC")
    return {
        "oil_temperature_degc": oil[0] if oil else _OIL_TEMPERATURE,
        "speed_rpm": {last.name: last.speed},  # it bears what losses leave
        "torque_n_m": torques,
    }


def _turn(reading: Reading, meshes: Sequence[_Mesh], root: GearboxShaft) -> GearboxShaft:
    """Set the speeds of all shafts and the driving side of every mesh; return the last shaft."""
    reached, left = [root.name], list(meshes)
    last = root
    while left:
        mesh = next((m for m in left if {m.pinion.name, m.gear.name} & set(reached)), None)
        if mesh is None:
            raise ParameterError(
                f"{reading.model.path} must connect all gears by its stages, got some that "
                f"{root.name} does not reach. Export the whole gear unit."
            )
        left.remove(mesh)
        fields, pinion, gear = mesh
        ratio = fields["teeth_1"] / fields["teeth_2"]
        forward = pinion.name in reached
        last = gear if forward else pinion
        last.speed = -pinion.speed * ratio if forward else -gear.speed / ratio
        # the pinion pushes about +z where it drives so, or where it is driven about -z
        fields["drives_forward"] = (pinion.speed > 0.0) == forward
        reached.append(last.name)
    return last
