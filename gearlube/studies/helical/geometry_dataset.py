"""Geometry of a helical or spur pair as a labelled dataset.

Has the data of figures 4.1 to 4.6, 5.2 to 5.4, 5.17, 6.5 and 7.4 of Jamali 2015, for any pair.
"""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from gearlube.studies.helical.geometry_gaps import gap_variables
from gearlube.studies.helical.geometry_lines import (
    Variables,
    load_variables,
    path_variables,
    relieved_lines_always_touch,
    shown_line_variables,
)
from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.meshing_steps import gear_file_steps, line_at_position
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.units import rpm_to_rads

_STEPS, _LAST_STEP = (75, 300, 500), 575  # [jamali_2015 sec. 4.4]
_SMALLEST_SHARE = 0.16  # length over F/cos(beta_b) where his cycle begins and ends, sec. 4.4
_STEEL = contact_modulus(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)


def geometry_dataset(
    modified: ModifiedPair,
    *,
    torque: float,
    pinion_speed: float,
    lines: ArrayLike | None = None,
    steel_modulus: float = _STEEL,
) -> xr.Dataset:
    """Return lines, loads, kinematics, gaps and lay of a pair, each with units and long name.

    Parameters
    ----------
    modified : ModifiedPair
        Helical or spur pair with its flank modifications.
    torque : float
        On the pinion [N.m].
    pinion_speed : float
        [rad/s]
    lines : array_like, shape (n,)
        X of the contact lines whose gap and sliding are shown [m], on the face z = +W/2;
        the one in the middle of the list also shows crown, facets and, if it meets any, relief.
        Left out, three lie in the cycle where Jamali 2015 puts his.
    steel_modulus : float
        E* of the teeth [Pa]; only the half-width of the contact depends on it.

    Returns
    -------
    xr.Dataset
        Variables that have no meaning for the pair, such as the inclination of a spur pair's
        lines, are absent; the attribute `left_out` says which and why.

    Raises
    ------
    ParameterError
        Torque, speed or modulus not positive; a line outside the plane of contact.
    """
    check_positive("torque", torque, "N.m", "Torque drives the pinion.")
    check_positive("pinion_speed", pinion_speed, "rad/s", "Give the speed's magnitude.")
    check_positive("steel_modulus", steel_modulus, "Pa", "Steel has 113e9 Pa.")
    X = shown_lines(modified) if lines is None else np.asarray(lines, dtype=float)
    _check_lines(X, modified)
    coordinates: Variables = {}
    variables: Variables = {}
    for build in (
        load_variables(modified, torque),
        path_variables(modified.pair, pinion_speed),
        shown_line_variables(modified, X, pinion_speed),
        gap_variables(modified, X, torque, steel_modulus),
    ):
        variables |= build.variables
        coordinates |= build.coordinates
    p = modified.pair
    return xr.Dataset(
        variables,
        coords=coordinates,
        attrs={
            "name": p.name,
            "pinion_teeth": p.pinion_teeth,
            "gear_teeth": p.gear_teeth,
            "base_pitch": p.base_pitch,
            "base_helix_angle": p.base_helix_angle,
            "face_width": p.face_width,
            "transverse_contact_ratio": p.transverse_contact_ratio,
            "overlap_ratio": p.overlap_ratio,
            "torque": torque,
            "pinion_speed": pinion_speed,
            "left_out": " ".join(_left_out(modified, variables)),
        },
    )


def gear_file_geometry(
    file: HelicalGearFile, torque: float | None = None, pinion_speed: float | None = None
) -> xr.Dataset:
    """Return the dataset of a gear file.

    Parameters
    ----------
    file : HelicalGearFile
        Its [meshing_steps] name the contact lines that are shown; without them see `shown_lines`.
    torque, pinion_speed : float
        [N.m], [rad/s]; left out, those of the file's operation.

    Raises
    ------
    ParameterError
        Neither the file nor the call gives them.
    """
    given = file.operation
    if given is not None:
        torque = given.pinion_torque_n_m if torque is None else torque
        speed = rpm_to_rads(given.pinion_speed_rpm)
        pinion_speed = speed if pinion_speed is None else pinion_speed
    if torque is None or pinion_speed is None:
        raise ParameterError(
            f"torque and pinion_speed must be given for {file.name!r}, which has no [operation], "
            f"got {torque} N.m and {pinion_speed} rad/s. Add the section or give both."
        )
    lines = None
    if file.meshing_steps is not None and file.meshing_steps.shown:
        lines = gear_file_steps(file).line(np.array(file.meshing_steps.shown))
    return geometry_dataset(
        file.modified_pair(), torque=torque, pinion_speed=pinion_speed, lines=lines
    )


def shown_lines(modified: ModifiedPair) -> Array:
    """Return X of three lines [m]: early, in the middle and late in the meshing cycle.

    At 75, 300 and 500 parts of 575 of the cycle in which the unrelieved line is long enough, as
    [jamali_2015 sec. 4.4] chooses his; spur lines, long or absent, take the whole cycle.
    """
    pair = modified.pair
    lag = pair.face_width * math.tan(pair.base_helix_angle)
    low, high = modified.contact_start, modified.contact_end
    share = min(_SMALLEST_SHARE, 0.5 * (high - low) / lag) if lag > 0.0 else 1.0
    first = low - (1.0 - share) * lag - pair.pitch_point
    last = high - share * lag - pair.pitch_point
    part = np.array(_STEPS) / _LAST_STEP
    return line_at_position(first + part * (last - first), pair)


def _check_lines(X: Array, modified: ModifiedPair) -> None:
    plane = modified.pair.plane
    last = plane.D + plane.W * plane.sin_b / plane.cos_b
    if X.ndim != 1 or X.size == 0 or not ((plane.A < X) & (last > X)).all():
        raise ParameterError(
            f"lines must be a list of X within {plane.A:.6g} to {last:.6g} m, got {X}. "
            "Take them from line_at_position."
        )


def _left_out(modified: ModifiedPair, variables: Variables) -> list[str]:
    """Return a sentence for each group of variables that this pair lacks."""
    members = (modified.pinion, modified.gear)
    relief = any(member.tip_relief is not None for member in members)
    sentences = []
    helical = modified.pair.base_helix_angle > 0.0
    if not helical:
        sentences.append(
            "Spur pair: nothing varies along its contact lines but crown and slope, so their "
            "sliding, relief and lay are left out."
        )
    if not relief:
        sentences.append("No tip relief: what relief changes is left out.")
    elif not relieved_lines_always_touch(modified):
        sentences.append(
            "Tip relief leaves positions without unrelieved contact: loads shared by unrelieved "
            "length are left out."
        )
    if relief and helical and "relief_line" not in variables:
        sentences.append("No shown line meets tip relief: lines of equal relief are left out.")
    if all(member.crown is None for member in members):
        sentences.append("No crown: its forms are left out.")
    return sentences
