"""Contacts of all tooth pairs in the frames of an animation, and where they are on the tooth."""

from __future__ import annotations

import numpy as np

from gearlube.studies.runup.animation.frames import Frames
from gearlube.studies.runup.rollers import Variables
from gearlube_core.arrays import Array
from gearlube_core.contact.elliptical_hertz import hertz_ellipse
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.hypoid_axle.flank_outputs import FLANK_QUANTITIES
from gearlube_core.dynamics.hypoid_axle.state import LOAD_TORQUE, PHI_P, SIDE
from gearlube_core.mesh_table.kernels import load_bracket, pair_node
from gearlube_core.mesh_table.table import PAIRS, TOOTH_UNITS, MeshTable

_LARGEST_OVER_MEAN = 1.5  # pressure of a Hertz ellipse
_OF_TABLE = ("R_x", "R_y")


def flank_variables(frames: Frames) -> Variables:
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
        for key, value in window_values(mesh, frames.states[k], int(pair), wanted).items():
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


def window_values(
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
