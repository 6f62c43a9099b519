"""STEP files of flanks: what stands in the file is the flank."""

import re

import numpy as np
import pytest
from scipy.interpolate import BSpline

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


def test_edges_end_in_the_corners_of_the_surface(entities):
    for edge in (one for one in entities.values() if one.startswith("EDGE_CURVE")):
        start, end, curve = re.findall(r"#\d+", edge)
        points = re.findall(r"#\d+", entities[curve])
        ends = [re.search(r"#\d+", entities[vertex])[0] for vertex in (start, end)]
        assert ends == [points[0], points[-1]]
