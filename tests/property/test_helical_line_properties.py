"""What must hold of contact lines and their loads for every helical pair."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.contact_line import clip_line, line_position, segment_length
from gearlube_core.helical_geometry.load_sharing import positions_at, shared_load
from gearlube_core.helical_geometry.modification import FlankModification, ModifiedPair, TipRelief
from gearlube_core.helical_geometry.pair import HelicalPair

FEW = settings(max_examples=60)


@st.composite
def pairs(draw, helix_from=0.0):
    """Standard teeth, centre distance up to one percent longer than standard."""
    # a line of next to no slope enters within rounding, all of it or nothing
    beta = math.radians(draw(st.just(helix_from) | st.floats(helix_from + 1e-3, 40.0)))
    module = draw(st.floats(1e-3, 10e-3))
    teeth = draw(st.integers(17, 60)), draw(st.integers(17, 120))
    radii = [0.5 * z * module / math.cos(beta) for z in teeth]
    try:
        return HelicalPair(
            name="drawn",
            pinion_teeth=teeth[0],
            gear_teeth=teeth[1],
            normal_module=module,
            normal_pressure_angle=math.radians(draw(st.floats(18.0, 25.0))),
            helix_angle=beta,
            centre_distance=sum(radii) * draw(st.floats(1.0, 1.01)),
            pinion_tip_radius=radii[0] + module,
            gear_tip_radius=radii[1] + module,
            pinion_root_radius=radii[0] - 1.25 * module,
            gear_root_radius=radii[1] - 1.25 * module,
            face_width=module * draw(st.floats(2.0, 40.0)),
        )
    except ParameterError:
        assume(False)


@FEW
@given(pair=pairs(), phase=st.floats(-3.0, 3.0), line=st.integers(0, 6))
def test_segment_is_all_of_the_line_that_lies_in_the_plane_of_contact(pair, phase, line):
    """Against 4001 points of the line, each in the plane or not."""
    plane = pair.plane
    X = line_position(phase, line, plane)
    z = np.linspace(-0.5 * plane.W, 0.5 * plane.W, 4001)
    x = X - (0.5 * plane.W - z) * plane.sin_b / plane.cos_b
    inside = ((x >= plane.A) & (x <= plane.D)).mean()
    segment = clip_line(X, plane)
    length = segment_length(segment, plane)
    assert length * plane.cos_b / plane.W == pytest.approx(inside, abs=6e-4)
    if length > 0.0:
        assert -0.5 * plane.W <= segment.z_low < segment.z_high <= 0.5 * plane.W
        slack = 1e-12 * plane.x_g
        assert plane.A - slack <= segment.x_low <= segment.x_high <= plane.D + slack
        run = np.hypot(segment.x_high - segment.x_low, segment.z_high - segment.z_low)
        assert run == pytest.approx(length, rel=1e-9, abs=1e-12)


@FEW
@given(pair=pairs(helix_from=1.0), phase=st.floats(-2.0, 2.0))
def test_lines_repeat_every_mesh_period_and_age_by_one_pitch(pair, phase):
    plane = pair.plane
    here, later = positions_at([phase], pair)[0], positions_at([phase + 1.0], pair)[0]
    # Past a whole number rounding may give the line or its elder.
    step = (later - here) / plane.pitch
    assert np.allclose(step, np.rint(step), atol=1e-9)
    assert np.diff(here) == pytest.approx(np.full(here.size - 1, plane.pitch), rel=1e-9)


@FEW
@given(pair=pairs(helix_from=8.0), phase=st.floats(0.0, 0.999), depth=st.floats(0.0, 0.3))
def test_loads_of_all_lines_balance_the_torque(pair, phase, depth):
    """Normal forces times cos(b) and the base radius; the thesis' loads lack the cosine."""
    relief = TipRelief(amount=1e-5, extent=(depth + 1e-6) * pair.normal_module, k=1.0)
    flank = FlankModification(tip_relief=relief)
    modified = ModifiedPair(pair=pair, pinion=flank, gear=flank)
    X, torque, cos = positions_at([phase], pair), 250.0, math.cos(pair.base_helix_angle)
    try:
        normal = shared_load(X, modified, torque)
    except ParameterError:
        assume(False)
    assert normal.share.sum() == pytest.approx(1.0, rel=1e-9)
    assert normal.load.sum() * cos * pair.pinion_base_radius == pytest.approx(torque, rel=1e-9)
    np.testing.assert_allclose(normal.load, normal.line_load * normal.length, rtol=1e-12)
    thesis = shared_load(X, modified, torque, "thesis")
    np.testing.assert_allclose(thesis.load, normal.load * cos, rtol=1e-12)
    assert (np.ptp(normal.total_length)) <= 1e-9 * normal.total_length.max()
