"""The dataset of a run-up: record, order tracks, waterfalls, modes and operating shape."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gearlube.report.churning import REGIME, churning_regime
from gearlube.studies.runup.modes import COORDINATES, RampModes, engine_orders, ramp_modes
from gearlube.studies.runup.record import AXES, BEARINGS, DIRECTIONS, RampRecord
from gearlube.studies.runup.rollers import roller_variables
from gearlube.studies.runup.settings import RunupSettings
from gearlube_core import __version__
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_axle.losses import LOSS_SOURCES
from gearlube_core.input_file.input_file import notes_as_text
from gearlube_core.spectra import OrderBlocks, order_blocks, samples_for, waterfall

# channels of the record in the order of modes.COORDINATES; the shafts' speeds give their turning
CHANNELS = (
    "pinion.speed",
    *(f"pinion.displacement.{axis}" for axis in "xyz"),
    "wheel.speed",
    *(f"wheel.displacement.{axis}" for axis in "xyz"),
)

_TURNING = (0, 4)  # of these


@dataclass(frozen=True, slots=True, kw_only=True)
class _OperatingShape:
    """Operating deflection shape.

    Parameters
    ----------
    speed : float
        Of the pinion [rad/s].
    mesh_order : int
        Cycles per mesh period [-].
    motion : array of complex
        Amplitude and phase of every coordinate, turning as displacement at the contact [m], shape
        (8,).
    share : array
        Of each mode in the kinetic energy of this motion [-], shape (modes,).
    """

    speed: float
    mesh_order: int
    motion: NDArray[np.complex128]
    share: Array


MESH_ORDERS = (1, 2, 3, 4)
HIGHEST_MESH_ORDER = 6.5  # of the order maps
_SLICES_OF_HERTZ = 400  # frequency bins at least, up to the highest frequency
_FINEST = 4.0  # Hz

# name: (unit, description)
QUANTITIES: Mapping[str, tuple[str, str]] = {
    "time": ("s", "time since the ramp began"),
    "bearing_force": ("N", "force of both bearings together on their shaft"),
    "pinion_speed": ("rad s-1", "speed of the pinion"),
    "wheel_speed": ("rad s-1", "speed of the gear"),
    "dte": ("m", "dynamic transmission error"),
    "mesh_force": ("N", "mesh force"),
    "axis": ("", "axis of the fixed frame"),
    "slow_time": ("s", "middle of an interval of the losses"),
    "loss": ("W", "power lost"),
    "churning_regime": REGIME,
    "power_in": ("W", "power into the pinion"),
    "range_exceeded": ("1", "whether something left the range of its formula or table"),
    "torque_time": ("s", "time of the torques"),
    "pinion_torque": ("N m", "torque on the pinion from outside"),
    "block": ("1", "blocks of whole revolutions that follow each other"),
    "block_time": ("s", "time at the middle of a block"),
    "block_speed": ("rad s-1", "mean speed of the pinion over a block"),
    "order": ("1", "cycles per pinion revolution"),
    "mesh_order": ("1", "cycles per mesh period"),
    "dte_orders": ("m", "amplitude of the dynamic transmission error"),
    "dte_track": ("m", "amplitude of the dynamic transmission error at a mesh order"),
    "dte_overall": ("m", "rms of the dynamic transmission error, all frequencies"),
    "mesh_force_track": ("N", "amplitude of the mesh force at a mesh order"),
    "bearing_force_orders": ("N", "amplitude of the bearing force"),
    "bearing_force_track": ("N", "amplitude of the bearing force at a mesh order"),
    "bearing_force_order_held": ("N", "rms of the largest mesh order there, without the car"),
    "bearing_force_overall": ("N", "rms of the bearing force about its mean, all frequencies"),
    "slice_time": ("s", "time at the middle of a slice"),
    "slice_speed": ("rad s-1", "speed of the pinion at the middle of a slice"),
    "frequency": ("Hz", "frequency"),
    "dte_waterfall": ("m", "amplitude of the dynamic transmission error"),
    "bearing_force_waterfall": ("N", "amplitude of the bearing force"),
    "separated_fraction": ("1", "share of time without contact"),
    "mode_speed": ("rad s-1", "pinion speed at which the modes were found"),
    "mode_frequency": ("Hz", "natural frequency"),
    "mode_damping": ("1", "damping ratio"),
    "mode_car_strain": ("1", "share of the strain energy of a mode in springs of the car"),
    "mode_shape": ("m kg^-1/2", "mode shape, modal mass 1; turning as motion at the contact"),
    "critical_speed": ("rad s-1", "pinion speed at which a mesh order meets a mode"),
    "critical_damping": ("1", "damping ratio at the critical speed"),
    "shape_amplitude": ("m", "motion where the forces are largest; turning as at the contact"),
    "shape_phase": ("rad", "phase of this motion"),
    "shape_share": ("1", "part of a mode in the kinetic energy of this motion"),
    "shape_speed": ("rad s-1", "pinion speed of this motion"),
    "shape_mesh_order": ("1", "mesh order of this motion"),
    "frame_time": ("s", "time of a frame in the turn of the pinion that is drawn"),
    "frame_angle": ("rad", "angle of the pinion since the first frame"),
    "ring": ("1", "bearing of the rollers, numbered from 1"),
    "roller_load": ("N", "load of a roller; nan: no such roller in this bearing"),
    "roller_angle": ("rad", "place of a roller around its shaft"),
}


def described(dataset: xr.Dataset) -> xr.Dataset:
    """Return `dataset` with `units` and `long_name` on every known variable."""
    for name in map(str, dataset.variables):
        if name in QUANTITIES:
            unit, text = QUANTITIES[name]
            dataset[name].attrs |= {"long_name": text} | ({"units": unit} if unit else {})
    return dataset


def runup_dataset(settings: RunupSettings, record: RampRecord) -> xr.Dataset:
    """Return record, losses, order tracks and waterfalls of a ramp as one dataset."""
    names = [*record.force_names, "mesh.dte", "mesh.force"]
    blocks = block_spectra(
        settings, record, np.stack([record.channels[name] for name in names], axis=1)
    )
    modes = ramp_modes(settings, record.torques[0])
    dataset = xr.Dataset(
        {
            **_record(record),
            **_losses(record, settings),
            **_orders(settings, blocks),
            **_waterfalls(settings, record),
            **_separation(settings, record),
            **_modes(settings, modes),
            **_shape(settings, record, modes, blocks),
            **roller_variables(settings, record, _loudest_time(settings, record, blocks)),
        },
        coords={
            "bearing": list(BEARINGS),
            "direction": list(DIRECTIONS),
            "source": list(LOSS_SOURCES),
            "mesh_order": list(MESH_ORDERS),
            "mode": list(modes.names),
            "coordinate": list(COORDINATES),
        },
        attrs=_attributes(settings, record),
    )
    return described(dataset)


def _record(record: RampRecord) -> dict[str, tuple[object, Array]]:
    single = np.float32
    forces = np.stack([record.forces(i) for i in range(len(BEARINGS))], axis=1)
    return {
        "time": ("time", record.time),
        "axis": (("bearing", "direction"), np.array(AXES)),
        "bearing_force": (("time", "bearing", "direction"), forces.astype(single)),
        "pinion_speed": ("time", record.channels["pinion.speed"].astype(single)),
        "wheel_speed": ("time", record.channels["wheel.speed"].astype(single)),
        "dte": ("time", record.channels["mesh.dte"].astype(single)),
        "mesh_force": ("time", record.channels["mesh.force"].astype(single)),
    }


def _losses(record: RampRecord, settings: RunupSettings) -> dict[str, tuple[object, Array]]:
    steps = np.diff(record.slow_time)
    powers = np.diff(record.energies, axis=0) / steps[:, None]
    torque, axle = record.torques[0], settings.car_axle.axle
    middle = record.slow_time[:-1] + 0.5 * steps
    speed = np.interp(middle, record.time, record.smooth_speed) / axle.mesh.ratio
    regime = churning_regime(axle, settings.oil_temperature, speed)
    return {
        "slow_time": ("slow_time", middle),
        **({} if regime is None else {"churning_regime": ("slow_time", regime)}),
        "power_in": ("slow_time", powers[:, 0]),
        "range_exceeded": ("slow_time", np.logical_or(record.outside[:-1], record.outside[1:])),
        "loss": (("slow_time", "source"), powers[:, 1:]),
        "torque_time": ("torque_time", np.linspace(0.0, settings.duration, torque.size)),
        "pinion_torque": ("torque_time", torque),
    }


def block_spectra(settings: RunupSettings, record: RampRecord, signals: Array) -> OrderBlocks:
    """Return the orders of `signals`, shape (n, channels), along the ramp."""
    slowest = min(settings.start_speed, settings.end_speed)
    samples = samples_for(settings.highest_frequency, slowest)
    teeth = settings.car_axle.axle.mesh.pinion_teeth
    return order_blocks(
        record.time,
        record.channels["pinion.angle"],
        signals,
        revolutions=settings.revolutions,
        samples_per_revolution=samples,
        highest_order=min(HIGHEST_MESH_ORDER * teeth, 0.5 * samples),
    )


def _places(settings: RunupSettings) -> Array:
    """Return the bins of the mesh orders."""
    teeth = settings.car_axle.axle.mesh.pinion_teeth
    return np.array([round(teeth * m * settings.revolutions) for m in MESH_ORDERS])


def _orders(settings: RunupSettings, found: OrderBlocks) -> dict[str, tuple[object, Array]]:
    """Return maps and tracks of the orders of forces, transmission error and mesh force."""
    amplitude = np.abs(found.amplitude)
    shape = (len(BEARINGS), len(DIRECTIONS))
    forces = amplitude[..., :-2].reshape(*amplitude.shape[:2], *shape)
    at = _places(settings)
    both = ("bearing", "direction")
    single = np.float32
    return {
        "block_time": ("block", found.time),
        "block_speed": ("block", found.speed),
        "order": ("order", found.order),
        "bearing_force_orders": (
            ("block", *both, "order"),
            np.moveaxis(forces, 1, -1).astype(single),
        ),
        "bearing_force_track": (("block", *both, "mesh_order"), np.moveaxis(forces[:, at], 1, -1)),
        "bearing_force_overall": (("block", *both), found.rms[:, :-2].reshape(-1, *shape)),
        "dte_orders": (("block", "order"), amplitude[..., -2].astype(single)),
        "dte_track": (("block", "mesh_order"), amplitude[:, at, -2]),
        "dte_overall": ("block", found.rms[:, -2]),
        "mesh_force_track": (("block", "mesh_order"), amplitude[:, at, -1]),
    }


def _waterfalls(settings: RunupSettings, record: RampRecord) -> dict[str, tuple[object, Array]]:
    resolution = _resolution(settings)
    names = [*record.force_names, "mesh.dte"]
    found = [
        waterfall(
            record.channels[name],
            settings.sample_rate,
            resolution=resolution,
            highest_frequency=settings.highest_frequency,
        )
        for name in names
    ]
    levels = np.stack([one.amplitude for one in found[:-1]], axis=1)
    shape = (levels.shape[0], len(BEARINGS), len(DIRECTIONS), levels.shape[2])
    speed = np.interp(found[0].time, record.time, record.smooth_speed)
    single = np.float32
    return {
        "slice_time": ("slice", found[0].time),
        "slice_speed": ("slice", speed),
        "frequency": ("frequency", found[0].frequency),
        "bearing_force_waterfall": (
            ("slice", "bearing", "direction", "frequency"),
            levels.reshape(shape).astype(single),
        ),
        "dte_waterfall": (("slice", "frequency"), found[-1].amplitude.astype(single)),
    }


def _separation(settings: RunupSettings, record: RampRecord) -> dict[str, float]:
    dte, backlash = record.channels["mesh.dte"], settings.car_axle.axle.backlash
    return {"separated_fraction": float(np.mean((dte < 0.0) & (dte > -backlash)))}


def _modes(settings: RunupSettings, modes: RampModes) -> dict[str, tuple[object, Array]]:
    teeth = settings.car_axle.axle.mesh.pinion_teeth
    count = range(len(modes.names))
    critical = np.array([[modes.critical_speed(k, teeth * m) for m in MESH_ORDERS] for k in count])
    damping = np.array([[modes.damping_at(k, v) for v in critical[k]] for k in count])
    return {
        "mode_speed": ("mode_speed", modes.speed),
        "mode_frequency": (("mode_speed", "mode"), modes.frequency),
        "mode_damping": (("mode_speed", "mode"), modes.damping_ratio),
        "mode_shape": (("coordinate", "mode"), modes.shape),
        **({} if modes.car_strain is None else {"mode_car_strain": ("mode", modes.car_strain)}),
        "critical_speed": (("mode", "mesh_order"), critical),
        "critical_damping": (("mode", "mesh_order"), damping),
    }


def _loudest_time(settings: RunupSettings, record: RampRecord, blocks: OrderBlocks) -> float:
    """Return the time [s] at which a mesh order of the bearing forces is largest."""
    tracks = np.abs(blocks.amplitude[:, _places(settings), : len(record.force_names)])
    return float(blocks.time[loudest(tracks)[0]])


def _shape(
    settings: RunupSettings, record: RampRecord, modes: RampModes, blocks: OrderBlocks
) -> dict[str, object]:
    """Return the motion where the forces are largest; `blocks` are the orders of `FORCES`."""
    teeth = settings.car_axle.axle.mesh.pinion_teeth
    tracks = np.abs(blocks.amplitude[:, _places(settings), : len(record.force_names)])
    block, place = loudest(tracks)
    # the turns of this block and some on either side
    angle = record.channels["pinion.angle"]
    turns = np.interp(blocks.time[block], record.time, angle) / (2.0 * math.pi)
    reach = 2.0 * math.pi * (0.5 * settings.revolutions + 2.0)
    near = np.abs(angle - 2.0 * math.pi * turns) <= reach
    part = replace(
        record,
        time=record.time[near],
        channels={name: values[near] for name, values in record.channels.items()},
    )
    signals = np.stack([part.channels[name] for name in CHANNELS], axis=1)
    around = block_spectra(settings, part, signals)
    block = int(np.argmin(np.abs(around.time - blocks.time[block])))
    found = operating_shape(around, block, MESH_ORDERS[place], teeth, modes)
    return {
        "shape_amplitude": ("coordinate", np.abs(found.motion)),
        "shape_phase": ("coordinate", np.angle(found.motion)),
        "shape_share": ("mode", found.share),
        "shape_speed": found.speed,
        "shape_mesh_order": found.mesh_order,
    }


def _resolution(settings: RunupSettings) -> float:
    """Return the distance of frequency bins [Hz] at which the first mesh order is sharpest.

    A slice of length T smears an order that moves by r [Hz/s] over r T, beside its bins 1/T; the
    two are equal at T = r^-1/2.
    """
    teeth = settings.car_axle.axle.mesh.pinion_teeth
    rate = abs(settings.ramp.acceleration) * teeth / (2.0 * math.pi)
    wanted = max(_FINEST, math.sqrt(rate), 4.0 / settings.duration)
    samples = round(
        settings.sample_rate / min(wanted, settings.highest_frequency / _SLICES_OF_HERTZ)
    )
    return settings.sample_rate / samples


def _attributes(settings: RunupSettings, record: RampRecord) -> dict[str, object]:
    car = settings.car_axle
    axle = car.axle
    gear, engine = engine_orders(settings)
    return {
        "title": f"{settings.name} of a lubricated hypoid axle",
        "ramp": settings.name,
        "gearlube_version": __version__,
        "axle": car.name,
        "axle_source": car.source,
        "mesh_table": axle.mesh.name,
        "oil": axle.oil.name,
        "bearing_preload": float(axle.bearings[0].preload_force()),
        "pinion_teeth": int(axle.mesh.pinion_teeth),
        "gear_teeth": int(axle.mesh.gear_teeth),
        "rolling_radius": float(car.driveline.road_load.tyre.rolling_radius),
        "ranges_left": "\n".join(record.warnings),
        "inputs_given": notes_as_text([n for n in car.inputs if n.origin == "given"]),
        "inputs_assumed": notes_as_text(car.assumed),
        "engine_gear": gear,
        "engine_orders": np.array(engine),
        **{f"setting_{name}": value for name, value in settings.as_dict().items()},
    }


def loudest(force_track: Array) -> tuple[int, int]:
    """Return block and place of the mesh order with the largest force over all directions.

    `force_track` has shape (blocks, orders, directions).
    """
    total = np.sqrt(np.sum(force_track**2, axis=2))
    block, order = np.unravel_index(int(np.argmax(total)), total.shape)
    return int(block), int(order)


def operating_shape(
    blocks: OrderBlocks, block: int, mesh_order: int, teeth: int, modes: RampModes
) -> _OperatingShape:
    """Return the motion in a block of the order analysis of `CHANNELS`."""
    order = teeth * mesh_order
    place = int(np.argmin(np.abs(blocks.order - order)))
    speed = float(blocks.speed[block])
    motion = blocks.amplitude[block, place].copy()
    for at, radius in zip(_TURNING, modes.radii, strict=True):
        motion[at] *= radius / (1j * order * speed)
    # shapes have modal mass 1, so that this is the modal amplitude
    modal = np.abs(modes.shape.T @ (modes.mass * motion)) ** 2
    total = float(np.sum(modes.mass * np.abs(motion) ** 2))
    return _OperatingShape(
        speed=speed,
        mesh_order=mesh_order,
        motion=motion,
        share=modal / total if total > 0.0 else np.full(modal.size, math.nan),
    )
