"""States of the flanks of a helical or spur pair over a mesh period, at one load."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.hertz import LARGEST_OVER_MEAN
from gearlube_core.dynamics.helical_pair.mesh.film_friction import FilmFriction
from gearlube_core.friction.flank_data import CONSISTENT
from gearlube_core.friction.flank_states import FlankStates, asperity_shares
from gearlube_core.friction.line_points import LinePoints, table_line_load
from gearlube_core.helical_geometry.contact_line import clip_line, line_count, line_position
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh

PHASES, STRIPS = 96, 96  # of a mesh period; equal parts of the face width
_LEAST_LOAD = 1e-6  # of the largest, above what rounding leaves


def helical_flank_states(
    pair: HelicalPair, mesh: LineMesh, film: FilmFriction, *,
    torque: float, speed: float, temperature: float, highest: Array | None = None,
) -> FlankStates:  # fmt: skip
    """Return the flanks of a pair at strips of its contact lines.

    Parameters
    ----------
    pair, mesh, film
        Helical or spur gears, their loaded contact lines as of `analyse_contact`; oil, roughness,
        law of friction and film model, whose oil temperature is not used.
    torque, speed, temperature
        Of the pinion, below 0 for the coast flanks [N.m]; its speed [rad/s]; oil [K].
    highest
        Highest pressure of each line in the loaded contact with that of edges [Pa], shape (torques
        of the mesh, phases, lines); None: that of Hertz.

    Raises
    ------
    ParameterError
        The torque is 0 or beyond that of the mesh, or another number is out of range.

    Notes
    -----
    Film, friction and their power are those of `FilmFriction.covered_cycle`. Each point of the
    plane of contact is passed once. Both sides of a tooth have one form: coast flanks bear as drive
    flanks do. Below the least torque of the mesh the load is divided as there. Places are along the
    face, and along the path of contact from A.

    Examples
    --------
    >>> import gearlube as gl
    >>> of = gl.studies.HelicalSettings(
    ...     file=gl.HelicalGearFile.named("he_2007"), pinion_torque=200.0, pinion_speed=100.0
    ... )
    >>> found = helical_flank_states(
    ...     of.file.helical_pair(), of.constant_mesh(), of.film(), torque=200.0, speed=100.0,
    ...     temperature=353.15,
    ... )
    >>> round(1e-9 * float(found.pressure.max()), 2)  # GPa
    0.77
    """
    check_positive("torque's magnitude", abs(torque), "N.m", "Leave out bins without load.")
    film = replace(film, oil_temperature=temperature)
    points, amount = _strips(pair), abs(torque)
    held = amount if mesh.torque.size == 1 else max(amount, float(mesh.torque[0]))
    line_load = table_line_load(points, mesh, held) * (amount / held)
    cycle = film.covered_cycle(points, line_load, speed, amount)
    constants = film.constants()
    loaded = line_load * points.length > _LEAST_LOAD * (line_load * points.length).max()
    w, length, mean = line_load[loaded], points.length[loaded], cycle.mean_pressure[loaded]
    film_ratio, half = cycle.film_ratio[loaded], 0.5 * cycle.sliding[loaded]
    phase, line, _ = np.nonzero(loaded)
    pressure = LARGEST_OVER_MEAN * mean
    table_pressure = pressure
    if highest is not None:
        level = min(int(np.searchsorted(mesh.torque, held)), mesh.torque.size - 1)
        table_pressure = highest[level, phase * mesh.phase.size // PHASES, line]
    plane = pair.plane
    return FlankStates(
        phase=phase / PHASES + line,
        load=w * length,
        pressure=pressure,
        line_load=w,
        semi_minor=0.5 * w / mean,
        semi_major=0.5 * length,
        film_ratio=film_ratio,
        friction=np.abs(cycle.coefficient[loaded]) * w * length,
        asperity_share=asperity_shares(
            w, mean, film_ratio, constants.surface, constants.solid, CONSISTENT
        ),
        outside=cycle.outside[loaded],
        sliding=2.0 * np.abs(half),
        pinion_speed=cycle.entrainment[loaded] + half,
        gear_speed=cycle.entrainment[loaded] - half,
        table_pressure=table_pressure,
        place=np.stack([points.z[loaded] + 0.5 * plane.W, points.x[loaded] - plane.A], axis=-1),
        major=np.tile([plane.cos_b, plane.sin_b], (w.size, 1)),
        share_of_time=1.0 / PHASES,
        bulk=temperature,
        carried=torque,
        bearings=None,
        strips=True,
    )


def face_load(pair: HelicalPair, states: FlankStates) -> tuple[float, float]:
    """Return greatest over mean line load: along the face over a mesh period, and anywhere [-].

    Along the face the load of a place counts over what even lines carry there at the same phases.
    """
    length, face = _strips(pair).length, states.place[:, 0] / pair.face_width
    strip = np.minimum((face * STRIPS).astype(int), STRIPS - 1)
    mean = states.load.sum() / PHASES / length.sum(axis=(1, 2))
    even = (mean[:, None] * length.sum(axis=1)).sum(axis=0)
    along = np.bincount(strip, states.load, minlength=STRIPS) / even
    return float(along.max()), float(states.line_load.max() * length.sum() / states.load.sum())


def _strips(pair: HelicalPair) -> LinePoints:
    """Return the middles of the strips that equal parts of the face cut from all lines."""
    plane = pair.plane
    lines, edges = line_count(plane), np.linspace(-0.5, 0.5, STRIPS + 1) * plane.W
    phase = (np.arange(PHASES) + 0.5) / PHASES
    X = np.array([[line_position(one, i, plane) for i in range(lines)] for one in phase])
    low, high = np.array([[clip_line(x, plane)[:2] for x in row] for row in X]).transpose(2, 0, 1)
    low, high = low[..., None], high[..., None]
    start, end = np.maximum(edges[:-1], low), np.minimum(edges[1:], high)
    z, width = 0.5 * (start + end), np.maximum(end - start, 0.0)
    x = X[..., None] - (0.5 * plane.W - z) * plane.sin_b / plane.cos_b
    inside = width > 0.0
    return LinePoints(
        pair=pair,
        phase=phase,
        x=np.where(inside, x, plane.P),
        z=z,
        length=width / plane.cos_b,
        station=np.where(inside, (z - low) / np.maximum(high - low, 1e-12), 0.0),
    )
