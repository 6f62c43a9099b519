"""Velocity of a hypoid pair's point of contact, in the axes of its contact ellipse."""

from __future__ import annotations

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_migration, contact_path
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_POSITIONS = 25  # of the path, smooth between


def contact_motion(gear: str, torque: float, phase: Array) -> Array:
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
