"""Closed surfaces of teeth and gears: closed, and of the volume that the flanks enclose."""

import math

import numpy as np
import pytest

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.flank.tooth_solid import gear_solid, tooth_solid
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile

FILE = HypoidGearFile.named("mohammadpour_2015")


@pytest.fixture(scope="module", params=["pinion", "gear"])
def tooth(request):
    return Tooth.from_file(FILE, request.param)


def volume(solid):
    """Volume by the divergence theorem."""
    a, b, c = (solid.vertices[solid.faces[:, k]] for k in range(3))
    return float(np.sum(a * np.cross(b, c))) / 6.0


def integral_of_tooth(tooth, rows=12, columns=12):
    """Angle that the tooth fills times radius over its axial section, by Gauss's rule."""
    x, w = np.polynomial.legendre.leggauss(rows)
    s, ws = 0.5 * (x + 1.0), 0.5 * w
    x, w = np.polynomial.legendre.leggauss(columns)
    t, wt = 0.5 * (x + 1.0), 0.5 * w
    region = tooth.drive.region
    radius, _ = region.section(*np.meshgrid(s, t, indexing="ij"))
    area = (region.root_depth + region.addendum) * (
        region.outer_cone_distance - region.inner_cone_distance
    )
    return float(ws @ (tooth.thickness_angle(s, t) * radius) @ wt) * area


def rim_volume(tooth, thickness):
    """2 pi times the static moment of the rim's section, a rectangle, about the axis."""
    region = tooth.drive.region
    width = region.outer_cone_distance - region.inner_cone_distance
    distance = 0.5 * (region.outer_cone_distance + region.inner_cone_distance)
    height = -region.root_depth - 0.5 * thickness
    delta = region.pitch_angle
    centroid = distance * math.sin(delta) + height * math.cos(delta)
    return 2.0 * math.pi * centroid * thickness * width


def edges_of(solid):
    faces = solid.faces
    return np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


@pytest.mark.slow
@pytest.mark.parametrize(("build", "euler"), [(tooth_solid, 2), (gear_solid, 0)])
def test_every_edge_has_two_faces_that_pass_it_opposite_ways(tooth, build, euler):
    """A tooth is a ball, a gear with its bore a ring."""
    solid = build(tooth, 5, 7)
    edges = edges_of(solid)
    assert len(np.unique(edges, axis=0)) == len(edges)
    back = {tuple(edge) for edge in edges[:, ::-1].tolist()}
    assert back == {tuple(edge) for edge in edges.tolist()}
    used = np.unique(solid.faces).size
    assert used - len(edges) // 2 + len(solid.faces) == euler


def test_volume_of_a_tooth_is_the_integral_of_its_thickness(tooth):
    exact = integral_of_tooth(tooth)
    errors = [abs(volume(tooth_solid(tooth, m, n)) / exact - 1.0) for m, n in ((3, 6), (12, 24))]
    # chords of a curved tooth: second order, sixteenfold for a grid four times as fine
    assert errors[1] < 2.5e-3
    assert errors[0] / errors[1] > 10.0


def test_volume_of_a_gear_is_that_of_its_teeth_and_its_rim(tooth):
    thickness = 6e-3
    exact = tooth.drive.teeth * integral_of_tooth(tooth) + rim_volume(tooth, thickness)
    assert volume(gear_solid(tooth, 12, 24, thickness)) == pytest.approx(exact, rel=3e-3)


def test_rim_through_the_axis_is_refused(tooth):
    with pytest.raises(ParameterError, match=r"rim must be within .* must not cross the axis"):
        gear_solid(tooth, 4, 4, 0.2)
