"""The dataset of an animation: contacts of the flanks and rollers of the bearings over frames."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.runup.animation.frames import PERIODS, Frames, ramp_frames
from gearlube.studies.runup.rollers import RINGS, Variables
from gearlube.studies.runup.settings import RunupSettings
from gearlube_core import __version__
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.followed_shaft import SOLVED_FILMS
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.raceway_drag import steady_load, steady_rollers
from gearlube_core.bearings.roller_loads import roller_films, roller_loads
from gearlube_core.bearings.roller_nodes import races_of, roller_film
from gearlube_core.checks import check_within
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    PHI_P,
    SIDE,
    gear_motion,
    pinion_motion,
)
from gearlube_core.dynamics.hypoid_mesh.flank_outputs import FLANK_QUANTITIES
from gearlube_core.dynamics.hypoid_mesh.mesh_force import reference_frequency
from gearlube_core.errors import ParameterError
from gearlube_core.mesh_table.kernels import load_bracket, pair_node
from gearlube_core.mesh_table.table import PAIRS, TOOTH_UNITS, MeshTable
from gearlube_core.oil.lubricant_state import LubricantState
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.atomic_file import read_dataset, write_compressed_dataset
from gearlube_core.units import rads_to_rpm

FORMULA = "Mostofi and Gohar 1983"
SOLVED = "solved films"
_TURN = 2.0 * math.pi
_LARGEST_OVER_MEAN = 1.5  # pressure of a Hertz ellipse
_OF_TABLE = ("R_x", "R_y")

logger = logging.getLogger(__name__)

FOLDER = "animation"
_AXES = ("x", "y", "z")

# name: (unit, description)
QUANTITIES: Mapping[str, tuple[str, str]] = {
    "frame_time": ("s", "time since the first frame"),
    "mesh_phase": ("1", "mesh periods since the first frame"),
    "pinion_speed": ("rad s-1", "speed of the pinion"),
    "dte": ("m", "dynamic transmission error"),
    "mesh_force": ("N", "mesh force, below 0 on the coast flanks"),
    "side": ("1", "1: drive flanks carry, -1: coast flanks, 0: the teeth are apart"),
    "flank_load": ("N", "normal force of a tooth pair"),
    "flank_film": ("m", "central film thickness of a tooth pair"),
    "flank_film_ratio": ("1", "film thickness over roughness"),
    "flank_friction": ("1", "friction coefficient of a tooth pair"),
    "flank_temperature": ("K", "temperature of the film"),
    "flank_pressure": ("Pa", "largest Hertz pressure of a tooth pair"),
    "flank_centre": ("m", "centre of force on the drawn gear tooth, from toe and root line"),
    "flank_minor": ("m", "minor semi-axis of the contact as drawn on the gear tooth"),
    "flank_major": ("m", "major semi-axis of the contact as drawn on the gear tooth"),
    "ring": ("1", "bearing: 1 and 2 of the pinion, 3 and 4 of the gear"),
    "ring_force": ("N", "force of a bearing on its shaft"),
    "roller_load": ("N", "load of a roller"),
    "roller_film": ("m", "film between roller and race"),
    "roller_angle": ("rad", "angle of a roller about the shaft, from r1 to r2"),
}


def film_law(frames: Frames) -> str:
    """Return where the films of the rollers are from; "" where the bearings have none."""
    p = frames.axle.kernel_parameters
    if p.drag == SOLVED_FILMS:
        return SOLVED
    bearings: tuple[Any, ...] = (p.bearing_p, p.bearing_g)
    return FORMULA if all(b.film_constant > 0.0 for b in bearings) else ""


def roller_variables(frames: Frames, oil_temperature: float) -> Variables:
    """Return load, film and angle of every roller, and the forces of the bearings.

    The kernels of the axle's bearings are evaluated at its states. Empty for bearings without
    rollers. Rollers that a bearing has fewer than another are NaN; a film is NaN without load.
    """
    p = frames.axle.kernel_parameters
    bearings: list[Any] = [
        b for b in (p.bearing_p, p.bearing_g) if isinstance(b, BearingParameters)
    ]
    if len(bearings) < 2:
        return {}
    oil = frames.axle.parameters.oil.state(oil_temperature)
    most = max(int(one.n_rollers) for one in bearings)
    shape = (frames.time.size, len(RINGS), most)
    load, film, angle = (np.full(shape, np.nan) for _ in range(3))
    law = film_law(frames)
    solved = frames.axle.parameters.roller_model() if law == SOLVED else None
    for k, s in enumerate(frames.states):
        for shaft, motion in enumerate((pinion_motion(s), gear_motion(s))):
            bearing, ratio = bearings[shaft], p.ratio if shaft else 1.0
            f_ref = reference_frequency(p.mesh, ratio * motion.speed)
            number = int(bearing.n_rollers)
            places = motion.cage_angle + _TURN * np.arange(number) / number
            for end, side in enumerate((1.0, -1.0)):
                ring = 2 * shaft + end
                here = load[k, ring, :number]
                roller_loads(motion, f_ref, oil.eta0, oil.alpha, bearing, side, here)
                film[k, ring, :number] = _films(motion, oil, bearing, side, solved)
                angle[k, ring, :number] = np.mod(places, _TURN)
    film[~(load > 0.0) | ~(film > 0.0)] = np.nan
    dims = ("frame", "ring", "roller")
    forces = [
        np.stack([frames.output(f"bearing[{ring}].force.{axis}") for axis in "xyz"], axis=1)
        for ring in RINGS
    ]
    found: Variables = {
        "roller_load": (dims, load),
        "roller_angle": (dims, angle),
        "ring": ("ring", np.array(RINGS)),
        "ring_force": (("frame", "ring", "axis"), np.stack(forces, axis=1)),
    }
    return found | ({"roller_film": (dims, film)} if law else {})


def _films(
    motion: ShaftMotion, oil: LubricantState, bearing: Any, side: float, solved: Array | None
) -> Array:
    """Return the film of every roller of a bearing [m]; 0 without load."""
    films = np.zeros(int(bearing.n_rollers))
    if solved is None:
        roller_films(motion, oil.eta0, oil.alpha, bearing, side, films)
        return films
    speed = bearing.film_speed_radius * abs(motion.speed)
    rollers, races = steady_rollers(motion, oil, bearing), races_of(oil, bearing)
    for i in range(films.size):
        load = steady_load(rollers, side, i, bearing)
        if load > 0.0 and speed > 0.0:
            of_roller = roller_film(load / bearing.roller_length, speed, races, solved)
            films[i] = math.exp(of_roller.log_film)
    return films


def animation_dataset(settings: RunupSettings, time: float) -> xr.Dataset:
    """Return flanks and rollers over two mesh periods from `time` of a ramp [s] on.

    Parameters
    ----------
    settings : RunupSettings
        Of the ramp.
    time : float
        Since the ramp began, within the ramp [s].

    Returns
    -------
    xarray.Dataset
        Over 48 frames: `flank_load`, `flank_film`, `flank_friction` and others over (frame, pair),
        NaN without load; `flank_centre`, `flank_minor` and `flank_major` if the mesh table knows
        the places on the tooth; `roller_load` and `roller_angle` over (frame, ring, roller) if the
        bearings have rollers, `roller_film` if they have films; `ring_force`, `mesh_force`.

    Raises
    ------
    ParameterError
        The time is outside the ramp.
    GearLubeError
        The axle refused.

    Examples
    --------
    >>> animation_dataset(settings, time=3.0)["flank_load"].sum("pair")  # doctest: +SKIP
    """
    check_within("time", time, 0.0, settings.duration, "s", "It is that of the ramp.")
    frames = ramp_frames(settings, time)
    axle = settings.car_axle.axle
    turned = frames.output("pinion.angle") * axle.mesh.pinion_teeth / (2.0 * np.pi)
    speed = frames.output("pinion.speed")
    size = axle.mesh.tooth_size or ()
    dataset = xr.Dataset(
        {
            "frame_time": ("frame", frames.time),
            "mesh_phase": ("frame", turned - round(float(turned[0]))),
            "pinion_speed": ("frame", speed),
            "dte": ("frame", frames.output("mesh.dte")),
            **_flank_variables(frames),
            **roller_variables(frames, settings.oil_temperature),
        },
        attrs={
            "title": f"Flanks and rollers in a {settings.name} of a lubricated hypoid axle",
            "study": "runup animation",
            "ramp": settings.name,
            "gearlube_version": __version__,
            "axle": settings.car_axle.name,
            "axle_source": settings.car_axle.source,
            "mesh_table": axle.mesh.name,
            "oil": axle.oil.name,
            "oil_temperature": float(settings.oil_temperature),
            "pinion_teeth": int(axle.mesh.pinion_teeth),
            "gear_teeth": int(axle.mesh.gear_teeth),
            "mesh_periods": PERIODS,
            "mean_pinion_speed": float(speed.mean()),
            "pinion_torque": frames.torque,
            "ramp_time": frames.ramp_time,
            "roller_film_law": film_law(frames),
            **dict(zip(("tooth_width", "tooth_height"), size, strict=False)),
        },
    )
    for name, dimension in (("axis", _AXES), ("tooth_axis", ("along", "up"))):
        if name in dataset.dims:
            dataset = dataset.assign_coords({name: list(dimension)})
    for name in map(str, dataset.variables):
        if name in QUANTITIES:
            unit, text = QUANTITIES[name]
            dataset[name].attrs |= {"units": unit, "long_name": text}
    return dataset


def animate_ramp(
    settings: RunupSettings,
    ramp: xr.Dataset,
    *,
    speed: float | None = None,
    folder: Path | str | None = None,
    progress: Progress = no_progress,
) -> xr.Dataset:
    """Return `animation_dataset` at one speed of a finished ramp; write it as NetCDF.

    Parameters
    ----------
    settings : RunupSettings
        Of the ramp.
    ramp : xarray.Dataset
        Of `run_runup` with these settings.
    speed : float, optional
        Of the pinion, within the ramp [rad/s]. Default: where a mesh order of the bearing forces is
        largest.
    folder : path, optional
        Folder of results; the file is animation/runup.nc or animation/coastdown.nc there.
    progress : callable
        Called with the share that is done and a sentence.

    Raises
    ------
    ParameterError
        The speed is outside the ramp, or none is given and the results have no loudest speed.
    GearLubeError
        The axle refused.

    Examples
    --------
    >>> moving = animate_ramp(settings, ramp, speed=200.0, folder="my_runup")  # doctest: +SKIP
    """
    if speed is None:
        if "shape_speed" not in ramp:
            raise ParameterError(
                "The results of the ramp must say where the bearing forces are largest "
                "(shape_speed), but they do not: they are of an earlier version. Give a speed, or "
                "run the ramp again."
            )
        block = int(np.argmin(np.abs(ramp["block_speed"].values - float(ramp["shape_speed"]))))
        time = float(ramp["block_time"][block])
    else:
        check_speed(settings, speed)
        time = (speed - settings.start_speed) / settings.ramp.acceleration
    time = min(max(time, 0.0), settings.duration)
    progress(0.0, "flanks and rollers in motion")
    mesh = settings.car_axle.axle.mesh
    if not mesh.has_tooth_places:
        logger.warning(
            "The mesh table %s lacks the places of contact on the tooth, so the animation "
            "shows no tooth. Run `gearlube contact` again for a table that has them.",
            mesh.name,
        )
    dataset = animation_dataset(settings, time)
    if folder is not None:
        path = animation_file(folder, settings.name)
        path.parent.mkdir(parents=True, exist_ok=True)
        write_compressed_dataset(dataset, path)
    progress(1.0, "flanks and rollers in motion")
    return dataset


def check_speed(settings: RunupSettings, speed: float, name: str = "The speed to animate") -> None:
    """Refuse a speed of the pinion [rad/s] that the ramp does not pass; errors speak of rpm.

    Raises
    ------
    ParameterError
    """
    ends = sorted(rads_to_rpm(one) for one in (settings.start_speed, settings.end_speed))
    within = "It is a speed of the pinion that the ramp passes."
    low, high = (round(end, 6) for end in ends)  # an end given in rpm is within
    check_within(name, round(rads_to_rpm(speed), 6), low, high, "rpm", within)


def animation_file(folder: Path | str, ramp: str) -> Path:
    """Return the path of the animation's dataset; `ramp` is run-up or coast-down."""
    return Path(folder) / FOLDER / f"{ramp.replace('-', '')}.nc"


def load_animation(path: Path | str) -> xr.Dataset:
    """Read the dataset of an animation.

    Examples
    --------
    >>> load_animation("gearlube_runup/animation/runup.nc")["roller_load"]  # doctest: +SKIP
    """
    return read_dataset(Path(path))


def _flank_variables(frames: Frames) -> Variables:
    """Return load, film, friction, pressure and place of every tooth pair; NaN without load.

    Loads, films, friction and temperatures are outputs of the axle. Sizes and pressures are those
    of Hertz' ellipse with the radii of the mesh table, which the axle's flanks have too. Places
    are those of its loaded contact, left out where the table has none.
    """
    axle = frames.axle
    mesh = axle.parameters.mesh
    shape = (frames.time.size, PAIRS)
    found = {
        quantity: np.stack(
            [frames.output(f"flank[{pair}].{quantity}") for pair in range(1, PAIRS + 1)], axis=1
        )
        for quantity in FLANK_QUANTITIES
    }
    loaded = found["load"] > 0.0
    for quantity in FLANK_QUANTITIES:
        found[quantity][~loaded] = np.nan
    wanted = (*_OF_TABLE, *(TOOTH_UNITS if mesh.has_tooth_places else ()))
    at = {key: np.full(shape, np.nan) for key in wanted}
    axes = np.full((*shape, 3), np.nan)
    modulus = contact_modulus(axle.parameters.solid, axle.parameters.solid)
    for k, pair in zip(*np.nonzero(loaded), strict=True):
        for key, value in _window_values(mesh, frames.states[k], int(pair), wanted).items():
            at[key][k, pair] = value
        axes[k, pair] = hertz_ellipse(
            at["R_x"][k, pair], at["R_y"][k, pair], modulus, found["load"][k, pair]
        )
    dims = ("frame", "pair")
    force = frames.output("mesh.force")
    variables: Variables = {
        "mesh_force": ("frame", force),
        "side": ("frame", np.sign(force)),
        "flank_load": (dims, found["load"]),
        "flank_film": (dims, found["film_thickness"]),
        "flank_film_ratio": (dims, found["film_ratio"]),
        "flank_friction": (dims, found["friction_coefficient"]),
        "flank_temperature": (dims, found["temperature"]),
        "flank_pressure": (dims, _LARGEST_OVER_MEAN * axes[..., 2]),
    }
    if mesh.has_tooth_places:
        pairs = (("tooth_along", "tooth_up"), ("minor_along", "minor_up"))
        centre, minor = (np.stack([at[key] for key in two], -1) for two in pairs)
        major = np.stack([at["major_along"], at["major_up"]], -1)
        drawn = (*dims, "tooth_axis")
        variables |= {
            "flank_centre": (drawn, centre),
            "flank_minor": (drawn, minor * axes[..., :1]),
            "flank_major": (drawn, major * axes[..., 1:2]),
        }
    return variables


def _window_values(
    mesh: MeshTable, state: Array, pair: int, keys: tuple[str, ...]
) -> dict[str, float]:
    """Return windows of the mesh table for one tooth pair, as the axle reads them in a state."""
    bracket = load_bracket(
        float(state[LOAD_TORQUE]), float(state[SIDE]), mesh.torque, mesh.torque.size
    )
    node, t = pair_node(mesh.nodes, float(mesh.pinion_teeth), float(state[PHI_P]), pair)
    after = (node + 1) % mesh.nodes
    found = {}
    for key in keys:
        low, high = (
            (1.0 - t) * mesh.windows[key][level, node] + t * mesh.windows[key][level, after]
            for level in (bracket.lower, bracket.upper)
        )
        found[key] = float(low + bracket.weight * (high - low))
    return found
