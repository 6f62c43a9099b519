"""Flanks as exact surfaces for CAD: B-splines in a STEP file (AP214), one face each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline

from gearlube_core.arrays import Array
from gearlube_core.hypoid_geometry.flank.flank import Flank
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import MIRROR
from gearlube_core.storage.atomic_file import write_text
from gearlube_core.units import MILLIMETRE

_DEGREE = 3
ROWS, COLUMNS = 33, 65  # on them the spline is within 0.01 um of the flank
_MARGIN = 0.01  # s above the end of the flank
_HEADER = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('Flanks of gears as B-spline surfaces'),'2;1');
FILE_NAME('{name}','',(''),(''),'gearlube','gearlube','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
"""
_PRODUCT = (
    "APPLICATION_CONTEXT('core data for automotive mechanical design processes')",
    "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1)",
    "PRODUCT_CONTEXT('',#1,'mechanical')",
    "PRODUCT('{name}','{name}','',(#3))",
    "PRODUCT_DEFINITION_FORMATION('','',#4)",
    "PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design')",
    "PRODUCT_DEFINITION('design','',#5,#6)",
    "PRODUCT_DEFINITION_SHAPE('','',#7)",
    "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))",
    "(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))",
    "(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())",
    "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-05),#9,'distance_accuracy_value','')",
    "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#12))"
    "GLOBAL_UNIT_ASSIGNED_CONTEXT((#9,#10,#11))REPRESENTATION_CONTEXT('',''))",
    "CARTESIAN_POINT('',(0.,0.,0.))",
    "DIRECTION('',(0.,0.,1.))",
    "DIRECTION('',(1.,0.,0.))",
    "AXIS2_PLACEMENT_3D('',#14,#15,#16)",
)
_SHAPE, _CONTEXT, _PLACE = "#8", "#13", "#17"


@dataclass(frozen=True, slots=True)
class SplineSurface:
    """A bicubic B-spline surface with clamped knots.

    Parameters
    ----------
    points : ndarray of shape (m, n, 3)
        Control points [m], from root to tip and from toe to heel.
    rows, columns : ndarray
        Knots, (m + 4,) and (n + 4,): profile and face position [-].
    """

    points: Array
    rows: Array
    columns: Array


def flank_surface(flank: Flank, lowest: float, angle: float = 0.0) -> SplineSurface:
    """Return a flank as a B-spline surface through 33 x 65 of its points.

    Parameters
    ----------
    flank : Flank
    lowest : float
        Profile position [-] where it begins, 0 root to 1 tip.
    angle : float, optional
        By which it is turned about its axis [rad].
    """
    # rows close up towards the root, where an undercut flank bends as a square root
    s = lowest + (1.0 - lowest) * np.linspace(0.0, 1.0, ROWS) ** 2
    t = np.linspace(0.0, 1.0, COLUMNS)
    centre = flank.axis_point
    arms = flank.grid(s, t).r - centre
    points = centre + flank.turned(angle).apply(arms.reshape(-1, 3)).reshape(arms.shape)
    return surface_through(points, s, t)


def surface_through(points: Array, s: Array, t: Array) -> SplineSurface:
    """Return the surface through points [m], (m, n, 3), at places s (m,) and t (n,) [-]."""
    down = make_interp_spline(s, points, k=_DEGREE, axis=0)
    across = make_interp_spline(t, down.c, k=_DEGREE, axis=1)
    return SplineSurface(np.moveaxis(across.c, 0, 1), down.t, across.t)


def tooth_surfaces(tooth: Tooth) -> dict[str, SplineSurface]:
    """Return both flanks of one tooth, as far down as they are sound over the whole face."""
    found = {}
    for side, flank, angle in (
        ("drive", tooth.drive, 0.0),
        ("coast", tooth.coast, tooth.coast_turn),
    ):
        limit = tooth.limit(side, np.linspace(0.0, 1.0, COLUMNS))  # type: ignore[arg-type]
        lowest = max(0.0, float(np.max(limit.s)) + _MARGIN)
        found[f"{flank.role} {side} flank"] = flank_surface(flank, lowest, angle)
    return found


def mirror_image(surface: SplineSurface) -> SplineSurface:
    """Return a surface of the pair of the other hand, y -> -y."""
    return SplineSurface(surface.points * MIRROR, surface.rows, surface.columns)


def write_step(surfaces: Mapping[str, SplineSurface], path: str | Path) -> Path:
    """Write surfaces as faces of open shells, in millimetres; return the path.

    References
    ----------
    [iso_10303_214]: entities of the file.
    """
    path = Path(path)
    entities = [line.format(name=path.stem) for line in _PRODUCT]
    shells = [_shell(entities, name, one) for name, one in surfaces.items()]
    model = _add(entities, f"SHELL_BASED_SURFACE_MODEL('',({','.join(shells)}))")
    shape = _add(
        entities, f"MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',({_PLACE},{model}),{_CONTEXT})"
    )
    _add(entities, f"SHAPE_DEFINITION_REPRESENTATION({_SHAPE},{shape})")
    lines = [f"#{number}={entity};" for number, entity in enumerate(entities, 1)]
    end = "\nENDSEC;\nEND-ISO-10303-21;\n"
    write_text(_HEADER.format(name=path.name) + "\n".join(lines) + end, path)
    return path


def _shell(entities: list[str], name: str, surface: SplineSurface) -> str:
    """Add a shell of one face whose four edges are the edges of the surface."""
    grid = [[_point(entities, p) for p in row] for row in surface.points / MILLIMETRE]
    rows, columns = _knots(surface.rows), _knots(surface.columns)
    listed = ",".join(f"({','.join(row)})" for row in grid)
    plane = _add(
        entities,
        f"B_SPLINE_SURFACE_WITH_KNOTS('{name}',{_DEGREE},{_DEGREE},({listed}),.UNSPECIFIED.,.F.,"
        f".F.,.F.,{rows[0]},{columns[0]},{rows[1]},{columns[1]},.UNSPECIFIED.)",
    )
    corners = {
        key: _add(entities, f"VERTEX_POINT('',{grid[key[0]][key[1]]})")
        for key in ((0, 0), (-1, 0), (-1, -1), (0, -1))
    }
    edges = []
    for start, end, points, (counts, knots), forward in (
        ((0, 0), (-1, 0), [row[0] for row in grid], rows, True),
        ((-1, 0), (-1, -1), grid[-1], columns, True),
        ((0, -1), (-1, -1), [row[-1] for row in grid], rows, False),
        ((0, 0), (0, -1), grid[0], columns, False),
    ):
        curve = _add(
            entities,
            f"B_SPLINE_CURVE_WITH_KNOTS('',{_DEGREE},({','.join(points)}),.UNSPECIFIED.,.F.,.F.,"
            f"{counts},{knots},.UNSPECIFIED.)",
        )
        edge = _add(entities, f"EDGE_CURVE('',{corners[start]},{corners[end]},{curve},.T.)")
        edges.append(_add(entities, f"ORIENTED_EDGE('',*,*,{edge},{'.T.' if forward else '.F.'})"))
    loop = _add(entities, f"EDGE_LOOP('',({','.join(edges)}))")
    bound = _add(entities, f"FACE_BOUND('',{loop},.T.)")
    face = _add(entities, f"ADVANCED_FACE('{name}',({bound}),{plane},.T.)")
    return _add(entities, f"OPEN_SHELL('{name}',({face}))")


def _knots(knots: Array) -> tuple[str, str]:
    """Return multiplicities and values of knots as lists."""
    values, counts = np.unique(knots, return_counts=True)
    return f"({','.join(map(str, counts))})", f"({','.join(map(_number, values))})"


def _point(entities: list[str], place: Array) -> str:
    return _add(entities, f"CARTESIAN_POINT('',({','.join(map(_number, place))}))")


def _number(value: float) -> str:
    """Return a number with the point that STEP wants."""
    text = f"{value:.12G}"
    mantissa, exponent, power = text.partition("E")
    return (mantissa if "." in mantissa else f"{mantissa}.") + exponent + power


def _add(entities: list[str], entity: str) -> str:
    entities.append(entity)
    return f"#{len(entities)}"
