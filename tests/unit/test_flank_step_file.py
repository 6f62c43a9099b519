"""STEP files of flanks: references, surfaces, edges."""

import re

import numpy as np
import pytest
from scipy.interpolate import BSpline

from gearlube.studies.helical.run import write_gears
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_geometry.flank.step_file import tooth_surfaces, write_step
from gearlube_core.hypoid_geometry.flank.tooth import Tooth
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile


@pytest.fixture(scope="module")
def pinion():
    return Tooth.from_file(HypoidGearFile.named("mohammadpour_2015"), "pinion")


@pytest.fixture(scope="module")
def entities(pinion, tmp_path_factory):
    """Entities of the pinion's file by their numbers."""
    path = tmp_path_factory.mktemp("step") / "pinion.step"
    text = write_step(tooth_surfaces(pinion), path).read_text(encoding="utf-8")
    data = text.partition("DATA;\n")[2].partition("ENDSEC;")[0]
    return dict(re.findall(r"^(#\d+)=(.*);$", data, re.MULTILINE))


def numbers(text):
    return np.array([float(one) for one in text.split(",")])


def surface(entities, name):
    """Knots and control points [mm] of a surface, as the file has them."""
    form = rf"B_SPLINE_SURFACE_WITH_KNOTS\('{name}',3,3,\((.*)\),\.UNSPECIFIED\..*?,\((.*)\),\.UN"
    match = next(m for one in entities.values() if (m := re.match(form, one)))
    grid = [
        [numbers(re.search(r"\(([^()]*)\)", entities[ref])[1]) for ref in row.split(",")]
        for row in re.findall(r"\(([^()]*)\)", match[1])
    ]
    counts_s, counts_t, knots_s, knots_t = (numbers(part) for part in match[2].split("),("))
    return (
        np.array(grid),
        np.repeat(knots_s, counts_s.astype(int)),
        np.repeat(knots_t, counts_t.astype(int)),
    )


def test_every_reference_is_defined(entities):
    used = set(re.findall(r"#\d+", " ".join(entities.values())))
    assert used <= entities.keys()
    assert sum(one.startswith("ADVANCED_FACE") for one in entities.values()) == 2


@pytest.mark.parametrize("side", ["drive", "coast"])
def test_the_surface_in_the_file_is_the_flank(side, pinion, entities):
    points, rows, columns = surface(entities, f"pinion {side} flank")
    flank = getattr(pinion, side)
    random = np.random.default_rng(5)
    s, t = random.uniform(rows[0], 1.0, 300), random.uniform(0.0, 1.0, 300)
    along = BSpline(rows, points, 3)(s)  # (300, n, 3)
    found = np.stack([BSpline(columns, row, 3)(place) for row, place in zip(along, t, strict=True)])
    sample = flank.sample(s, t)
    turn = flank.turned(pinion.coast_turn if side == "coast" else 0.0)
    expected = 1e3 * (flank.axis_point + turn.apply(sample.r - flank.axis_point))
    # 0.01 um, as the docs say, is a thousandth of a relief; slip along the flank changes no shape
    off = np.sum((found - expected) * turn.apply(sample.normal), axis=-1)
    np.testing.assert_allclose(off, 0.0, atol=0.01e-3)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=0.1e-3)


@pytest.mark.parametrize("member", ["pinion", "gear"])
def test_helical_flanks_are_involute_helicoids_of_the_given_thickness(member, tmp_path):
    """r_b (tan(a) - a) of arc between the base circle and a point, turned by z/lead, mirrored."""
    file = HelicalGearFile.named("he_2007")
    pair = file.helical_pair()
    k = ["pinion", "gear"].index(member)
    path = next(one for one in write_gears(file, tmp_path / "gears") if one.stem.startswith(member))
    data = path.read_text(encoding="utf-8").partition("DATA;\n")[2].partition("ENDSEC;")[0]
    found = dict(re.findall(r"^(#\d+)=(.*);$", data, re.MULTILINE))
    base = 1e3 * (pair.pinion_base_radius, pair.gear_base_radius)[k]
    reference = 1e3 * (pair.pinion_reference_radius, pair.gear_reference_radius)[k]
    inv = lambda angle: np.tan(angle) - angle  # noqa: E731
    half = 0.5e3 * pair.tooth_thickness[k] / reference + inv(pair.transverse_pressure_angle)
    random, towards = np.random.default_rng(3), (1.0, -1.0)[k]
    for side, sign in (("drive", towards), ("coast", -towards)):
        points, rows, columns = surface(found, f"{member} {side} flank")
        s, t = random.uniform(0.0, 1.0, 200), random.uniform(0.0, 1.0, 200)
        x, y, z = np.stack(
            [
                BSpline(columns, BSpline(rows, points, 3)(one), 3)(place)
                for one, place in zip(s, t, strict=True)
            ],
            axis=-1,
        )
        radius = np.hypot(x, y)
        turned = np.arctan2(x, towards * y) - z * np.tan(pair.base_helix_angle) / base
        expected = sign * (half - inv(np.arccos(base / radius)))
        # 0.01 um over the radius, as the docs say
        np.testing.assert_allclose(base * turned, base * expected, rtol=0.0, atol=0.01e-3)
        assert radius.max() <= 1e3 * (pair.pinion_tip_radius, pair.gear_tip_radius)[k] + 1e-9
        assert np.ptp(z) > 0.9e3 * pair.face_width


def test_edges_end_in_the_corners_of_the_surface(entities):
    for edge in (one for one in entities.values() if one.startswith("EDGE_CURVE")):
        start, end, curve = re.findall(r"#\d+", edge)
        points = re.findall(r"#\d+", entities[curve])
        ends = [re.search(r"#\d+", entities[vertex])[0] for vertex in (start, end)]
        assert ends == [points[0], points[-1]]
