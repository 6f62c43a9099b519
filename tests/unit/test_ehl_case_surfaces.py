"""Heights from files and shapes in case files: what they add, and what is refused."""

import numpy as np
import pytest
import xarray as xr

from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

OIL = {"viscosity_pa_s": 0.02, "pressure_viscosity_per_gpa": 18.0}
SHARED = {"name": "own", "source": "test", "speed_1_m_s": 3.0, "speed_2_m_s": 0.0, "oil": OIL}
LINE = {
    **SHARED,
    "radius_mm": 20.0,
    "load_n_per_mm": 150.0,
    "domain": {"first_mm": -1.0, "last_mm": 0.5},
    "solver": {"nodes": 151},
}
POINT = {**SHARED, "radius_x_mm": 12.0, "radius_y_mm": 60.0, "load_n": 80.0}
STEP = 0.01  # mm, of the line's grid


def line(tmp_path, heights=None, text=None, x=None, **section):
    """A line case with a profile; `heights` of x in mm, in um."""
    x = np.arange(-1.1, 0.6, 0.8 * STEP) if x is None else x
    if text is None:
        text = "x_mm,height_um\n" + "\n".join(f"{a:.9g},{heights(a):.9g}" for a in x)
    (tmp_path / "profile.csv").write_text(text)
    file = tmp_path / "profile.csv"
    return LineCase.from_data({**LINE, "profile": {"file": str(file), **section}}, "own.toml")


def point(**changes):
    return PointCase.from_data({**POINT, **changes}, "own.toml")


def heights_of(case, x, y):
    """What a case takes off its smooth gap [m]."""
    return x * x / 0.024 + y * y / 0.12 - case.problem().gap(x, y)


def test_a_profile_narrows_the_parabola_by_its_heights(tmp_path):
    case = line(tmp_path, lambda x: 0.3 * np.cos(20.0 * x))
    x = np.linspace(-1e-3, 0.5e-3, 77)
    expected = x * x / 0.04 - 0.3e-6 * np.cos(20e3 * x)
    # a cubic spline through places 8 um apart: error below 5/384 A (k step)^4 = 3e-12 m
    np.testing.assert_allclose(case.problem().undeformed_gap(x), expected, atol=3e-12)


def test_a_profile_may_be_the_whole_gap(tmp_path):
    case = line(tmp_path, lambda x: 25.0 * x * x + 40.0 * max(x - 0.2, 0.0) ** 3, holds="gap")
    x = np.array([-0.9e-3, 0.0, 0.45e-3])
    expected = [20.25e-6, 0.0, 25e-6 * 0.45**2 + 40e-6 * 0.25**3]
    np.testing.assert_allclose(case.problem().undeformed_gap(x), expected, atol=1e-10)


def test_a_file_is_looked_for_beside_its_case(tmp_path):
    line(tmp_path, lambda x: 0.1)  # leaves profile.csv behind
    text = LineCase.shipped_text("jamali_2015")
    limits = "[domain]\nfirst_mm = -1.0\nlast_mm = 0.5\n"
    text = f'{text.replace("1001", "151")}\n{limits}[profile]\nfile = "profile.csv"\n'
    (tmp_path / "case.toml").write_text(text)
    gap = LineCase.from_toml(tmp_path / "case.toml").problem().undeformed_gap(np.zeros(1))
    assert gap[0] == pytest.approx(-0.1e-6)


@each(
    ("given", "words"),
    [
        ({"text": "x,z\n0,1\n"}, ["x_mm, height_um", "x, z"]),
        ({"text": "x_mm,height_um\n0,1\n1;2\n"}, ["line 3", "1;2", "has 1 of 2 columns"]),
        ({"text": "x_mm,height_um\n0,1\n1,2\n"}, ["at least 4"]),
        ({"text": "x_mm,height_um\n0,1\n1,2\n1,3\n2,3\n"}, ["rise", "1 mm"]),
        # from -1.1 mm in steps of 8 um: the 139th place, at 4 um, below the heading
        ({"heights": lambda x: np.nan if 0.0 < x < 0.02 else 0.0}, ["finite", "line 140", "'nan'"]),
        ({"heights": abs, "x": np.arange(-0.9, 0.6, STEP)}, ["-1 to 0.5 mm", "-0.9"]),
        ({"heights": abs, "x": np.arange(-1.1, 0.6, 2.0 * STEP)}, ["10 um", "20 um", "76 nodes"]),
    ],
)
def test_profiles_that_cannot_serve_are_refused(given, words, tmp_path):
    with pytest.raises(ParameterError) as refusal:
        line(tmp_path, **given)
    for word in [*words, "profile.csv"]:
        assert word in str(refusal.value)


def test_a_missing_file_is_named(tmp_path):
    for model, data, section in ((LineCase, LINE, "profile"), (PointCase, POINT, "height_map")):
        file = str(tmp_path / "none.csv")
        with pytest.raises(ParameterError, match=r"none\.csv was not found in "):
            model.from_data({**data, section: {"file": file}}, "own")


def a_map(case):
    """Places that reach a little beyond the domain of a case [mm], and heights over them [um]."""
    problem = case.problem()
    x, y = (
        1e3 * np.linspace(a[0] - 1e-5, a[-1] + 1e-5, 2 * a.size) for a in (problem.x, problem.y)
    )
    return x, y, 0.2 * np.sin(4.0 * x)[:, None] * np.cos(2.0 * y)[None, :]


@pytest.mark.parametrize("kind", ["x first", "y first", "npz"])
def test_a_height_map_narrows_the_gap(kind, tmp_path):
    x, y, height = a_map(point())
    if kind == "npz":
        path = tmp_path / "map.npz"
        np.savez(path, x=x, y=y, height=height)
    else:
        path = tmp_path / "map.nc"
        array = xr.DataArray(height, coords={"x": x, "y": y}, dims=("x", "y"))
        array = array if kind == "x first" else array.transpose("y", "x")
        array.to_dataset(name="height").to_netcdf(path, engine="scipy")
    case = point(height_map={"file": str(path)})
    px, py = np.linspace(-1e-4, 2e-4, 5)[:, None], np.linspace(-3e-4, 1e-4, 4)[None, :]
    expected = 0.2e-6 * np.sin(4e3 * px) * np.cos(2e3 * py)
    np.testing.assert_allclose(heights_of(case, px, py), expected, atol=1e-12)


def test_maps_that_cannot_serve_are_refused(tmp_path):
    x, y, height = a_map(point())
    wrong = {
        "shape": ({"x": x, "y": y, "height": height.T[:-1]}, "shape"),
        "missing": ({"x": x, "y": y}, "height is not a file|'height.* is missing"),
        "narrow": ({"x": 0.5 * x, "y": y, "height": height}, "cover the domain"),
        "coarse": ({"x": x[::8], "y": y, "height": height[::8]}, "as fine as the grid along x"),
        "holes": (
            {"x": x, "y": y, "height": np.where(height > -1e3, np.nan, height)},
            "may be missing",
        ),
    }
    wrong["coarse"][0]["x"] = np.linspace(x[0], x[-1], x[::8].size)
    for name, (arrays, words) in wrong.items():
        path = tmp_path / f"{name}.npz"
        np.savez(path, **arrays)
        with pytest.raises(ParameterError, match=words):
            point(height_map={"file": str(path)})
    (tmp_path / "text.nc").write_text("no NetCDF")
    with pytest.raises(ParameterError, match=r"text\.nc is not a readable NetCDF"):
        point(height_map={"file": str(tmp_path / "text.nc")})


def test_ridge_dent_and_waves_are_where_they_should_be():
    ridge = {"height_um": 0.4, "width_mm": 0.1, "x_mm": 0.05, "direction_deg": 90.0}
    dent = {"depth_um": 0.5, "width_mm": 0.2, "y_mm": -0.2}
    waves = {"amplitude_um": 0.2, "wavelength_mm": 0.4, "direction_deg": 90.0}
    one, other = np.array([0.05e-3, 0.1e-3]), np.array([0.3e-3, 0.3e-3])
    # crest and half height of the ridge, along the whole of it
    np.testing.assert_allclose(heights_of(point(ridge=ridge), one, other), [0.4e-6, 0.2e-6])
    turned = point(ridge={**ridge, "direction_deg": 0.0, "x_mm": 0.0, "y_mm": 0.3})
    np.testing.assert_allclose(heights_of(turned, one, other), [0.4e-6, 0.4e-6])
    x, y = np.array([0.0, 0.1e-3, 0.0]), np.array([-0.2e-3, -0.2e-3, -0.3e-3])
    np.testing.assert_allclose(heights_of(point(dent=dent), x, y), [-0.5e-6, -0.25e-6, -0.25e-6])
    y = np.array([0.0, 0.1e-3, 0.2e-3])
    np.testing.assert_allclose(
        heights_of(point(waviness=waves), x, y), [0.2e-6, 0.0, -0.2e-6], atol=1e-17
    )
    together = heights_of(point(ridge=ridge, dent=dent, waviness=waves), x, y)
    apart = (heights_of(point(**{k: v}), x, y) for k, v in
             (("ridge", ridge), ("dent", dent), ("waviness", waves)))  # fmt: skip
    np.testing.assert_allclose(together, sum(apart), atol=1e-17)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"waviness": {"amplitude_um": 0.1, "wavelength_mm": 0.03}}, ["8 nodes along x", "0.03"]),
        ({"ridge": {"height_um": 0.1, "width_mm": 0.01}}, ["ridge.width", "4 nodes along x"]),
        ({"dent": {"depth_um": 0.1, "width_mm": 0.05}}, ["dent.width", "along y"]),
        ({"dent": {"depth_um": 0.1}}, ["dent.width_mm is missing"]),
    ],
)
def test_shapes_that_the_grid_cannot_show_are_refused(changes, words):
    with pytest.raises(ParameterError) as refusal:
        point(**changes)
    for word in words:
        assert word in str(refusal.value)
