"""Tables of measurements, and their residuals against the results of a run."""

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from gearlube.command import COMMANDS, command_line
from gearlube.report.measured_run import compared, comparison_with_measured, residuals_text
from gearlube_core.errors import ParameterError
from gearlube_core.film.point_film import central_film_thickness, film_geometry
from gearlube_core.input_file.measurements import read_measurements
from gearlube_core.oil.oil_file import read_oil
from gearlube_core.storage.atomic_file import write_dataset

HEAD = "speed_rpm,torque_n_m,temperature_degc,torque_loss_n_m,uncertainty_n_m"


def table(folder, text, name="loss.csv"):
    path = folder / name
    path.write_text(text)
    return path


def loss_map(folder):
    """Write a map whose loss is linear in all axes: 1 + rpm/1000 + torque/100 + degC/100 N.m."""
    axes = {
        "temperature": [40.0, 60.0],
        "speed": [1000.0, 2000.0, 500.0],  # as a bearing study may have them
        "torque": [0.0, 50.0, 100.0],
    }
    T, n, M = np.meshgrid(*axes.values(), indexing="ij")
    loss = 1.0 + n / 1000.0 + M / 100.0 + T / 100.0
    grid = tuple(axes)
    swing = np.array([np.full_like(loss, 0.5), 0.5 * n / 1000.0])
    dataset = xr.Dataset(
        {
            "loss_torque": (grid, loss, {"units": "N.m"}),
            "loss_torque_low": (grid, loss - 0.3),
            "loss_torque_high": (grid, loss + 0.4),
            "swing": (("input", *grid), swing),
        },
        coords={**axes, "input": ["seals", "churning"]},
    )
    folder.mkdir(exist_ok=True)
    write_dataset(dataset, folder / "map.nc")
    return folder


def test_efficiency_of_drive_and_coast_is_the_loss_over_the_input(tmp_path):
    path = table(
        tmp_path,
        "speed_rpm,torque_n_m,temperature_degc,efficiency_percent,uncertainty_percent\n"
        "1000,100,60,96,0.5\n1000,-100,60,80,1\n",
    )
    found = read_measurements(path)
    # drive: 4 % of 100 N.m. Coast: 100 N.m at the pinion are 80 % of 125 N.m from the wheels
    np.testing.assert_allclose(found.value, [4.0, 25.0], rtol=1e-12)
    # half a point of percent of 100 N.m; slope 100 N.m/0.8^2 per unit of efficiency
    np.testing.assert_allclose(found.uncertainty, [0.5, 1.5625], rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("speed_rpm,torque_n_m,temperature_degc,torque_loss,uncertainty_n_m\n1,1,1,1,1\n", "_n_m"),
        ("speed_rpm,torque_n_m,temperature_degc,torque_loss_n_m\n1,1,1,1\n", "k = 2"),
        ("speed,torque_n_m,torque_loss_n_m,uncertainty_n_m\n1,1,1,1\n", "missing: speed_rpm"),
        (f"{HEAD.replace('uncertainty_n_m', 'uncertainty_percent')}\n9,9,9,0,1\n", "must not be 0"),
        (f"{HEAD}\n1000,50,60,2,0\n", "line 2: uncertainty_n_m"),
        (f"{HEAD}\n1000,50,900,2,1\n", "within -60 to 250 degC, got '900'"),
        (f"{HEAD}\n1000,50,60,2,1\n", "at least 3 rows"),
    ],
)
def test_tables_without_unit_uncertainty_or_enough_points_are_refused(tmp_path, text, words):
    fewest = 3 if "3 rows" in words else 1
    with pytest.raises(ParameterError, match="must") as error:
        read_measurements(table(tmp_path, text), fewest=fewest)
    assert words in str(error.value)


def test_residuals_of_a_linear_map_are_exact_between_its_points(tmp_path):
    folder = loss_map(tmp_path / "run")
    # the linear loss at these places is 2.99, 4.2, 1.9 N.m; residuals 0.4, -0.1, 0 N.m
    path = table(
        tmp_path,
        f"{HEAD}\n750,74,50,3.39,0.3\n1900,80,50,4.1,0.3\n500,0,40,1.9,0.4\n3000,0,40,9,1\n",
    )
    found = compared(folder, read_measurements(path))
    np.testing.assert_allclose(found.residual, [0.4, -0.1, 0.0], atol=1e-12)
    # the bar towards the measured value: above 0.4 N.m, below 0.3 N.m
    expected = [0.4 / np.hypot(0.3, 0.4), -0.1 / np.hypot(0.3, 0.3)]
    np.testing.assert_allclose(found.en[:2], expected, rtol=1e-12)
    assert found.share_inside == 1.0
    assert "line 5 (speed 3000 rpm" in found.left_out
    assert "speed 500 to 2000 rpm" in found.left_out
    assert residuals_text(found).splitlines()[0].endswith("residual_n_m,en")


def test_the_input_that_made_the_residuals_explains_them(tmp_path):
    folder = loss_map(tmp_path / "run")
    rows = [(n, M, T) for n in (600, 1200, 2000) for M in (10, 90) for T in (40, 60)]
    # 0.8 of the bar of the churning, which grows with the speed
    lines = [
        f"{n},{M},{T},{1 + n / 1000 + M / 100 + T / 100 + 0.4 * n / 1000},0.02" for n, M, T in rows
    ]
    found = compared(folder, read_measurements(table(tmp_path, "\n".join([HEAD, *lines]))))
    (name, (share, part)), (other, (less, _)) = found.explained.items()
    assert (name, other) == ("churning", "seals")
    assert share > 0.999
    assert part == pytest.approx(0.8, rel=1e-3)  # the prior pulls by the square of 0.02/0.5
    assert less < 0.9


def test_points_outside_the_run_are_named_and_too_few_left_are_refused(tmp_path):
    folder = loss_map(tmp_path / "run")
    path = table(tmp_path, f"{HEAD}\n750,74,50,3,1\n800,74,50,3,1\n9000,0,40,2,1\n700,0,90,2,1\n")
    with pytest.raises(ParameterError, match=r"At least 3 points.*got 2 of 4.*line 4.*line 5"):
        compared(folder, read_measurements(path))
    head = "speed_rpm,axial_load_n,radial_load_n,temperature_degc,friction_torque_n_m"
    of_bearing = read_measurements(table(tmp_path, f"{head},uncertainty_percent\n1,1,1,1,1,1\n"))
    with pytest.raises(ParameterError, match="gearlube bearing"):
        compared(folder, of_bearing)


def test_a_transmission_error_of_one_order_is_found_as_that_order(tmp_path):
    phase = np.arange(20) / 20.0
    rotation = 1e-3 + 1e-6 * np.outer([3.0, 5.0], np.cos(4.0 * np.pi * phase))  # order 2
    dataset = xr.Dataset(
        {"rotation": (("side", "torque", "phase"), rotation[None])},
        coords={"side": ["drive"], "torque": [50.0, 100.0], "phase": phase},
    )
    write_dataset(dataset, tmp_path / "contact.nc")
    path = table(
        tmp_path,
        "torque_n_m,order,transmission_error_urad,uncertainty_percent\n"
        "50,2,3.3,10\n75,2,4,10\n100,1,0.1,10\n",
    )
    found = compared(tmp_path, read_measurements(path))
    np.testing.assert_allclose(found.predicted, [3.0, 4.0, 0.0], atol=1e-9)
    numbers = {one.name: one.value for one in comparison_with_measured(found, "run").numbers}
    assert numbers["bias over what is predicted"] == pytest.approx(5.0)  # of 10 and 0 %


def test_the_command_writes_report_table_and_figure(tmp_path):
    folder = loss_map(tmp_path / "run")
    path = table(tmp_path, f"{HEAD}\n750,74,50,3,1\n800,74,50,3,1\n700,0,40,2,1\n")
    out = tmp_path / "out"
    done = CliRunner().invoke(
        command_line(COMMANDS), ["compare", str(folder), str(path), "--out", str(out)]
    )
    assert done.exit_code == 0, done.output
    assert {"report.html", "residuals.csv", "figures"} <= {one.name for one in out.iterdir()}
    assert "3 of 3 points are within the bars" in (out / "report.html").read_text()


@pytest.mark.slow
def test_films_of_a_case_are_solved_where_they_were_measured(tmp_path):
    rows = ["0.4,20,40,259,10", "0.8,20,40,430,10", "1.6,20,40,700,10", "0.8,20,60,220,10"]
    head = "entrainment_m_s,load_n,temperature_degc,central_film_nm,uncertainty_percent"
    path = table(tmp_path, "\n".join([head, *rows]))
    case = tmp_path / "ball.toml"
    case.write_text(
        'name = "ball"\nsource = "made up"\nradius_x_mm = 9.525\nradius_y_mm = 9.525\n'
        "load_n = 1.0\nspeed_1_m_s = 1.0\nspeed_2_m_s = 1.0\nreduced_modulus_gpa = 124.0\n"
        '[oil]\nlibrary = "fva_3"\nshear = "newtonian"\n'
        "[solver]\nnodes_x = 65\nnodes_y = 65\n"
    )
    found = compared(case, read_measurements(path))
    oil = read_oil("fva_3").lubricant
    states = [oil.state(273.15 + one) for one in (40.0, 40.0, 40.0, 60.0)]
    # E' of the case is 2 E*
    formula = [
        1e9 * central_film_thickness(R_e, side, s.eta0, s.alpha, u, 20.0, 124e9)
        for (R_e, side), s, u in zip(
            [film_geometry(9.525e-3, 9.525e-3, 0.0)] * 4, states, (0.4, 0.8, 1.6, 0.8), strict=True
        )
    ]
    # the formula is within 20 % of solved films
    np.testing.assert_allclose(found.predicted, formula, rtol=0.2)
    slope = np.polyfit(np.log([0.4, 0.8, 1.6]), np.log(found.predicted[:3]), 1)[0]
    assert slope == pytest.approx(0.68, abs=0.03)  # of all formulas of films
    # by the batch of the oil and its alpha; the grid adds to it
    least = np.exp(np.hypot(0.67 * np.log(1.08), 0.53 * np.log(oil.alpha_factor or 1.15)))
    assert (found.high / found.predicted >= least).all()
    assert residuals_text(found).splitlines()[0].endswith("residual_nm,en")
    with pytest.raises(ParameterError, match="uncertainty_nm or uncertainty_percent"):
        read_measurements(table(tmp_path, f"{head[:-20]}\n0.1,20,40,100\n"))
