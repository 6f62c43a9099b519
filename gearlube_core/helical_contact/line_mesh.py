"""Tangent stiffness density and offset along contact lines from a loaded mesh period."""

from __future__ import annotations

import math

import numpy as np

from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.mesh_cycle import CycleSettings
from gearlube_core.helical_geometry.contact_line import clip_line, line_position, segment_length
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.storage.result_store import Record


def line_mesh(modified: ModifiedPair, settings: CycleSettings, cycle: Record) -> LineMesh:
    """Return the line mesh of a loaded mesh period.

    k = d(w)/d(delta),  e = delta - w/k,  delta = r_bp cos(beta_b) (Theta - Theta_0)

    Parameters
    ----------
    modified : ModifiedPair
    settings : CycleSettings
        Those of `cycle`.
    cycle : Record
        From `run_cycle`.

    Raises
    ------
    ParameterError
        Load that no line of the plane of contact can take over.

    Notes
    -----
    Theta_0 is the least rotation to first touch of all phases. k is the change of the line load
    there while the gears close evenly: what one point's closing does to its neighbours is counted
    at the neighbours. Load and stiffness at corners, outside the plane of contact, are given to
    all stations of the phase in proportion, so that the sums over all lines are those of the
    loaded contact. Where a station carries nothing, k = 0 and e = delta.
    """
    pair, plane = modified.pair, modified.pair.plane
    arm = pair.pinion_base_radius * math.cos(pair.base_helix_angle)
    start = float(cycle["unloaded_rotation"].min())
    approach = arm * (cycle["rotation"] - start)
    lines = slice(1, -1)  # those that the plane of contact may hold
    count = cycle["line_load"].shape[2] - 2
    length = np.array(
        [
            [segment_length(clip_line(line_position(phase, i, plane), plane), plane)
             for i in range(count)]
            for phase in settings.phases
        ]
    )  # fmt: skip
    part = length[:, None, :, None] / settings.stations
    load, density = cycle["line_load"][:, :, lines], cycle["density"][:, :, lines]
    inside = arm * (load * part).sum(axis=(2, 3))
    stiff = arm**2 * (density * part).sum(axis=(2, 3))
    if not (inside > 0.5 * np.array(settings.torques)).all():
        raise ParameterError(
            "More than half of a torque is carried outside the plane of contact. Lower the "
            "torques, or relieve the tips."
        )
    load = load * (np.array(settings.torques) / inside)[..., None, None]
    density = density * (cycle["tangent"] / stiff)[..., None, None]
    closed = np.broadcast_to(approach[..., None, None], load.shape)
    offset = closed - np.divide(load, density, out=np.zeros_like(load), where=density > 0.0)
    offset = np.where((density > 0.0) & (load > 0.0), offset, closed)
    density = np.where(load > 0.0, density, 0.0)
    corner = 1.0 - inside / np.array(settings.torques)
    return LineMesh(
        name=pair.name,
        source="loaded tooth contact",
        pinion_teeth=pair.pinion_teeth,
        gear_teeth=pair.gear_teeth,
        base_pitch=pair.base_pitch,
        torque=np.array(settings.torques),
        phase=settings.phases,
        station=settings.station,
        density=density.swapaxes(0, 1),
        offset=offset.swapaxes(0, 1),
        provenance={
            "density": "inferred: tangent of the loaded contact under even closing; up to "
            f"{100.0 * corner.max():.2g} % corner contact spread over all lines",
            "offset": "inferred: from first contact of the mesh cycle",
        },
    )
