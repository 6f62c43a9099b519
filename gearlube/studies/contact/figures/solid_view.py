"""The pair in three dimensions, turning through a mesh period, with the pressure on the gear."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from scipy.spatial.transform import Rotation

from gearlube.report.moving import steering
from gearlube.studies.contact.figures.flank_maps import inside_pressure
from gearlube_core.arrays import Array, Indices
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.placement import Placement
from gearlube_core.hypoid_geometry.flank.flank import Role
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import gear_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

_ROWS, _COLUMNS = 4, 6  # of a drawn flank
_FRAMES = 8  # of a mesh period, at most
_LIFT = 1.5e-4  # m, of the pressure over the gear flank, so that it is seen
_DISTANCE, _DOWN = 0.6, -1.0  # of the eye
_STEEL, _PINION = "#C9CED3", "#7FA8C9"
_LIGHT = {"ambient": 0.45, "diffuse": 0.8, "specular": 0.25, "roughness": 0.5}


def solid_view(dataset: xr.Dataset) -> Any:
    """Return pinion and gear in mesh with the pressure of the drive flanks at the highest torque.

    A slider turns the pair through a mesh period. Flanks are drawn coarse, the pressure is in the
    cells of the analysis.
    """
    import plotly.graph_objects as go

    file = HypoidGearFile.model_validate_json(dataset.attrs["gear_file"])
    pair = FlankPair.from_file(file, "drive")
    part = dataset.sel(side="drive").isel(torque=-1)
    solids = [gear_solid(Tooth.from_file(file, role), _ROWS, _COLUMNS) for role in _ROLES]
    phases = np.unique(np.linspace(0, part.sizes["phase"], _FRAMES + 1)[:-1].astype(int))
    top = inside_pressure(dataset)
    frames = []
    for row in phases:
        one = part.isel(phase=int(row))
        phase = float(one["phase"])
        turn = phase * pair.pinion_pitch + float(one["rotation"])
        placed = (pair.pinion_placed(turn), pair.gear_placed(phase * pair.gear_pitch))
        members = [
            _points(_placed(solid.vertices, place))
            for solid, place in zip(solids, placed, strict=True)
        ]
        frames.append(([*members, _pressure(pair, one, top)], f"{phase:.2f}"))
    lamp = dict(zip("xyz", (1e5 * _view_direction(pair)).tolist(), strict=True))
    bodies = [
        go.Mesh3d(
            **frames[0][0][k],
            **_corners(solid.faces),
            color=colour,
            opacity=opacity,
            lighting=_LIGHT,
            lightposition=lamp,
            hoverinfo="skip",
            name=role,
        )
        for k, (solid, role, colour, opacity) in enumerate(
            zip(solids, _ROLES, (_PINION, _STEEL), (0.18, 1.0), strict=True)
        )
    ]
    bar = {"title": {"text": "pressure [GPa]", "side": "right"}, "thickness": 14, "len": 0.8}
    pressed = go.Mesh3d(
        **frames[0][0][2],
        cmin=0.0,
        cmax=top,
        colorscale="Plasma",
        intensitymode="cell",
        colorbar=bar,
        lighting={"ambient": 1.0, "diffuse": 0.0, "specular": 0.0},
        hoverinfo="skip",
        name="pressure",
    )
    figure = go.Figure([*bodies, pressed], layout={"template": None, "height": 560})
    figure.frames = [
        go.Frame(name=name, data=[go.Mesh3d(**one) for one in data], traces=[0, 1, 2])
        for data, name in frames
    ]
    figure.update_layout(
        **steering([name for _, name in frames], "mesh phase", frame_ms=250, words="turn"),
        scene=_scene(pair, frames[0][0][:2]),
    )
    return figure


_ROLES: tuple[Role, Role] = ("pinion", "gear")


def _placed(r: Array, placement: Placement) -> Array:
    angle = np.arctan2(placement.sine, placement.cosine)
    turn = Rotation.from_rotvec(angle * np.array(placement.axis))
    point = np.array(placement.point)
    return np.asarray(turn.apply(r - point) + point)


def _points(r: Array) -> dict[str, Array]:
    """Return points (v, 3) as coordinates in mm; 32 bits are enough."""
    return {name: (1e3 * r[:, k]).astype(np.float32) for k, name in enumerate("xyz")}


def _corners(faces: Indices) -> dict[str, Indices]:
    kind = np.uint16 if faces.max() < 65536 else np.int32
    return {name: faces[:, k].astype(kind) for k, name in enumerate("ijk")}


def _pressure(pair: FlankPair, one: xr.Dataset, top: float) -> dict[str, Any]:
    """Return the loaded cells of all pairs at a mesh phase, in place on the gear's teeth."""
    cells = one["pressure_cells"].values
    row, column = np.nonzero(cells > 0.0)
    s = (row[:, None] + np.array([0, 1, 1, 0])) / cells.shape[0]
    t = (column[:, None] + np.array([0, 0, 1, 1])) / cells.shape[1]
    whose = _pair_of_cells(pair, one, s.mean(axis=1), t.mean(axis=1))
    sample = pair.gear.sample(s.ravel(), t.ravel())
    r = (sample.r + _LIFT * sample.normal).reshape(*s.shape, 3)
    placed = np.empty_like(r)
    for number in np.unique(whose):
        angle = (float(one["phase"]) + float(number)) * pair.gear_pitch
        placed[whose == number] = _placed(r[whose == number], pair.gear_placed(angle))
    first = 4 * np.arange(row.size)
    faces = np.concatenate(
        [np.stack([first, first + 1, first + 2], 1), np.stack([first, first + 2, first + 3], 1)]
    )
    values = np.minimum(1e-9 * cells[row, column], top).astype(np.float32)
    return {
        **_points(placed.reshape(-1, 3)),
        **_corners(faces),
        "intensity": np.concatenate([values, values]),
    }


def _pair_of_cells(pair: FlankPair, one: xr.Dataset, s: Array, t: Array) -> Array:
    """Return for each cell the number of the pair whose centre of force is nearest."""
    region = pair.gear.region
    carries = np.flatnonzero(np.isfinite(one["gear_s"].values))
    away = np.hypot(
        region.whole_height * (s[:, None] - one["gear_s"].values[carries]),
        region.face_width * (t[:, None] - one["gear_t"].values[carries]),
    )
    return np.asarray(one["pair"].values[carries][np.argmin(away, axis=1)])


def _scene(pair: FlankPair, members: list[dict[str, Array]]) -> dict[str, Any]:
    """Return the scene, looked at against the loaded flank and down on the gear's teeth."""
    hidden = {"visible": False, "showspikes": False}
    ends = [[f([one[axis] for one in members]) for axis in "xyz"] for f in (_low, _high)]
    low, high = np.array(ends)
    # plotly counts from the middle of the box, its mean side is one
    centre = (1e3 * pair.mean_point - 0.5 * (low + high)) / np.cbrt(np.prod(high - low))
    eye = centre + _DISTANCE * _view_direction(pair)
    return {
        "xaxis": hidden,
        "yaxis": hidden,
        "zaxis": hidden,
        "aspectmode": "data",
        "camera": {
            "center": dict(zip("xyz", centre.tolist(), strict=True)),
            "eye": dict(zip("xyz", eye.tolist(), strict=True)),
            "up": {"x": 0, "y": 0, "z": -1},
        },
    }


def _low(values: list[Array]) -> float:
    return float(min(one.min() for one in values))


def _high(values: list[Array]) -> float:
    return float(max(one.max() for one in values))


def _view_direction(pair: FlankPair) -> Array:
    """Return the unit vector from the teeth in mesh to the eye."""
    middle = pair.gear.sample(np.array([0.6]), np.array([0.45]))
    _, normal = pair.gear_in_place(0.0, middle.r, middle.normal)
    towards = normal[0] + np.array([0.0, 0.0, _DOWN])
    return np.asarray(towards / np.linalg.norm(towards))
