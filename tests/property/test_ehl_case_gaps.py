"""The same gap said in two ways has the same film."""

import numpy as np
import pytest

from gearlube_core.ehl.case.contact_case import LineCase, PointCase
from gearlube_core.ehl.line.solver import solve_line
from gearlube_core.ehl.point.solver import solve_point_contact

OIL = {"viscosity_pa_s": 0.02, "pressure_viscosity_per_gpa": 18.0}
SHARED = {"name": "own", "source": "test", "speed_1_m_s": 3.0, "speed_2_m_s": 1.0, "oil": OIL}


@pytest.mark.parametrize("holds", ["heights", "gap"])
def test_a_profile_turns_one_cylinder_into_another(holds, tmp_path):
    base = {
        **SHARED,
        "load_n_per_mm": 150.0,
        "domain": {"first_mm": -1.0, "last_mm": 0.5},
        "solver": {"nodes": 301},
    }
    x = np.linspace(-1.0, 0.5, 601)
    gap = 1e3 * x**2 / (2.0 * 25.0)
    column = gap if holds == "gap" else 1e3 * x**2 / (2.0 * 20.0) - gap
    np.savetxt(tmp_path / "p.csv", np.stack([x, column], 1), "%.12g", ",", header="x_mm,height_um",
               comments="")  # fmt: skip
    profile = {"file": str(tmp_path / "p.csv"), "holds": holds}
    said = LineCase.from_data({**base, "radius_mm": 20.0, "profile": profile}, "said")
    meant = LineCase.from_data({**base, "radius_mm": 25.0}, "meant")
    one, other = (solve_line(case.problem(), case.settings()) for case in (said, meant))
    # both to 1e-8 of the flow; the radius that scales differs
    np.testing.assert_allclose(one.film, other.film, rtol=1e-6)
    np.testing.assert_allclose(one.pressure, other.pressure, atol=1e-6 * other.maximum_pressure)


def test_a_map_turns_one_ball_into_another(tmp_path):
    base = {
        **SHARED, "radius_y_mm": 12.0, "load_n": 20.0, "solver": {"nodes_x": 33, "nodes_y": 33}
    }  # fmt: skip
    # oil beyond a domain lies between the solids of its radii, so neither has any
    flat = {**base, "radius_x_mm": 12.0, "domain": {"oil_beyond": False}}
    meant = PointCase.from_data(flat, "meant").problem()
    x, y = meant.x, meant.y
    height = x[:, None] ** 2 / 0.020 - x[:, None] ** 2 / 0.024 + 0.0 * y
    np.savez(tmp_path / "map.npz", x=1e3 * x, y=1e3 * y, height=1e6 * height)
    # domain in semi-axes of another dry contact: that of the ball which is meant
    own = PointCase.from_data({**base, "radius_x_mm": 10.0}, "own").problem()
    a_x, a_y, _ = own.hertz_contact
    domain = {"inlet": -x[0] / a_x, "outlet": x[-1] / a_x, "side": y[-1] / a_y}
    section = {"file": str(tmp_path / "map.npz")}
    said = PointCase.from_data(
        {**base, "radius_x_mm": 10.0, "domain": domain, "height_map": section}, "said"
    )
    np.testing.assert_allclose(said.problem().x, x, atol=1e-12)
    one, other = (solve_point_contact(p, said.settings()) for p in (said.problem(), meant))
    # both to 1e-6 of the flow; Newton's last step leaves less
    np.testing.assert_allclose(one.film, other.film, rtol=1e-5)
    np.testing.assert_allclose(one.pressure, other.pressure, atol=1e-5 * other.maximum_pressure)


@pytest.mark.slow
def test_a_ridge_along_the_motion_thins_the_film_on_its_crest_alone():
    base = {
        **SHARED,
        "radius_x_mm": 12.0, "radius_y_mm": 12.0, "load_n": 20.0,
        "solver": {"nodes_x": 65, "nodes_y": 65},
    }  # fmt: skip
    ridge = {"height_um": 0.15, "width_mm": 0.08, "direction_deg": 0.0}
    smooth, rough = (
        PointCase.from_data({**base, **more}, "own") for more in ({}, {"ridge": ridge})
    )
    films, pressures = [], []
    for case in (smooth, rough):
        found = solve_point_contact(case.problem(), case.settings())
        films.append(found.film[32])
        pressures.append(found.pressure[32])
        assert np.allclose(found.film, found.film[:, ::-1], rtol=1e-5)  # symmetric to the crest
    # solids flatten the ridge under more pressure, and it never thins the film by its height
    assert pressures[1][32] > 1.05 * pressures[0][32]
    assert 0.0 < films[0][32] - films[1][32] < 0.15e-6
