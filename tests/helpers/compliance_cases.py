"""Synthetic bodies for the compliance tests: a box and a tapered spiral tooth."""

from __future__ import annotations

import math

import numpy as np
from skfem import MeshHex

from gearlube_core.tooth_compliance.tooth_geometry import ToothGeometry
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity, ToothMesh

COARSE = MeshDensity(profile=4, lengthwise=6, thickness=2, growth=1.6, fillet=3, slot=1, rim=2)


def box_mesh(x: np.ndarray, y: np.ndarray, z: np.ndarray, profile: int) -> ToothMesh:
    """Return a box whose left flank is the face x = x[0] over the first `profile` rows of y.

    Tip at y[0], held at y[-1]; x, y, z must rise.
    """
    tensor = MeshHex.init_tensor(*(np.arange(float(len(q))) for q in (x, y, z)))
    logical = MeshHex(tensor.p, np.ascontiguousarray(tensor.t[::-1]))
    index = np.rint(logical.p).astype(int)

    def uniform(count: int) -> np.ndarray:
        return np.linspace(0.0, 1.0, count)

    points = np.stack([x[index[0]], y[index[1]], z[index[2]]])
    return ToothMesh(
        MeshHex(points, logical.t),
        logical,
        len(x) - 1,
        len(y) - 1,
        uniform(profile + 1),
        uniform(len(z)),
    )


def spiral_tooth(
    *,
    teeth: int = 36,
    outer_radius: float = 82e-3,
    face_width: float = 30e-3,
    pitch_angle: float = math.radians(60.0),
    spiral_angle: float = math.radians(30.0),
    height: float = 7.0e-3,
    pressure_angle: float = math.radians(20.0),
    thickness_ratio: float = 0.5,
    slot_depth: float = 1.2e-3,
    base_depth: float = 15e-3,
    neighbour_pitches: float = 0.0,
    rows: int = 17,
    stations: int = 25,
) -> ToothGeometry:
    """Return a bevel gear tooth of uniform depth on a logarithmic spiral."""
    s = np.linspace(0.0, 1.0, rows)[:, None]
    t = np.linspace(0.0, 1.0, stations)[None, :]
    radius = outer_radius - (1.0 - t) * face_width * math.sin(pitch_angle)
    cone = radius / math.sin(pitch_angle)
    mean = cone[0, stations // 2]
    # logarithmic spiral: constant angle between the tooth and the cone's generator
    twist = math.tan(spiral_angle) * np.log(cone / mean) / math.sin(pitch_angle)
    pitch_length = 2.0 * math.pi * radius / teeth
    above = (s - 0.45) * height
    half = 0.5 * thickness_ratio * pitch_length - above * math.tan(pressure_angle)
    r = radius + above * math.cos(pitch_angle)
    z = cone * math.cos(pitch_angle) - above * math.sin(pitch_angle)
    flanks = {}
    for name, side in (("left", -1.0), ("right", 1.0)):
        angle = twist + side * half / radius
        flanks[name] = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)
    inward = np.stack(
        [
            -math.cos(pitch_angle) * np.cos(twist[0]),
            -math.cos(pitch_angle) * np.sin(twist[0]),
            math.sin(pitch_angle) * np.ones(stations),
        ],
        axis=-1,
    )
    return ToothGeometry(
        left=flanks["left"],
        right=flanks["right"],
        inward=inward,
        axis_point=np.zeros(3),
        axis_direction=np.array([0.0, 0.0, 1.0]),
        teeth=teeth,
        slot_depth=slot_depth,
        base_depth=base_depth,
        neighbour_pitches=neighbour_pitches,
    )
