"""View of a drivetrain in space: shafts, gears, bearings and nodes of housings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from gearlube.plotting.style import SERIES
from gearlube.report.parts import Figure
from gearlube.studies.drivetrain.layout import Layout
from gearlube_core.arrays import Array, Indices

_AROUND = 40  # points of a circle
_RIM, _BORE = 1.08, 0.97  # of a ring over its pitch circle, and of a disc's hole in its shaft
_BEARING = (1.7, 0.5)  # outer radius and width over the radius of the shaft
_LEAST = 0.04  # of the largest gear: radius of what has no size of its own
_LIGHT = {"ambient": 0.65, "diffuse": 0.6, "specular": 0.1, "facenormalsepsilon": 0.0}
_EYE = {"x": -1.5, "y": 0.7, "z": -0.8}  # z goes to the right across the page
_CENTRE, _LARGEST = {"x": 0.0, "y": -0.1, "z": 0.0}, 1.15  # of the view; longest side of its box
_Hollow = tuple[float, float, float, float]  # from z to z, inner and outer radius [m]


def space_view(found: Layout) -> Figure:
    """Return the view of a drivetrain that has gears on parallel shafts.

    Examples
    --------
    >>> from drivetrain.train.train_file import TrainFile
    >>> from gearlube.studies.drivetrain.layout import layout
    >>> view = space_view(layout(TrainFile.named("e_axle_elastic").case().train))
    >>> [one.name for one in view.chart.data][:4]
    ['input', 'stage_1, input', 'input_fixed', 'input_middle']
    """
    import plotly.graph_objects as go

    chart = go.Figure(layout={"template": None, "height": 620, "margin": dict.fromkeys("lrtb", 0)})
    found, alike = found.drawn(), found.alike()
    kinds = {body: i for i, each in enumerate(alike.values()) for body in each}
    largest = max(gear.radius for gear in found.gears)
    bodies = dict.fromkeys([*found.sections, *(gear.body for gear in found.gears)])
    for body in bodies:
        kind = kinds.setdefault(body, len(kinds))
        colour, centre, shift = SERIES[kind % len(SERIES)], found.centres[body], found.shifts[body]
        sections = found.sections.get(body, ())
        gears = [gear for gear in found.gears if gear.body == body]
        if sections:
            parts = [(a + shift, b + shift, inner, outer) for a, b, inner, outer in sections]
            chart.add_trace(_solid(body, centre, parts, color=colour))
        shown = set[tuple[float, float]]()
        for gear in gears:
            if (gear.radius, gear.z) in shown:
                continue
            shown.add((gear.radius, gear.z))
            z, half = gear.z + shift, 0.5 * gear.width
            on = _radius(sections, gear.z) * _BORE
            hollow = (gear.radius, _RIM * gear.radius) if gear.ring else (on, gear.radius)
            name = f"{gear.mesh}, {body}"
            chart.add_trace(
                _solid(name, centre, [(z - half, z + half, *hollow)], color=colour, opacity=0.45)
            )
        for seat in found.seats.get(body, ()):
            z = seat.z + shift
            inner = _radius(sections, seat.z) or _LEAST * largest
            outer, half = _BEARING[0] * inner, 0.5 * _BEARING[1] * inner
            ring = (z - half, z + half, inner, outer)
            chart.add_trace(_solid(seat.name, centre, [ring], color="#8A8F94"))
        if not sections:
            ends = [gear.z + shift + side * gear.width for gear in gears for side in (-1.0, 1.0)]
            line = np.array([[centre.real, centre.imag, z] for z in (min(ends), max(ends))])
            chart.add_trace(
                go.Scatter3d(**_points(line), name=body, mode="lines", hoverinfo="name",
                             line={"color": colour, "width": 6})
            )  # fmt: skip
    if found.housing:
        nodes = np.array([[at.real, at.imag, z] for at, z in found.housing.values()])
        chart.add_trace(
            go.Scatter3d(**_points(nodes), name="housing", mode="markers", hoverinfo="text",
                         text=list(found.housing), marker={"color": "black", "size": 4})
        )  # fmt: skip
    axes = {f"{c}axis": {"title": {"text": f"{c} [mm]"}} for c in "xyz"}
    camera = {"up": {"x": 0.0, "y": 1.0, "z": 0.0}, "eye": _EYE, "center": _CENTRE}
    extents = {c: np.ptp(np.concatenate([one[c] for one in chart.data])) for c in "xyz"}
    size = {c: float(_LARGEST * one / max(extents.values())) for c, one in extents.items()}
    scene = {"aspectmode": "manual", "aspectratio": size, "camera": camera, **axes}
    chart.update_layout(scene=scene, showlegend=False)
    return Figure(
        name="space_view",
        title="The drivetrain in space",
        caption="Turn it with the mouse; names show under it. Shafts are cylinders of their "
        "sections, gears discs of their pitch circles, bearings and supports grey rings, nodes of "
        "housings points. Bodies without a length are lines.",
        chart=chart,
    )


def _radius(sections: Sequence[_Hollow], z: float) -> float:
    """Return the outer radius of a shaft at z [m], 0 where there is none."""
    return max((one[3] for one in sections if one[0] <= z <= one[1]), default=0.0)


def _solid(name: str, centre: complex, parts: Sequence[_Hollow], **look: Any) -> Any:
    """Return hollow cylinders about one axis as one body with a name."""
    import plotly.graph_objects as go

    vertices, faces, first = [], [], 0
    for part in parts:
        r, own = _hollow(centre, part)
        vertices.append(r)
        faces.append(own + first)
        first += len(r)
    corners = np.concatenate(faces)
    return go.Mesh3d(
        **_points(np.concatenate(vertices)),
        **{letter: corners[:, k] for k, letter in enumerate("ijk")},
        name=name, hoverinfo="name", hoverlabel={"namelength": -1}, lighting=_LIGHT,
        flatshading=True, **look,
    )  # fmt: skip


def _hollow(centre: complex, part: _Hollow) -> tuple[Array, Indices]:
    """Return points (4 n, 3) [m] and triangles (8 n, 3) of a hollow cylinder."""
    low, high, inner, outer = part
    angle = np.linspace(0.0, 2.0 * np.pi, _AROUND, endpoint=False)
    circles = [
        np.stack([centre.real + r * np.cos(angle), centre.imag + r * np.sin(angle), 0 * angle + z])
        for r, z in ((outer, low), (outer, high), (inner, high), (inner, low))
    ]
    k = np.arange(_AROUND)
    following = (k + 1) % _AROUND
    faces = []
    for one in range(4):
        a, b = one * _AROUND, (one + 1) % 4 * _AROUND
        faces += [np.stack([a + k, a + following, b + k], 1)]
        faces += [np.stack([a + following, b + following, b + k], 1)]
    return np.concatenate(circles, axis=1).T, np.concatenate(faces)


def _points(r: Array) -> dict[str, Array]:
    """Return points (v, 3) as coordinates in mm; 32 bits are enough."""
    return {name: (1e3 * r[:, k]).astype(np.float32) for k, name in enumerate("xyz")}
