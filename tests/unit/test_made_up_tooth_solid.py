"""Closed surfaces of made-up teeth with radial flanks, whose volume is known exactly."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.tooth_solid import gear_solid, tooth_solid

ROOT, DEPTH, WIDTH, TEETH, FILLED = 0.04, 0.01, 0.03, 5, 0.5  # m, m, m, -, rad
PITCH = 2.0 * math.pi / TEETH


class RadialTooth:
    """Flanks at polar angles 0 and 0.5 on a cone of pitch angle `cone`."""

    pitch = PITCH

    def __init__(self, towards=1.0, cone=0.0, filled=FILLED):
        self.towards, self.filled = towards, filled
        cos, sin = math.cos(cone), math.sin(cone)

        def section(s, t):
            radius = ROOT + DEPTH * s * cos + WIDTH * t * sin
            return radius, WIDTH * t * cos - DEPTH * s * sin

        region = SimpleNamespace(
            root_depth=0.4 * DEPTH, addendum=0.6 * DEPTH, section=section, pitch_angle=cone
        )
        self.drive = SimpleNamespace(region=region, teeth=TEETH, role="gear")

    def angles(self, side, s, t):
        angle = 0.1 + (self.towards * self.filled if side == "coast" else 0.0)
        return np.full((s.size, t.size), angle), None

    def points(self, angle, s, t):
        radius, axial = self.drive.region.section(*np.meshgrid(s, t, indexing="ij"))
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), axial], axis=-1)


def _volume(solid):
    a, b, c = (solid.vertices[solid.faces[:, k]] for k in range(3))
    return float(np.sum(a * np.cross(b, c))) / 6.0


def _is_closed(solid, euler):
    faces = solid.faces
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forth, back = ({tuple(edge) for edge in way.tolist()} for way in (edges, edges[:, ::-1]))
    vertices = np.unique(faces).size
    return (
        forth == back
        and len(forth) == len(edges)
        and vertices - len(edges) // 2 + len(faces) == euler
    )


def _sector(radius, angle, chords):
    return 0.5 * chords * radius**2 * math.sin(angle / chords)


@pytest.mark.parametrize("towards", [1.0, -1.0])
@pytest.mark.parametrize("rows", [2, 5])
def test_gear_of_radial_teeth_has_the_volume_of_its_polygons(towards, rows):
    rim = 0.013
    solid = gear_solid(RadialTooth(towards), rows, 3, rim)
    # tops and slots have nine points; the bore has as many as the contour of a tooth
    teeth = _sector(ROOT + DEPTH, FILLED, 8) + _sector(ROOT, PITCH - FILLED, 8)
    around = 2 * rows + 14
    exact = TEETH * (teeth - _sector(ROOT - rim, PITCH, around)) * WIDTH
    assert _volume(solid) == pytest.approx(exact, rel=1e-12)
    assert _is_closed(solid, 0)


@pytest.mark.parametrize("towards", [1.0, -1.0])
def test_end_faces_of_a_gear_are_laid_without_folds(towards):
    solid = gear_solid(RadialTooth(towards), 4, 3, 0.013)
    corners = solid.vertices[solid.faces]
    for axial, outward in ((0.0, -1.0), (WIDTH, 1.0)):
        a, b, c = np.moveaxis(corners[np.all(corners[..., 2] == axial, axis=1)][..., :2], 1, 0)
        (u, v), (p, q) = (b - a).T, (c - a).T
        assert np.all(outward * (u * q - v * p) > 0.0)


@pytest.mark.parametrize("towards", [1.0, -1.0])
def test_tooth_of_radial_flanks_has_the_volume_of_its_polygon(towards):
    solid = tooth_solid(RadialTooth(towards), 4, 3)
    exact = (_sector(ROOT + DEPTH, FILLED, 8) - _sector(ROOT, FILLED, 8)) * WIDTH
    assert _volume(solid) == pytest.approx(exact, rel=1e-12)
    assert _is_closed(solid, 2)


def test_conical_gear_is_closed_with_a_rim_of_the_whole_depth():
    solid = gear_solid(RadialTooth(cone=0.4), 4, 6)
    assert _is_closed(solid, 0)
    inside = np.hypot(*solid.vertices[:, :2].T).min()
    assert inside == pytest.approx(ROOT - DEPTH * math.cos(0.4), rel=1e-12)


@pytest.mark.parametrize("cone", [0.3, 1.2])
def test_rim_keeps_a_tenth_of_the_radius_at_the_toe(cone):
    through = ROOT / math.cos(cone)  # a rim down to the axis
    solid = gear_solid(RadialTooth(cone=cone), 3, 4, 0.89 * through)
    inside = np.hypot(*solid.vertices[:, :2].T).min()
    assert inside == pytest.approx(0.11 * ROOT, rel=1e-9)
    with pytest.raises(ParameterError, match="must not cross the axis"):
        gear_solid(RadialTooth(cone=cone), 3, 4, 0.91 * through)


@pytest.mark.parametrize("filled", [0.0, -0.1, PITCH, PITCH + 0.1])
def test_pointed_teeth_and_closed_slots_are_refused(filled):
    for build in (tooth_solid, gear_solid):
        with pytest.raises(ParameterError, match="gear tooth is pointed or its slot is closed"):
            build(RadialTooth(filled=filled), 3, 3)
