"""Measured-gear files and their CSV files: what is read, and what is refused with which words."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube.output.toml_text import toml_text
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.hypoid_geometry.measured.deviation_grid import COLUMNS
from gearlube_core.hypoid_geometry.measured.measured_flanks import read_measured_flanks

FILE = """name = "axle_17"
source = "made for a test"
gear_file = "mohammadpour_2015"
deviations = "deviations.csv"
{more}
[gear.grid]
rows = 5
columns = 9
root_inset_mm = 1.5
tip_inset_mm = 0.6
toe_inset_mm = 2.5
heel_inset_mm = 2.5
"""
HEAD = ",".join(COLUMNS)
HEIGHT, WIDTH = 7.615, 29.999  # mm, of the gear's flank


def deviation(i, j):
    """Points i, j of row and column, counted from 0 [um]: a plane, 8 um from toe to heel."""
    return float(j - 4 + 2 * (i - 2))


def lines(flank="drive", tooth=1):
    return [
        f"gear,{flank},{tooth},{i + 1},{j + 1},{deviation(i, j)}"
        for i in range(5)
        for j in range(9)
    ]


@pytest.fixture
def folder(tmp_path):
    def write(rows, more="", head=HEAD):
        (tmp_path / "axle.toml").write_text(FILE.format(more=more))
        (tmp_path / "deviations.csv").write_text("\n".join(["# made", head, *rows]) + "\n")
        return tmp_path / "axle.toml"

    return write


def test_a_tilted_flank_becomes_a_removal_of_the_other_sign_on_its_own_flank(folder):
    found = read_measured_flanks(folder([*lines(), *lines(tooth=9), *lines("concave", 3)]))
    assert found.grids["gear", "drive"].teeth == (1, 9)
    assert found.grids["gear", "coast"].teeth == (3,)
    file = found.gear_file()
    # rows from root to tip, columns from toe to heel, between the insets
    s = (1.5 + np.arange(5) / 4 * (HEIGHT - 2.1)) / HEIGHT
    t = (2.5 + np.arange(9) / 8 * (WIDTH - 5.0)) / WIDTH
    got = file.correction("gear", "drive").bends(s[:, None], t[None, :], 1.0, 1.0).value
    want = -1e-6 * np.array([[deviation(i, j) for j in range(9)] for i in range(5)])
    np.testing.assert_allclose(got, want, atol=2e-9)  # heights above are rounded to a micrometre
    assert file.correction("pinion", "drive").is_none


def test_the_gear_file_goes_through_toml_and_adds_to_what_is_there(folder, tmp_path):
    once = read_measured_flanks(folder(lines(), "degree = 1")).gear_file()
    path = tmp_path / "measured.toml"
    path.write_text(toml_text(once.model_dump(exclude_defaults=True)))
    assert HypoidGearFile.from_toml(path) == once
    again = read_measured_flanks(folder(lines(), "degree = 2"))
    twice = again.file.model_copy(update={"gear_file": str(path)}).nominal()
    both = replace(again, nominal=twice).gear_file().correction("gear", "drive").surface
    one = once.correction("gear", "drive").surface
    np.testing.assert_allclose(both[:3], 2.0 * np.array(one), atol=1e-12)


def wrong(rows, index, line):
    return [*rows[:index], line, *rows[index + 1 :]]


@pytest.mark.parametrize(
    ("rows", "parts"),
    [
        (lines()[:-3], ["gear, drive flank, tooth 1: all 5 x 9 points", "3 are missing", "5, 7"]),
        ([*lines(), lines()[4]], ["line 48", "point 1, 5", "occurs twice"]),
        ([*lines(), *lines("convex")], ["occurs twice", "or check flank and tooth"]),
        (wrong(lines(), 3, "gear,left,1,1,4,2.0"), ["flank must be drive, coast", "got 'left'"]),
        (wrong(lines(), 3, "ring,drive,1,1,4,2.0"), ["member must be pinion or gear, got 'ring'"]),
        (wrong(lines(), 3, "pinion,drive,1,1,4,2.0"), ["Add the section [pinion.grid], or its"]),
        (wrong(lines(), 3, "gear,drive,1,1,10,2.0"), ["line 6: column must be", "from 1 to 9"]),
        (wrong(lines(), 3, "gear,drive,1,1,4,2000"), ["within -500 to 500 um, got '2000'"]),
        (wrong(lines(), 3, "gear,drive,1,1,4,2,5"), ["line 6: has 7 of 6 columns"]),
        (
            wrong(lines(), 22, "gear,drive,1,3,5,1.5"),
            ["middle point must be 0 within 0.05 um, got 1.5 um", 'middle_point = "measured"'],
        ),
        (
            [f"{one.rpartition(',')[0]},{1e-3 * float(one.rpartition(',')[2])}" for one in lines()],
            ["must be 0 or at least 0.1 um, got 0.008 um", "Is it in mm? 0.008 mm is 8 um"],
        ),
        ([], ["at least 1 row of values"]),
    ],
)
def test_wrong_measured_data_are_refused_with_line_value_and_cure(folder, rows, parts):
    with pytest.raises(ParameterError) as caught:
        read_measured_flanks(folder(rows))
    for part in parts:
        assert part in str(caught.value), str(caught.value)


def test_another_layout_is_refused_by_its_first_line(folder):
    with pytest.raises(ParameterError, match=r"must have the columns member, flank, tooth, row"):
        read_measured_flanks(folder(lines(), head="x_mm,y_mm,z_mm"))


def test_a_middle_point_that_is_not_zero_may_stay(folder):
    rows = wrong(lines(), 22, "gear,drive,1,3,5,1.5")
    found = read_measured_flanks(folder(rows, 'middle_point = "measured"'))
    assert found.grids["gear", "drive"].deviation[0, 2, 4] == pytest.approx(1.5e-6)


def test_too_high_a_degree_and_insets_beyond_the_flank_are_refused(folder):
    with pytest.raises(ParameterError, match=r"degree 5 must have more than 5 rows .* got 5 x 9"):
        read_measured_flanks(folder(lines(), "degree = 5"))
    path = folder(lines())
    path.write_text(path.read_text().replace("root_inset_mm = 1.5", "root_inset_mm = 5.0"))
    with pytest.raises(ParameterError, match=r"gear: root_inset_mm and tip_inset_mm must be at"):
        read_measured_flanks(path)


def test_a_gear_file_with_a_wrong_number_of_coefficients_is_refused():
    file = HypoidGearFile.named("mohammadpour_2015")
    with pytest.raises(ParameterError, match=r"surface_um must hold 1, 3, 6, .* got 4"):
        file.varied({"gear.drive_flank.surface_um": [1.0, 2.0, 3.0, 4.0]})
