"""Load and film of every roller in the frames of an animation."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube.studies.runup.animation.frames import Frames
from gearlube.studies.runup.rollers import RINGS, Variables
from gearlube_core.arrays import Array
from gearlube_core.bearings.bearing_type import ShaftMotion
from gearlube_core.bearings.parameters import BearingParameters
from gearlube_core.bearings.raceway_drag import steady_load, steady_rollers
from gearlube_core.bearings.roller_loads import roller_films, roller_loads
from gearlube_core.bearings.roller_nodes import races_of, roller_film
from gearlube_core.dynamics.hypoid_axle.bearing_drag import SOLVED_FILMS
from gearlube_core.dynamics.hypoid_axle.mesh_force import reference_frequency
from gearlube_core.dynamics.hypoid_axle.rhs import gear_motion, pinion_motion
from gearlube_core.dynamics.hypoid_axle.state import W_P
from gearlube_core.oil.lubricant import LubricantState, lubricant_state

FORMULA = "Mostofi and Gohar 1983"
SOLVED = "solved films"
_TURN = 2.0 * math.pi


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
    oil = lubricant_state(p.oil, oil_temperature)
    most = max(int(one.n_rollers) for one in bearings)
    shape = (frames.time.size, len(RINGS), most)
    load, film, angle = (np.full(shape, np.nan) for _ in range(3))
    law = film_law(frames)
    solved = frames.axle.parameters.roller_model() if law == SOLVED else None
    for k, s in enumerate(frames.states):
        f_ref = reference_frequency(p.mesh, float(s[W_P]))
        for shaft, motion in enumerate((pinion_motion(s), gear_motion(s))):
            bearing = bearings[shaft]
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
