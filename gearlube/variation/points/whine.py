"""Whine of a built axle at the driver's ear: flanks, teeth, bearings and case as made."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import ClassVar, Self

import numpy as np

from gearlube.studies.runup.record import AXES, BEARINGS, DIRECTIONS
from gearlube.studies.sound.pressure import REFERENCE, a_weighting
from gearlube.studies.sound.transfer_path import (
    AXLE_FORCES,
    Complex,
    TransferPath,
    generic_path,
    read_csv_path,
)
from gearlube.studies.sweep.axle_in_fmu import settings_of
from gearlube.studies.sweep.point import marched
from gearlube.studies.sweep.recording import Recording, operation
from gearlube.studies.sweep.settings import SPEED_RANGE, SweepSettings, quick_sweep_settings
from gearlube.variation.design import Point, Value
from gearlube.variation.file_variants import content_hash
from gearlube.variation.keys import Key, Keys
from gearlube.variation.point_study import Quantity
from gearlube.variation.points.contact import MISALIGNMENTS, misalignment, teeth_of
from gearlube.variation.points.of_file import AxlePoint, operand, value
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.hypoid_contact.mesh_cycle import PAIRS_BESIDE, CycleSettings, position_record
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.tooth_errors.error_cycle import ToothErrorCycle, added_rotation
from gearlube_core.hypoid_contact.tooth_errors.pair_curves import position_curves
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.gear_file_sections import FlankRelief
from gearlube_core.hypoid_geometry.measured.tooth_errors import MemberErrors, ToothErrors
from gearlube_core.mesh_table.table import MEMBERS, MeshTable, fourier, orders_kept
from gearlube_core.storage.resumable import Record
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_contact.mesh_cycle import stack_records
from gearlube_core.units import celsius_to_kelvin

SPEED = operand("vehicle.speed_kmh", "km/h", "Of the vehicle", 60.0, *SPEED_RANGE)
TEMPERATURE = operand("oil.temperature_degc", "degC", "Of the oil", 95.0, -60.0, 250.0)


def _microns(name: str, meaning: str, most: float) -> Key:
    return operand(f"{name}_um", "um", meaning, 0.0, -most, most)


RUNOUT = {m: _microns(f"runout.{m}", "Radial, peak to peak", 500.0) for m in MEMBERS}
PITCH = {m: _microns(f"pitch.{m}", "Cumulative, rms of the teeth", 200.0) for m in MEMBERS}
PROFILE = {
    f"{name}_um": _microns(f"profile.{name}", "Growth on the pinion's drive flank", 200.0)
    for name in ("profile_crown", "lead_crown", "twist")
}
STIFFNESS = operand("case.stiffness_percent", "%", "Growth of the case's", 0.0, -50.0, 100.0)
TRANSFER = operand("case.transfer_db", "dB", "Growth of pressure over force", 0.0, -40.0, 40.0)
PATH = operand("transfer", "", "File of the transfer path; generic", "generic", kind="text")
NOISE = operand("cabin.noise_dba", "dB", "Noise at the ear, A-weighted", 65.0, 0.0, 120.0)
_OPERANDS = (
    SPEED, TEMPERATURE, *MISALIGNMENTS, *PROFILE.values(), *RUNOUT.values(), *PITCH.values(),
    STIFFNESS, TRANSFER, PATH, NOISE,
)  # fmt: skip
ORDERS = (1, 2)  # of the mesh
_BODY = ToothBodySettings()
_POSITIONS, _QUICK_POSITIONS = 16, 8
_SPAN = 60e-6  # m, reach of the curves of tooth pairs beyond that of the torque
_RECORD = 0.3  # s of a quick run, two turns of the gear or more
_OF_BODY = ((1, 2), (3, 4))  # bearings of pinion and gear
_NOISE_BAND = 20.0, 16000.0  # Hz


@dataclass(frozen=True, kw_only=True)
class WhinePoint(AxlePoint):
    """An axle as built: its flanks are loaded, it is marched in time, its forces are heard.

    Parameters
    ----------
    gears : HypoidGearFile
    paths : mapping of str to TransferPath
        By the text in `transfer`.
    quick : bool
        Half of the mesh positions and short records.
    """

    name: ClassVar[str] = "whine"
    block: ClassVar[int] = 2
    shown: ClassVar[tuple[str, ...]] = (
        "whine_level",
        "tone_to_noise",
        "level_mesh_1",
        "level_mesh_2",
    )
    operands: ClassVar[Keys] = {key.name: key for key in _OPERANDS}
    quantities: ClassVar[tuple[Quantity, ...]] = (
        Quantity("whine_level", "dB", "whine at the ear, A-weighted, all lines"),
        Quantity("tone_to_noise", "dB", "loudest mesh order over the noise in its critical band"),
        *(Quantity(f"level_mesh_{k}", "dB", f"mesh order {k} at the ear") for k in ORDERS),
        *(Quantity(f"level_beside_{k}", "dB", f"sidebands of mesh order {k}") for k in ORDERS),
        Quantity("pinion_torque", "N.m", "torque at which the flanks are loaded"),
    )

    gears: HypoidGearFile
    paths: Mapping[str, TransferPath] = field(default_factory=dict)
    quick: bool = False

    @property
    def identity(self) -> str:
        """Axle and gear file, transfer paths, and whether it is quick."""
        paths = {name: content_hash(name) for name in self.paths}
        return f"{self.axle.identity} {self.gears.model_dump_json()} {paths} {self.quick}"

    def prepared(self, texts: Mapping[str, tuple[Value, ...]]) -> Self:
        """Return the study with all files read that the values of the axes name."""
        own = {name: one for name, one in texts.items() if name != PATH.name}
        named = map(str, texts.get(PATH.name, (PATH.usual,)))
        read = super().prepared(own)
        return replace(read, paths={name: _path(name) for name in named})

    def check(self, point: Point) -> None:
        """Raise ParameterError where a field, speed, misalignment or error is out of range."""
        for key in self.operands.values():
            if key.kind == "number":
                check_within(key.name, value(point, key), key.low, key.high, key.unit)
        self.axle.car_axle(point)

    def compute(self, point: Point) -> Sequence[float]:
        """Load the flanks as built, march the axle on them, and send its forces to the ear."""
        car, settings = self.axle.car_axle(point), self._settings(point)
        torque = self._torque(point)
        table = self._table(point, torque)
        car = replace(car, axle=replace(car.axle, mesh=table))
        recording = marched(car, value(point, SPEED), settings)
        orders = lines(recording.teeth, table.gear_teeth)
        stiffness = 1.0 + 0.01 * value(point, STIFFNESS)
        path = self.paths[str(value(point, PATH))]
        pressure = order_pressures(recording, path, orders, stiffness)
        pressure *= 10.0 ** (value(point, TRANSFER) / 20.0)
        frequency = recording_frequency(recording) * orders
        return (*levels(pressure, frequency, value(point, NOISE)), torque)

    def _gears(self, point: Point) -> HypoidGearFile:
        """Return the gear file as built; its own limits are those of designs, not of errors."""
        pinion = self.gears.pinion
        flank = pinion.drive_flank or FlankRelief.model_validate({})
        grown = {n: getattr(flank, n) + value(point, key) for n, key in PROFILE.items()}
        built = pinion.model_copy(update={"drive_flank": flank.model_copy(update=grown)})
        return self.gears.model_copy(update={"pinion": built})

    def _settings(self, point: Point) -> SweepSettings:
        settings = settings_of(
            self.axle.car_axle({}).axle,
            oil_temperature=celsius_to_kelvin(value(point, TEMPERATURE)),
        )
        return replace(quick_sweep_settings(settings), record_time=_RECORD if self.quick else 0.6)

    def _torque(self, point: Point) -> float:
        """Return the torque that the nominal car needs at the speed [N.m], without losses."""
        speed = value(point, SPEED)
        car = self.axle.car_axle({})
        return operation(self._settings(point), speed, car.driveline).driver.initial_torques()[0]

    def _table(self, point: Point, torque: float) -> MeshTable:
        nominal = self.gears.model_dump_json()
        settings = CycleSettings(
            torques=(torque,),
            positions=_QUICK_POSITIONS if self.quick else _POSITIONS,
            misalignment=misalignment(point),
        )
        pair = FlankPair.from_file(self._gears(point), "drive", settings.misalignment)
        stiffness = teeth_of(nominal, _BODY)["drive"]
        records = [position_record(pair, float(p), stiffness, settings) for p in settings.phases]
        table = table_as_built(self.axle.car_axle({}).axle.mesh, torque, stack_records(records))
        errors = self._errors(point)
        if errors.is_none:
            return table
        aligned, curves = _curves(nominal, torque, settings.positions)
        arm = table.mean("R_p", torque)
        turn = added_rotation(aligned, torque, settings.phases, curves, errors)
        return ToothErrorCycle(
            phases=settings.phases,
            torque=table.torque,
            error=(aligned.touching_sign * arm * turn)[None],
            pinion_teeth=table.pinion_teeth,
            gear_teeth=table.gear_teeth,
            alike=tuple(one for one in MEMBERS if errors.of(one).is_none),  # type: ignore[arg-type]
        ).added_to(table)

    def _errors(self, point: Point) -> ToothErrors:
        made, blank = {}, self.gears.blank()
        for member in MEMBERS:
            part = getattr(blank, member)
            rms = 1e-6 * value(point, PITCH[member])
            pitch = rms / part.mean_pitch_radius * pitch_pattern(rms, part.teeth)
            eccentricity = 0.5e-6 * value(point, RUNOUT[member])
            made[member] = MemberErrors(
                pitch={"drive": pitch} if rms else {}, eccentricity=eccentricity
            )
        return ToothErrors(**made)


def table_as_built(nominal: MeshTable, torque: float, loaded: Record) -> MeshTable:
    """Return a mesh table at one torque with the series of a loaded pair, drive flanks.

    The windows, which films and friction of the flanks read, are those of the nominal table's
    nearest level. Formulas as in `contact_dataset`; e is the mean arm times the first touch.
    """
    state = {name: values[:, 0] for name, values in loaded.items()}
    force = np.linalg.norm(state["force"], axis=-1)
    arm, touching = torque / force, state["unloaded_rotation"]
    samples = {
        "k_m": torque / (state["rotation"] - touching) / arm**2,
        "k_t": state["tangent"] / arm**2,
        "R_p": arm,
        "R_g": state["gear_torque"] / force,
        "e": arm.mean() * (touching - touching.min()),
        **dict(zip(("n_x", "n_y", "n_z"), (state["force"] / force[:, None]).T, strict=True)),
    }
    orders = orders_kept(touching.size)
    near = int(np.argmin(np.abs(nominal.torque - torque)))
    return replace(
        nominal,
        torque=np.array([torque]),
        series={name: fourier(one, orders)[None] for name, one in samples.items()},
        windows={name: one[near : near + 1] for name, one in nominal.windows.items()},
        shaft_error={},
    )


def pitch_pattern(seed: float, teeth: int) -> Array:
    """Return cumulative pitch errors of rms 1 and mean 0 [-], a random pattern for each `seed`.

    Examples
    --------
    >>> pattern = pitch_pattern(2e-6, 13)
    >>> round(float(np.mean(pattern**2)), 12), round(abs(float(pattern.mean())), 12)
    (1.0, 0.0)
    """
    bits = int(np.float64(abs(seed)).view(np.uint64))
    drawn = np.random.default_rng(bits).standard_normal(teeth)
    drawn -= drawn.mean()
    return np.asarray(drawn / np.sqrt(np.mean(drawn**2)))


def lines(pinion_teeth: int, gear_teeth: int) -> Array:
    """Return mesh orders, each with the four lines beside it, in turns of the pinion [-]."""
    gear = pinion_teeth / gear_teeth
    return np.array([k * pinion_teeth + d for k in ORDERS for d in (0.0, -1.0, 1.0, -gear, gear)])


def recording_frequency(recording: Recording) -> float:
    """Return the pinion's turns per second over the record."""
    angle, time = recording["pinion.angle"], recording.time
    return float((angle[-1] - angle[0]) / (2.0 * math.pi * (time[-1] - time[0])))


def order_amplitudes(recording: Recording, channels: Sequence[str], orders: Array) -> Complex:
    """Return complex amplitudes of channels by orders, shape (channels, orders): least squares."""
    angle = recording["pinion.angle"]
    share = np.linspace(-1.0, 1.0, angle.size)
    turns = np.outer(angle, orders)
    basis = np.column_stack([np.ones(angle.size), share, np.cos(turns), np.sin(turns)])
    window = np.hanning(angle.size)[:, None]
    signals = np.column_stack([recording[one] for one in channels])
    found = np.linalg.lstsq(window * basis, window * signals, rcond=None)[0][2:]
    return np.asarray((found[: orders.size] - 1j * found[orders.size :]).T)


def order_pressures(
    recording: Recording, path: TransferPath, orders: Array, stiffness: float = 1.0
) -> Complex:
    """Return the complex pressure at the ear by orders [Pa], shape (orders,).

    A case of k times the stiffness and the same mass has its modes higher by the root of k; the
    acceleration for a force keeps its height, and with it the pressure: H(f / sqrt(k)).
    """
    frequency = recording_frequency(recording) * orders / math.sqrt(stiffness)
    for end in (frequency.min(), frequency.max()):
        check_within("the orders in the transfer path", float(end), *path.band, "Hz")
    pressure = np.zeros(orders.size, complex)
    for body, numbers, axes in zip(BEARINGS, _OF_BODY, AXES, strict=True):
        for direction, axis in zip(DIRECTIONS, axes, strict=True):
            channels = [f"bearing[{j}].force.{axis}" for j in numbers]
            force = order_amplitudes(recording, channels, orders).sum(axis=0)
            pressure += path.at(f"{body}.{direction}", frequency) * force
    return pressure


def levels(pressure: Complex, frequency: Array, noise: float) -> tuple[float, ...]:
    """Return the levels of the quantities of sound [dB] of complex amplitudes by `lines`.

    The cabin noise, A-weighted `noise` [dB] in all, is assumed to fall by 6 dB per octave. The
    critical band is that of [zwicker_terhardt_1980]; the tone has all lines of its order.

    Examples
    --------
    >>> pressure = np.zeros(10, complex)
    >>> pressure[0] = np.sqrt(2.0)
    >>> round(levels(pressure, np.full(10, 1000.0), 65.0)[0], 2)  # 1 Pa at 1 kHz
    93.98
    """
    power = 0.5 * np.abs(pressure) ** 2 / REFERENCE**2
    f = np.geomspace(*_NOISE_BAND, 2000)
    weighted = np.trapezoid((a_weighting(f) / f) ** 2, f)
    scale = 10.0 ** (0.1 * noise) / weighted  # density = scale / f^2
    per_order = power.reshape(len(ORDERS), -1)
    middle = frequency.reshape(len(ORDERS), -1)[:, 0]
    band = 25.0 + 75.0 * (1.0 + 1.4e-6 * middle**2) ** 0.69
    over = per_order.sum(axis=1) / (scale * band / middle**2)
    whole = np.sum(power * a_weighting(frequency) ** 2)
    beside = per_order[:, 1:].sum(axis=1)
    found = np.array([whole, over.max(), *per_order[:, 0], *beside])
    return tuple(map(float, 10.0 * np.log10(np.maximum(found, 1e-12))))


def _path(name: str) -> TransferPath:
    found = generic_path(AXLE_FORCES) if name == PATH.usual else read_csv_path(Path(name))
    found.check_paths(AXLE_FORCES)
    return found


@lru_cache(maxsize=2)
def _curves(file: str, torque: float, positions: int) -> tuple[FlankPair, Record]:
    """Return the aligned pair of a gear file, and the curves of its single tooth pairs."""
    gears = HypoidGearFile.model_validate_json(file)
    pair = FlankPair.from_file(gears, "drive")
    settings = CycleSettings(torques=(torque,), positions=positions)
    stiffness = teeth_of(file, _BODY)["drive"]
    span = _SPAN / (0.5e-3 * gears.pinion.outer_cone_distance_mm)
    records = [
        position_curves(
            pair, float(p), torque, span, ((), ()), PAIRS_BESIDE, stiffness, settings.loaded
        )
        for p in settings.phases
    ]
    return pair, stack_records(records)
