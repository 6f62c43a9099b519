"""Films on the drive flank over a mesh period: ellipses on the tooth, films of the axle."""

import numpy as np
import pytest
import xarray as xr
from PIL import Image

import gearlube as gl
from gearlube.plotting.drawn_tooth import DrawnTooth, ellipse
from gearlube.studies.contact.film_option import (
    FilmRequest,
    _places,
    animate_films,
    axle_around,
    film_request,
    flank_films,
)
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.contact_kinematics import path_kinematics
from gearlube_core.hypoid_contact.contact_path import contact_path
from gearlube_core.oil.walther_1931 import walther_kinematic_viscosity
from tests.helpers.contact_cases import ON_TEETH, shipped_file, shipped_pair

PAIRS = np.array([-1, 0, 1])
PHASES = np.arange(4) / 4
TORQUE = 50.0  # N.m, of the shipped mesh table


@pytest.fixture(scope="module")
def contact():
    """A contact analysis whose centres of force lie on the unloaded path."""
    pair = shipped_pair("drive")
    life = PHASES[:, None] + PAIRS
    inside = (life > ON_TEETH["drive"][0]) & (life < ON_TEETH["drive"][1])
    path = contact_path(pair, life[inside] * pair.gear_pitch)
    k = path_kinematics(path)
    dims = ("side", "phase", "torque", "pair")

    def laid(values):
        full = np.full((*inside.shape, *values.shape[1:]), np.nan)
        full[inside] = values
        return np.expand_dims(full, (0, 2))

    scalars = {"gear_s": path.gear_s, "gear_t": path.gear_t, "R_x": k.R_x, "R_y": k.R_y}
    return xr.Dataset(
        {name: (dims, laid(values)) for name, values in scalars.items()}
        | {"minor_axis": ((*dims, "axis"), laid(k.minor_axis))},
        coords={"side": ["drive"], "phase": PHASES, "torque": [TORQUE], "pair": PAIRS},
        attrs={"gear_file": shipped_file().model_dump_json()},
    )


@pytest.fixture(scope="module")
def films(contact):
    oil = gl.Lubricant.named("mohammadpour_2015")
    request = FilmRequest(speed=gl.rpm_to_rads(2000), oil=oil, oil_temperature=363.15)
    return flank_films(contact, gl.mohammadpour_2015_axle().mesh, request, pictures=8)


def test_a_step_along_an_axis_on_the_drawn_tooth_is_that_step_in_space(contact):
    pair = shipped_pair("drive")
    part = contact.isel(side=0, torque=0)
    places = _places(part)
    step = 1e-5  # m; flanks bend by 1e-5**2 / 20 mm in it, 5e-9 m
    for phase, (t, s), minor, major in zip(
        places["phase"], places["centre"], places["minor"], places["major"], strict=True
    ):
        one = part.sel(phase=phase % 1.0, pair=np.floor(phase))
        here = [t, t + step * minor[0], t + step * major[0]]
        up = [s, s + step * minor[1], s + step * major[1]]
        r = pair.gear.sample(np.array(up), np.array(here)).r
        _, moved = pair.gear_in_place(phase * pair.gear_pitch, r, r - r[0])
        assert moved[1] == pytest.approx(step * one["minor_axis"].values, abs=2e-8)
        assert np.linalg.norm(moved[2]) == pytest.approx(step, abs=2e-8)
        assert moved[2] @ moved[1] == pytest.approx(0.0, abs=2e-8 * step)


def test_pressure_over_an_ellipse_carries_its_load(films, contact):
    places = _places(contact.isel(side=0, torque=0))
    loaded = films.load > 0.0
    sizes = [
        np.linalg.norm(drawn, axis=-1)
        / np.linalg.norm(
            np.stack([np.interp(films.phase, places["phase"], c) for c in places[name].T], -1),
            axis=-1,
        )
        for name, drawn in (("minor", films.minor), ("major", films.major))
    ]
    # volume of half an ellipsoid
    carried = 2.0 / 3.0 * np.pi * sizes[0] * sizes[1] * films.pressure
    assert carried[loaded] == pytest.approx(films.load[loaded], rel=1e-9)
    assert (sizes[0] < sizes[1])[loaded].all()


def test_pairs_follow_each_other_a_mesh_period_apart_and_films_are_thin(films):
    apart = np.diff(np.sort(films.phase, axis=1), axis=1)
    assert apart == pytest.approx(1.0, abs=1e-9)
    film = films.film[films.load > 0.0]
    assert (film > 1e-8).all()
    assert (film < 5e-6).all()


@pytest.mark.slow
def test_the_animation_has_a_picture_for_each_time_and_is_small(films, contact, tmp_path):
    path = animate_films(films, DrawnTooth.of_dataset(contact), tmp_path)
    with Image.open(path) as picture:
        assert picture.n_frames == 8
    assert path.stat().st_size < 2e6


def test_data_of_an_earlier_version_and_speeds_out_of_range_are_refused(films, contact):
    mesh = gl.mohammadpour_2015_axle().mesh
    with pytest.raises(ParameterError, match="Run `gearlube contact` again"):
        flank_films(contact.drop_vars("minor_axis"), mesh, films.request)
    with pytest.raises(ParameterError, match="rpm"):
        FilmRequest(speed=0.1, oil=films.request.oil, oil_temperature=363.15)


@pytest.fixture
def own_axle(tmp_path):
    path = tmp_path / "own.toml"
    (tmp_path / "not_analysed.toml").touch()
    path.write_text(
        """
        [gear_set]
        gear_file = "not_analysed.toml"

        [pinion]
        mass_kg = 3.0

        [pinion.bearing]
        preload_n = 500.0

        [oil]
        viscosity_40_degc_mm2_s = 320.0
        viscosity_100_degc_mm2_s = 32.0
        """
    )
    return str(path)


def test_an_axle_file_gives_masses_bearings_and_oil_but_not_its_gears(own_axle):
    mesh = gl.mohammadpour_2015_axle().mesh
    axle = axle_around(own_axle, mesh)
    assert axle.pinion_mass == 3.0
    assert axle.mesh is mesh
    request = film_request(2000.0, None, None, own_axle)
    assert walther_kinematic_viscosity(
        request.oil.walther_a, request.oil.walther_b, 313.15
    ) == pytest.approx(320e-6, rel=1e-6)
    paper = gl.Lubricant.named("mohammadpour_2015")
    assert film_request(2000.0, "mohammadpour_2015", None, own_axle).oil == paper


def test_films_are_those_of_the_named_axle(films, contact, own_axle):
    mesh = gl.mohammadpour_2015_axle().mesh
    thick = flank_films(contact, mesh, film_request(2000.0, None, 90.0, own_axle), pictures=8)
    loaded = (films.load > 0.0) & (thick.load > 0.0)
    # 320 in place of 109 mm2/s at 40 degC: 1.92 times as viscous at 90 degC; films rise by the
    # power 0.67 of it. The other masses shift loads by some N, films by 1 %
    oils = thick.request.oil, films.request.oil
    viscosity = [one.dynamic_viscosity(363.15) for one in oils]
    assert viscosity[0] / viscosity[1] == pytest.approx(1.92, rel=1e-3)
    ratio = thick.film[loaded] / films.film[loaded]
    assert ratio.mean() == pytest.approx(1.92**0.67, rel=0.02)
    soft = film_request(2000.0, "mohammadpour_2015", 90.0, own_axle)
    other = flank_films(contact, mesh, soft, pictures=8)
    assert np.abs(other.load[loaded] - films.load[loaded]).max() > 1.0  # N, from the masses


def test_an_axle_without_films_or_a_wrong_one_is_refused(tmp_path):
    with pytest.raises(ParameterError, match=r"--axle my\.toml is only for --films-rpm"):
        film_request(None, None, None, "my.toml")
    wrong = tmp_path / "wrong.toml"
    wrong.write_text('[gear_set]\nmesh_table = "mohammadpour_2015"\n[pinion]\nmas_kg = 3.0\n')
    with pytest.raises(ParameterError, match="mas_kg"):
        film_request(2000.0, None, None, str(wrong))


def test_a_drawn_ellipse_has_its_centre_and_semi_axes():
    """Semi-axes of 2 times 0.6, 0.8 and -1.6, 1.2: twice (1, 2) along two directions."""
    x, y = ellipse(np.array([5.0, 7.0]), np.array([0.6, 0.8]), np.array([-1.6, 1.2]), size=2.0)
    along = 0.6 * (x - 5.0) + 0.8 * (y - 7.0)
    across = -0.8 * (x - 5.0) + 0.6 * (y - 7.0)
    assert (along / 2.0) ** 2 + (across / 4.0) ** 2 == pytest.approx(np.ones(x.size))
    assert (np.ptp(along), np.ptp(across)) == pytest.approx((4.0, 8.0), rel=0.01)
