"""The film of a hypoid tooth pair from a case: mesh table, motion of the axle, oil."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle import (
    OUTPUT_INDEX,
    HypoidAxle,
    HypoidAxleParameters,
    mohammadpour_2015_axle,
)
from gearlube_core.dynamics.ranges import TORQUE_MARGIN
from gearlube_core.ehl.case.hypoid_case import HypoidCase
from gearlube_core.ehl.gears.hypoid_film import FlankCycle, HypoidFilm, pair_contact, phase_of
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_migration, contact_path
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.mesh_table.table import PAIRS
from gearlube_core.oil.film_oil_data import film_oil_of
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.units import kelvin_to_celsius

LOADS = ("dynamic", "static")

_SETTLE = 0.8  # s until the motion repeats at the speed asked for
_STEPS = 128  # communication steps a mesh period

# N m s/rad at the pinion and 1/s: hold the speed within some 50 ms, far slower than any mode
_HOLD, _RESET = 0.2, 8.0

_PHI, _SPEED, _LOAD, _FILM, _MU = (
    OUTPUT_INDEX[name]
    for name in (
        "pinion.angle",
        "pinion.speed",
        "flank[1].load",
        "flank[1].film_thickness",
        "flank[1].friction_coefficient",
    )
)


class _PairDrive(NamedTuple):
    """One tooth pair over its window; arrays (N,)."""

    time: Array  # [s]
    angle: Array  # of the pinion [rad], 0 where the window begins
    speed: Array  # of the pinion [rad/s]
    load: Array  # of the pair [N]
    axle_film: Array  # that the axle model finds [m]; nan without motion
    axle_friction: Array  # its coefficient of friction [-]; nan without motion


_POSITIONS = 25  # of the path, smooth between

logger = logging.getLogger("gearlube")

_FEWEST = 8  # samples of a cycle


@dataclass(frozen=True, slots=True)
class HypoidFlank:
    """The film problem of a case, with mesh data, motion and oil.

    Parameters
    ----------
    case
        Case as the user gave it.
    parameters
        Axle, with table, oil and roughness.
    film
        Contact through the loaded part of the engagement.
    drive
        Load and speed at the same samples, with film and friction of the axle model.
    """

    case: HypoidCase
    parameters: HypoidAxleParameters
    film: HypoidFilm
    drive: _PairDrive

    @property
    def oil(self) -> LubricantState:
        """Oil at its temperature, as the axle sees it."""
        return self.parameters.oil.state(self.case.oil_temperature)


def hypoid_flank(case: HypoidCase) -> HypoidFlank:
    """Return the film of one tooth pair of a case.

    Raises
    ------
    ParameterError
        Something is out of range, or the pair carries no load over the phases asked for.
    """
    torque, speed = case.pinion_torque_n_m, case.pinion_speed
    if torque == 0.0:
        raise ParameterError(
            "pinion_torque_n_m must not be 0 N.m. Give a torque above 0 for the "
            "drive flank, below 0 for the coast flank."
        )
    parameters = mohammadpour_2015_axle(
        mesh=case.table(), oil=case.oil, roughness_rms=1e-6 * case.roughness_um
    )
    low, high = parameters.oil.temperature_low, parameters.oil.temperature_high
    check_within(
        "oil_temperature_degc",
        kelvin_to_celsius(case.oil_temperature),
        round(kelvin_to_celsius(low), 9),
        round(kelvin_to_celsius(high), 9),
        "degC",
        f"The data of {case.oil} are meant for this range.",
    )
    check_table_torque(torque, parameters.torque_range)
    drive = (
        dynamic_drive(parameters, speed, torque, case.oil_temperature)
        if case.load == "dynamic"
        else static_drive(parameters, speed, torque)
    )
    phase = phase_of(parameters.mesh, drive.angle)
    held = loaded_span(case, phase, drive.load)
    drive = _PairDrive(*(values[held] for values in drive))
    film = HypoidFilm(
        cycle=_cycle(case, parameters, drive, phase[held]),
        lubricant=film_oil_of(parameters.oil, case.oil_temperature),
        contact_modulus=contact_modulus(parameters.solid, parameters.solid),
        nodes=(case.solver.nodes_minor, case.solver.nodes_major),
        flow=case.flow,
    )
    return HypoidFlank(case, parameters, film, drive)


def check_table_torque(torque: float, ends: tuple[float, float]) -> None:
    """Warn of a pinion torque [N.m] beyond the mesh table; refuse one far beyond.

    Raises
    ------
    ParameterError
        Above `TORQUE_MARGIN` times the torque at which the table ends.
    """
    low, high = ends
    cure = f"The mesh table ends at {low:g} and {high:g} N.m. Run `gearlube contact` beyond."
    check_within(
        "pinion_torque_n_m", torque, TORQUE_MARGIN * low, TORQUE_MARGIN * high, "N.m", cure
    )
    if not low <= torque <= high:
        logger.warning(
            "The pinion torque is %g N.m. %s Outside the table the values at its end are used.",
            torque,
            cure,
        )


def loaded_span(case: HypoidCase, phase: Array, load: Array) -> slice:
    """Return the loaded samples around the largest load, within the requested phases."""
    most = float(load.max())
    carries = (load >= case.smallest_load * most) & (load > 0.0)
    carries &= (phase >= case.first_phase) & (phase <= case.last_phase)
    if not carries.any():
        raise ParameterError(
            f"The pair carries no load between phases {case.first_phase:g} and "
            f"{case.last_phase:g}. Widen first_phase and last_phase."
        )
    top = int(np.where(carries, load, -1.0).argmax())
    gaps = np.flatnonzero(~carries)
    first = int(gaps[gaps < top].max(initial=-1)) + 1
    last = int(gaps[gaps > top].min(initial=carries.size))
    if last - first < _FEWEST:
        raise ParameterError(
            f"The pair carries load over {last - first} samples only, {_FEWEST} are needed. Widen "
            "the phases or lower smallest_load."
        )
    return slice(first, last)


def _cycle(
    case: HypoidCase, parameters: HypoidAxleParameters, drive: _PairDrive, phase: Array
) -> FlankCycle:
    contact = pair_contact(parameters.mesh, case.pinion_torque_n_m, phase)
    motion = contact.entrainment
    if case.entrainment == "moving_contact":
        if case.gear_file is None:
            raise ParameterError(
                'entrainment = "moving_contact" needs gear_file. Give the gear '
                "file from which the mesh table was made."
            )
        motion = motion - _contact_motion(case.gear_file, case.pinion_torque_n_m, phase)
    return FlankCycle(
        time=drive.time - drive.time[0],
        angle=drive.angle,
        phase=phase,
        load=drive.load,
        R_x=contact.R_x,
        R_y=contact.R_y,
        entrainment=motion * drive.speed[:, None],
        sliding=contact.sliding * drive.speed[:, None],
    )


def _contact_motion(gear: str, torque: float, phase: Array) -> Array:
    """Return the velocity of the point of contact over pinion speed, shape (N, 2) [m].

    Parameters
    ----------
    gear
        Gear file, shipped or .toml.
    torque
        Its sign chooses the flank [N m].
    phase : ndarray, shape (N,)
        Mesh periods from the middle of the pair's window.

    Raises
    ------
    ParameterError
        The flanks do not touch over these phases.

    Notes
    -----
    Along the minor and the major axis, both turned so that entrainment points to larger values, as
    in `HypoidFilm`. The velocity itself is that of `contact_migration`.
    The path is that of the unloaded flanks as they are cut, without corrections; the centre of
    force of loaded ones stays close to it.
    """
    file, side = HypoidGearFile.given(gear), "drive" if torque > 0.0 else "coast"
    pair = FlankPair.from_file(file, side).uncorrected()  # type: ignore[arg-type]
    places = np.linspace(phase.min(), phase.max(), _POSITIONS)
    path = contact_path(pair, places * pair.gear_pitch)
    k, motion = path_kinematics(path), contact_migration(path)
    parts = []
    for axis in (k.minor_axis, k.major_axis):
        side = np.sign(np.einsum("ni,ni->n", k.entrainment, axis))
        parts.append(side * np.einsum("ni,ni->n", motion, axis))
    along = np.stack(parts, axis=1)
    found = np.isfinite(along).all(axis=1)
    if found.sum() < 2:
        raise ParameterError(
            f"The unloaded flanks of {gear} do not touch over phases {phase.min():.2f} to "
            f'{phase.max():.2f}. Set entrainment = "mesh_table" in the case.'
        )
    return np.stack(
        [np.interp(phase, places[found], along[found, axis]) for axis in range(2)], axis=1
    )


def dynamic_drive(
    parameters: HypoidAxleParameters, speed: float, torque: float, oil_temperature: float
) -> _PairDrive:
    """Return one pair's load and speed over a window of the running axle.

    Parameters
    ----------
    parameters
        Axle with its mesh table.
    speed, torque
        Of the pinion [rad/s], [N m]; negative torque coasts.
    oil_temperature
        [K].

    Notes
    -----
    The wheel's torque holds the mean speed. Where the motion does not repeat from window to
    window, as on a branch with separation, this is one of many.
    """
    axle = HypoidAxle(parameters)
    ratio, teeth = parameters.mesh.ratio, parameters.mesh.pinion_teeth
    axle.initialise(
        pinion_speed=speed,
        pinion_torque=torque,
        wheel_torque=torque * ratio,
        oil_temperature=oil_temperature,
    )
    h = 2.0 * np.pi / (teeth * speed * _STEPS)
    held = torque

    def step() -> Array:
        nonlocal held
        excess = float(axle.outputs[_SPEED]) - speed
        held += _HOLD * _RESET * excess * h
        axle.step(h, torque, ratio * (held + _HOLD * excess), oil_temperature)
        return axle.outputs

    window = 2.0 * np.pi * PAIRS / teeth
    for _ in range(int(_SETTLE / h)):
        outputs = step()
    first = np.ceil(outputs[_PHI] / window) * window
    rows = []
    while outputs[_PHI] < first + window:
        outputs = step()
        if outputs[_PHI] >= first:
            rows.append(outputs[[_PHI, _SPEED, _LOAD, _FILM, _MU]])
    angle, speeds, load, film, friction = np.array(rows[:-1]).T
    return _PairDrive(h * np.arange(angle.size), angle - first, speeds, load, film, friction)


def static_drive(parameters: HypoidAxleParameters, speed: float, torque: float) -> _PairDrive:
    """Return one pair's load over a window at constant speed, T/R_p times its share."""
    mesh = parameters.mesh
    count = PAIRS * _STEPS
    angle = 2.0 * np.pi * PAIRS / mesh.pinion_teeth * np.arange(count) / count
    contact = pair_contact(mesh, torque, phase_of(mesh, angle))
    load = abs(torque) / mesh.mean("R_p", torque) * contact.share
    unknown = np.full(count, np.nan)
    return _PairDrive(angle / speed, angle, np.full(count, speed), load, unknown, unknown)
