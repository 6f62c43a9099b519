"""What the dataset of a pair's geometry says where Jamali 2015 prints a number."""

import math

import numpy as np
import pytest

from gearlube.studies.helical.geometry_dataset import gear_file_geometry, geometry_dataset
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.each import each
from tests.helpers.jamali_2015 import jamali_2015, jamali_2015_steps

DATASETS = {d: gear_file_geometry(HelicalGearFile.named(f"jamali_2015_{d}")) for d in "ab"}
RELIEVED = {"relief": "with tip relief"}


def base_helix():
    """Of the basic rack of Table 4.1: 20 degrees in the normal plane, helix 19.6 degrees."""
    beta = math.radians(19.6)
    alpha_t = math.atan(math.tan(math.radians(20.0)) / math.cos(beta))
    return math.atan(math.tan(beta) * math.cos(alpha_t))


@pytest.mark.parametrize("design", ["a", "b"])
def test_largest_load_is_14_4_kn_where_the_line_reaches_minus_7_5_mm(design):
    # Sec. 4.1, last printed digit; the load is level over a window of positions.
    loads = DATASETS[design]["load"].sel(**RELIEVED)
    thesis = loads.sel(convention="thesis")
    assert 1e-3 * thesis.max() == pytest.approx(14.4, abs=0.05)
    level = thesis["position"].values[thesis.values > thesis.values.max() * (1.0 - 1e-9)]
    assert level.min() < -7.5e-3 < level.max()
    # the force normal to the flanks is larger by the base helix, which the thesis leaves out
    normal = loads.sel(convention="normal").max()
    assert normal / thesis.max() == pytest.approx(1.0 / math.cos(base_helix()), rel=1e-12)


@each("state", ["unmodified", "with tip relief"])
@each("design", ["a", "b"])
def test_loads_one_pitch_apart_carry_the_torque_together(design, state):
    # 1060 N.m on m_n N/(2 cos(beta)) cos(alpha_t) = 73.520 mm. Between stored positions loads
    # bend where another line enters: 1e-3 of the load.
    dataset = DATASETS[design].sel(relief=state, convention="thesis")
    s_i, load = dataset["position"].values, dataset["load"].values
    pitch = dataset.attrs["base_pitch"]
    for first in s_i[0] + pitch * np.linspace(0.0, 1.0, 23):
        lines = np.interp(first + pitch * np.arange(-1, 5), s_i, load, left=0.0, right=0.0)
        assert lines.sum() == pytest.approx(1060.0 / 73.520e-3, rel=1e-3)


@pytest.mark.parametrize(("design", "reduction"), [("a", 0.4118), ("b", 0.416)])
def test_relief_reduces_the_mean_length_by_two_fifths(design, reduction):
    # Sec. 4.1; a percentage point, for the printed relief zones miss their own formula.
    mean = DATASETS[design]["mean_length"].values
    assert 1.0 - mean[1] / mean[0] == pytest.approx(reduction, abs=0.01)
    # the mean over one line's cycle is that over a mesh period: every line has all its lengths
    one = DATASETS[design].sel(**RELIEVED)
    area = np.trapezoid(one["length"].values, one["position"].values)
    # a thousand phases miss the corners of the total by 1e-3 of a pitch
    assert area / one.attrs["base_pitch"] == pytest.approx(mean[1], rel=1e-4)


@pytest.mark.parametrize("design", ["a", "b"])
def test_relieved_length_varies_by_four_to_five_percent(design):
    # Printed 4.3 (A) and 4.8 % (B); the order is that of the printed relief zones.
    assert 0.04 < float(DATASETS[design]["length_variation"].sel(**RELIEVED)) < 0.05


def test_two_or_three_unmodified_lines_are_in_contact():
    # Sec. 4.1
    for dataset in DATASETS.values():
        counts = set(dataset["lines_in_contact"].sel(relief="unmodified").values.tolist())
        assert counts == {2, 3}


def test_entrainment_is_6_7_m_s_on_a_and_rises_by_a_quarter_from_5_8_m_s_on_b():
    # Sec. 4.2: printed tenths; a quarter read against the mean, to 3 points
    speeds = {design: dataset["entrainment"].values for design, dataset in DATASETS.items()}
    assert speeds["a"] == pytest.approx(np.full(speeds["a"].shape, 6.7), abs=0.06)
    assert speeds["b"][0] == pytest.approx(5.8, abs=0.05)
    assert np.ptp(speeds["b"]) / speeds["b"].mean() == pytest.approx(0.25, abs=0.03)


def test_relative_radius_is_nearly_symmetric_on_a_and_rises_throughout_on_b():
    # Fig. 4.3 (a); 34 over 33 teeth leave A three parts in a hundred between its ends.
    R = DATASETS["a"]["R_transverse"].values
    assert R[0] / R[-1] == pytest.approx(33.0 / 34.0, abs=0.01)
    assert (np.diff(DATASETS["b"]["R_transverse"].values) > 0.0).all()


def test_sliding_changes_sign_once_along_the_line_in_the_middle_of_the_cycle():
    # Fig. 4.4, where the line crosses the pitch line: y = z/cos(b), z = (s - s_i)/tan(b) - F/2
    b = base_helix()
    middle = DATASETS["a"]["line_sliding"].sel(shown=2)
    signs = np.sign(middle.values)
    assert (np.diff(signs[np.isfinite(signs)]) >= 0.0).all()
    crossing = (6.7e-3 / math.tan(b) - 22e-3) / math.cos(b)
    at = np.interp(0.0, middle.values, middle["y"].values)
    assert at == pytest.approx(crossing, abs=1e-6)  # straight: rounding of s_i alone


def test_lay_angles_span_the_printed_ranges():
    # Sec. 7.3: 4.6 to 9.5 and 9.5 to 4.6 degrees; 0.3 degrees for reading s to 1 mm
    for member, printed in (("pinion", (4.6, 9.5)), ("gear", (9.5, 4.6))):
        angles = np.degrees(DATASETS["a"][f"lay_{member}"].values[[0, -1]])
        assert angles == pytest.approx(printed, abs=0.3)


@pytest.mark.parametrize("design", ["a", "b"])
def test_stored_start_of_relief_is_inclined_by_8_5_degrees(design):
    # Fig. 5.17, printed digit; "other lines have small systematic differences"
    dataset = DATASETS[design].sel(relieved="pinion")
    y, lines = dataset["y"].values, dataset["relief_line"].values
    leans = []
    for line in lines:
        at = int(np.argmin(np.abs(line)))
        if line.min() < 0.0 < line.max():  # crosses the contact line within the face
            rise = (line[at + 1] - line[at - 1]) / (y[at + 1] - y[at - 1])
            leans.append(math.degrees(math.atan(rise)))
    assert len(leans) > 4
    assert leans[0] == pytest.approx(8.5, abs=0.1)
    assert np.ptp(leans) < 0.5  # "small": far below the 5 degrees of fig. 7.4
    assert (np.diff(leans) > 0.0).all()  # the pinion's radius of curvature grows towards its tip


def departures(k, number):
    """y where the gap of design A leaves that of the crowns by a quarter micrometre [mm]."""
    dataset = DATASETS["a"].sel(shown=number, k=k)
    y = 1e3 * dataset["y"].values
    excess = dataset["line_gap_by_form"].values - dataset["crown_gap"].values
    inside = y[excess < 0.25e-6]
    return inside.min(), inside.max()


def test_linear_relief_becomes_apparent_where_section_5_2_reads_it():
    # 6.4 mm is the start itself, to a stored station and a quarter micrometre, 0.1 mm; the others
    # are read from a figure, whose relief zones miss their own formula: 1 mm
    assert departures(0.0, 1)[0] == pytest.approx(6.4, abs=0.1)
    low, high = departures(0.0, 2)
    assert high == pytest.approx(18.5, abs=1.0)
    assert low == pytest.approx(-21.5, abs=1.0)
    assert departures(0.0, 3)[1] == pytest.approx(-6.3, abs=1.0)


def test_relief_of_smaller_k_opens_the_gap_earlier():
    # (5.3)-(5.5): parabolas of k = 0.5 and 1 are as c_e/k^2 = 4/3 to 1; k = 0 is linear, above both
    line = DATASETS["a"].sel(shown=2)
    start = float(line["pinion_relief_start"])
    y = line["y"].values
    part = (y > start + 0.5e-3) & (y < start + 2.0e-3)  # less than half of the radial extent
    excess = (line["line_gap_by_form"] - line["crown_gap"]).transpose("k", "y").values[:, part]
    # 1e-3: a gap moves the section that it is measured in by sin(b) times itself
    assert excess[1] / excess[2] == pytest.approx(np.full(part.sum(), 4.0 / 3.0), rel=1e-3)
    assert (excess[0] > excess[1]).all()


def test_half_width_of_the_dry_contact_has_the_thesis_scale():
    """Chapter 7: dx = a/200 = 1.1886 um at 360 kN/m and R' = 14.0 mm; a goes as the root of both.

    0.5 percent: 360 and 14.0 are printed to 0.3 and 0.4 percent, halved by the root.
    """
    modulus = 0.5 * 227.5e9  # E* = E'/2 of the steel behind that step
    X = jamali_2015_steps("a").line(np.array([75, 300, 500]))
    dataset = geometry_dataset(
        jamali_2015("a"), torque=1060.0, pinion_speed=235.62, lines=X, steel_modulus=modulus
    )
    s_mid = float(dataset["shown_position"].sel(shown=2)) + 22e-3 * math.tan(base_helix())
    R = np.interp(s_mid, dataset["s"].values, dataset["R_normal"].values)
    per_length = dataset["line_load"].sel(**RELIEVED, convention="normal")
    load = np.interp(
        float(dataset["shown_position"].sel(shown=2)),
        dataset["position"].values, per_length.values,
    )  # fmt: skip
    scale = math.sqrt(load * R / (360e3 * 14.0e-3))
    assert float(dataset["hertz_half_width"]) == pytest.approx(200 * 1.1886e-6 * scale, rel=5e-3)


@pytest.mark.parametrize("design", ["a", "b"])
def test_gap_across_the_line_has_the_relative_radius_of_the_path(design):
    # (2.9), (2.10): h = x^2/(2 R) where neither crown nor relief reaches; R' changes by 3 percent
    # over the 0.7 mm across
    dataset = DATASETS[design]
    gap = dataset["surface_gap"].sel(surface_y=0.0, method="nearest")
    x = dataset["surface_x"].values
    s_mid = float(dataset["shown_position"].sel(shown=2)) + 22e-3 * math.tan(base_helix())
    R = np.interp(s_mid, dataset["s"].values, dataset["R_normal"].values)
    edge = x[[0, -1]] ** 2 / (2.0 * R)
    assert gap.values[[0, -1]] == pytest.approx(edge, rel=0.03)
    assert gap.values.min() == pytest.approx(0.0, abs=1e-12)


# name: unit, root mean square and largest amount; design A, recorded at version 0.1.0 in November
# 2026 where the tests of this file, of loads, gaps and lay angles held
RECORDED = {
    "length": ("m", 0.02646855, 0.04636371),
    "total_length": ("m", 0.05882832, 0.07254829),
    "load": ("N", 6942.481, 15192.3),
    "line_load": ("N/m", 254695.9, 376997),
    "period_length": ("m", 0.0587639, 0.07254829),
    "lines_in_contact": ("1", 2.323898, 3),
    "mean_length": ("m", 0.05875897, 0.07165945),
    "length_variation": ("1", 0.03812158, 0.04649114),
    "R_transverse": ("m", 0.01373223, 0.0144024),
    "R_normal": ("m", 0.01446994, 0.01517611),
    "R_pinion": ("m", 0.02903767, 0.0391724),
    "R_gear": ("m", 0.02991756, 0.04007284),
    "entrainment": ("m/s", 6.685642, 6.72309),
    "sliding": ("m/s", 2.907172, 5.032227),
    "slide_roll": ("1", 0.434862, 0.7569395),
    "lay_pinion": ("rad", 0.1243999, 0.1670567),
    "lay_pinion_limit": ("rad", 0.1237511, 0.1664001),
    "lay_gear": ("rad", 0.1231258, 0.1646012),
    "lay_gear_limit": ("rad", 0.1237572, 0.1652399),
    "lay_chord": ("m", 0.001, 0.001),
    "shown_position": ("m", 0.009883825, 0.0157),
    "end_z": ("m", 0.01841052, 0.022),
    "end_s": ("m", 0.007576858, 0.0108381),
    "unrelieved_s": ("m", 0.006351435, 0.006360942),
    "line_sliding": ("m/s", 2.655838, 5.030288),
    "hertz_half_width": ("m", 0.0002485588, 0.0002485588),
    "line_gap": ("m", 1.666102e-05, 6.822036e-05),
    "crown_gap": ("m", 6.806049e-06, 1.518429e-05),
    "pinion_relief_start": ("m", 0.02925486, 0.04674334),
    "gear_relief_start": ("m", 0.03046896, 0.04748523),
    "line_gap_by_form": ("m", 1.886608e-05, 6.822036e-05),
    "crown_form": ("m", 2.460413e-06, 7.592145e-06),
    "surface_gap": ("m", 1.032672e-05, 5.323137e-05),
    "surface_crown_start": ("1", 0.25, 0.25),
    "smooth_height": ("m", 2.677438e-06, 6.072971e-06),
    "faceted_height": ("m", 2.730681e-06, 6.205972e-06),
    "relief_removal": ("m", 3.107905e-05, 6.643127e-05),
    "relief_line": ("m", 0.004100907, 0.007510274),
    "relief_line_shown": ("1", 2, 2),
    "position": ("m", 0.01316786, 0.02617794),
    "phase": ("1", 0.5769172, 0.999),
    "s": ("m", 0.006261289, 0.0108381),
    "shown": ("1", 2.160247, 3),
    "y": ("m", 0.01339925, 0.02318185),
    "x": ("m", 0.0003490114, 0.0006035005),
    "k": ("1", 0.6454972, 1),
    "crown_start": ("1", 0.2949576, 0.45),
    "surface_x": ("m", 0.0003541908, 0.0006035005),
    "surface_y": ("m", 0.01353529, 0.02318185),
    "facets": ("1", 71.18052, 100),
    "level": ("1", 0.586302, 1),
}


def test_every_variable_has_its_unit_and_recorded_size():
    found = {n: v for n, v in DATASETS["a"].variables.items() if v.dtype.kind in "fiu"}
    assert sorted(found) == sorted(RECORDED)
    for name, (unit, mean, largest) in RECORDED.items():
        values = found[name].values[np.isfinite(found[name].values)].astype(float)
        assert found[name].attrs["units"] == unit, name
        # seven digits are recorded: half a unit of the last is at most 5e-7
        sizes = np.sqrt((values**2).mean()), np.abs(values).max()
        assert sizes == pytest.approx((mean, largest), rel=6e-7), name
