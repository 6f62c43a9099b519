"""Stations across the face of a mesh, from the loaded contact of a helical pair."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import clip_line, line_position
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.helical_geometry.tooth_limits import involute
from gearlube_core.mesh_table.line_mesh import LineMesh

_SAME_PITCH = 1e-6  # relative, of pairs that are one


def contact_fields(
    pair: HelicalPair,
    mesh: LineMesh,
    torque: float,
    *,
    stations: int = 9,
    right_hand: bool = False,
    drives_forward: bool = True,
) -> dict[str, Any]:
    """Return fields of a `GearMesh`: geometry, stiffness and gaps of stations under a load.

    K_i = sum k l,  W_i = sum k (delta - e) l,  e_i = delta - W_i/K_i

    sums over the pieces l of all contact lines on the face of station i.

    Parameters
    ----------
    pair : HelicalPair
        Gear 1 is the pinion.
    mesh : LineMesh
        Of the loaded contact of this pair.
    torque : float
        Of the pinion, for which stiffness and gaps are taken [N.m], within the levels of the mesh.
    stations : int
        Across the face, 1 to 99.
    right_hand, drives_forward : bool
        As in `GearMesh`: they say at which end of the face contact begins.

    Returns
    -------
    dict
        Fields of `GearMesh`, in SI units. `gap` is where the springs of the stations begin to
        carry, counted from the first contact without load; the bending of the teeth is in the
        stiffness alone.

    Raises
    ------
    ParameterError
        The mesh is of another pair, has no contact lines of its own, or a number is out of range.

    Notes
    -----
    Springs are those of the tangent at the load: load, transmission error and stiffness there are
    those of the loaded contact, at the phases of the mesh exactly. Away from that load the contact
    grows or shrinks, which they do not follow. Stations are not coupled as teeth are, which bend
    as a whole: a tilt moves the load along the face up to 9 % less than in the loaded contact of
    the gears of [he_2007].
    Where a station carries nothing at the load, it has the stiffness of the next higher load at
    which it does. The coast flanks have the numbers of the drive flanks.

    Examples
    --------
    >>> from gearlube_core.helical_geometry.gear_file import HelicalGearFile
    >>> from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
    >>> pair = HelicalGearFile.named("he_2007").helical_pair()
    >>> fields = contact_fields(pair, named_line_mesh("he_2007"), 226.0)
    >>> round(1e-6 * fields["stiffness"]), len(fields["gap"])  # N/um along the normal of the teeth
    (853, 9)
    """
    _check(pair, mesh, torque, stations)
    length = _lengths(pair, mesh, stations)
    levels, density = mesh.torque, mesh.density
    whole = density * length.sum(axis=3)
    force = levels / (pair.pinion_base_radius * math.cos(pair.base_helix_angle))
    carried = force[:, None] + (whole * mesh.offset).sum(axis=(2, 3))
    closed = carried / whole.sum(axis=(2, 3))  # (levels, phases)
    pressed = np.maximum(closed[:, :, None, None] - mesh.offset, 0.0)
    stiffness = np.einsum("lnis,nisj->lnj", density, length)
    load = np.einsum("lnis,nisj->lnj", density * pressed, length)
    high = min(int(np.searchsorted(levels, torque)), levels.size - 1)
    low = max(high - 1, 0)
    share = (torque - levels[low]) / (levels[high] - levels[low]) if high > low else 1.0
    k, w, delta = (
        (1.0 - share) * one[low] + share * one[high] for one in (stiffness, load, closed)
    )
    for level in range(high, levels.size):
        k = np.where(k > 0.0, k, stiffness[level])
    gap = delta[:, None] - np.divide(w, k, out=np.zeros_like(w), where=k > 0.0)
    if right_hand != drives_forward:  # the mirror image of the frame of contact lines
        k, gap = k[:, ::-1], gap[:, ::-1]
    mean = float(k.sum(axis=1).mean())
    start = _pitch_phase(pair)
    working = pair.working_pressure_angle
    shifts = involute(pair.transverse_pressure_angle) - involute(working)
    turned = pair.tooth_thickness[0] / pair.pinion_reference_radius + 2.0 * shifts
    return {
        "teeth_1": pair.pinion_teeth,
        "teeth_2": pair.gear_teeth,
        "normal_module": pair.normal_module,
        "normal_pressure_angle": pair.normal_pressure_angle,
        "helix_angle": pair.helix_angle,
        "centre_distance": pair.centre_distance,
        "face_width": pair.face_width,
        "backlash": pair.backlash,
        "tooth_thickness": turned * pair.pinion_teeth / (2.0 * math.pi),
        "right_hand": right_hand,
        "drives_forward": drives_forward,
        "stations": stations,
        "stiffness": mean,
        "station_stiffness": _rows(k * (stations / mean), start),
        "gap": _rows(gap, start),
    }


def _check(pair: HelicalPair, mesh: LineMesh, torque: float, stations: int) -> None:
    check_within("stations", stations, 1, 99)
    own = pair.pinion_teeth, pair.gear_teeth
    same = own == (mesh.pinion_teeth, mesh.gear_teeth)
    if not same or not math.isclose(pair.base_pitch, mesh.base_pitch, rel_tol=_SAME_PITCH):
        raise ParameterError(
            f"The line mesh {mesh.name} must be that of {pair.name} with {own[0]}/{own[1]} teeth "
            f"and a base pitch of {1e3 * pair.base_pitch:.6g} mm, got {mesh.pinion_teeth}/"
            f"{mesh.gear_teeth} teeth and {1e3 * mesh.base_pitch:.6g} mm. Name the file that "
            "`gearlube helical` wrote for these gears."
        )
    if mesh.phase.size < 2:
        raise ParameterError(
            f"The line mesh {mesh.name} must be of a loaded contact, got one constant stiffness. "
            "Let `gearlube helical` write one, or give the numbers of a gear_mesh."
        )
    least, most = float(mesh.torque[0]), float(mesh.torque[-1])
    cure = "Take one between, or run `gearlube helical` with other --torques."
    check_within("contact torque", torque, least, most, "N.m", cure)


def _lengths(pair: HelicalPair, mesh: LineMesh, stations: int) -> Array:
    """Return how much of each part of a line is on each station [m].

    Shape (phases, lines, parts, stations).
    """
    plane, parts = pair.plane, mesh.station.size
    edges = np.linspace(-0.5, 0.5, stations + 1) * pair.face_width
    found = np.zeros((mesh.phase.size, mesh.lines, parts, stations))
    for n, phase in enumerate(mesh.phase):
        for line in range(mesh.lines):
            segment = clip_line(line_position(float(phase), line, plane), plane)
            ends = np.linspace(segment.z_low, segment.z_high, parts + 1)
            high, low = ends[1:, None], ends[:-1, None]
            common = np.minimum(high, edges[1:]) - np.maximum(low, edges[:-1])
            found[n, line] = np.maximum(common, 0.0) / plane.cos_b
    return found


def _pitch_phase(pair: HelicalPair) -> float:
    """Return the phase of contact lines at which one crosses the pitch line at mid-face."""
    plane = pair.plane
    X = plane.P + 0.5 * plane.W * plane.sin_b / plane.cos_b
    return (X - plane.A) / plane.pitch


def _rows(values: Array, start: float) -> tuple[tuple[float, ...], ...]:
    """Return a row for each station that begins at a phase, of values of shape (phases, stations).

    It has one or two more numbers than phases, so that its waves pass through all values.
    """
    count = len(values)
    waves = np.fft.rfft(values, axis=0)
    if count % 2 == 0:
        waves[-1] *= 0.5  # half of it stands for the negative frequency
    waves *= np.exp(2j * math.pi * start * np.arange(len(waves)))[:, None]
    size = 2 * (count // 2) + 1
    rows = np.fft.irfft(waves, size, axis=0) * (size / count)
    return tuple(tuple(row) for row in rows.T.tolist())
