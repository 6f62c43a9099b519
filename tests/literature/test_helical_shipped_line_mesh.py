"""The line mesh that ships: its state, its origin, and that the analysis still writes it."""

import math

import numpy as np
import pytest

from benchmarks.shipped_meshes import analysed_line_mesh
from gearlube_core.errors import TableError
from gearlube_core.helical_geometry.contact_line import clip_line, line_position, segment_length
from gearlube_core.mesh_table.line_mesh_file import named_line_mesh
from tests.helpers.each import each
from tests.helpers.helical_contact_cases import HE_2007

SHIPPED = named_line_mesh("he_2007")
LENGTHS = np.array(
    [
        [
            segment_length(
                clip_line(line_position(float(phase), i, HE_2007.plane), HE_2007.plane),
                HE_2007.plane,
            )
            for i in range(SHIPPED.lines)
        ]
        for phase in SHIPPED.phase
    ]
)


def test_it_belongs_to_the_pair_of_he_et_al_and_says_where_it_is_from():
    assert (SHIPPED.pinion_teeth, SHIPPED.gear_teeth) == (25, 31)
    assert SHIPPED.base_pitch == pytest.approx(HE_2007.base_pitch, rel=1e-12)
    assert set(SHIPPED.provenance) == {"density", "offset"}
    with pytest.raises(TableError, match="he_2007"):
        named_line_mesh("nobody")


def test_mean_density_exceeds_that_of_iso_6336_by_less_than_the_reduction_it_leaves_out():
    # 13.16 GPa from c_gamma with C_M = 0.8 (constant density of He et al.'s model); calculated
    # teeth are up to 1/0.8 stiffer, tangents a further 6 % stiffer than the secant from no load
    level = int(np.flatnonzero(SHIPPED.torque == 226.0)[0])
    part = LENGTHS[..., None] / SHIPPED.station.size
    mean = float((SHIPPED.density[level] * part).sum() / LENGTHS.sum())
    assert 13.16e9 < mean < 13.16e9 / 0.8 * 1.10


@each("level", range(SHIPPED.torque.size))
def test_its_lines_balance_each_torque_at_every_phase(level):
    # the closing is the answer: rising until the springs carry the torque
    arm = HE_2007.pinion_base_radius * math.cos(HE_2007.base_helix_angle)
    part = LENGTHS[..., None] / SHIPPED.station.size
    k, e = SHIPPED.density[level], SHIPPED.offset[level]
    stiff = (k * part).sum(axis=(1, 2))
    closing = (SHIPPED.torque[level] / arm + (k * e * part).sum(axis=(1, 2))) / stiff
    load = k * (closing[:, None, None] - e)
    assert load.min() >= -1e-6 * load.max()  # no station pulls at its own torque
    # the closing grows with the load, a little less than in proportion
    secant = SHIPPED.torque[level] / arm**2 / (closing / arm)
    assert 5.5e8 < secant.mean() * math.cos(HE_2007.base_helix_angle) ** 2 < 8.0e8


@pytest.mark.slow
def test_it_is_what_the_analysis_writes(tmp_path):
    now = analysed_line_mesh(cache=tmp_path)
    np.testing.assert_array_equal(now.torque, SHIPPED.torque)
    part = LENGTHS[..., None] / SHIPPED.station.size
    # sums are as exact as the tangent's conjugate gradients, 1e-4; a single station's tangent
    # holds the singular edge of its contact and moves more
    for values in (lambda m: m.density, lambda m: m.density * m.offset):
        sums = [(values(m) * part).sum(axis=(2, 3)) for m in (now, SHIPPED)]
        np.testing.assert_allclose(*sums, rtol=2e-3, atol=2e-3 * np.abs(sums[1]).max())
    assert now.provenance == SHIPPED.provenance
