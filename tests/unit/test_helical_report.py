"""Summary, tables and inputs of a helical pair: known answers."""

from types import SimpleNamespace

import numpy as np

from gearlube.plotting.style import new_figure
from gearlube.studies.helical.figures.layout import stems
from gearlube.studies.helical.report import _critical_speeds, _inputs, _losses
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.summary import summary_rows
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from tests.helpers.helical_results import (
    RPM,
    TEETH,
    everything,
    losses,
    stability,
)
from tests.helpers.known_answers import assert_cells, assert_tables


def test_a_study_has_its_known_rows_of_the_summary():
    of = everything()
    of["contact"] = of["contact"].assign(
        K_tangent=1.1 * of["contact"]["K"], corner_share=0.07 + 0.0 * of["contact"]["K"]
    )
    of["contact"].attrs["iso_mesh_stiffness"] = 4.2e8
    moves = {
        name: ("phase", [0.0, (k + 2) * scale])
        for scale, names in (
            (1e-6, ("delta_z", "u_xp", "u_yp", "u_zp")),
            (10.0, ("F_xp", "F_yp", "F_zp")),
        )
        for k, name in enumerate(names)
    }
    of["response"] = of["response"].assign(moves).assign(friction_power=("case", [7.0, 11.0]))
    of["response"].attrs["mean_mesh_stiffness"] = 4.4e8
    sweep_forces = {
        f"{name}_harmonic": factor * of["sweep"]["delta_z_harmonic"]
        for name, factor in (("F_xp", 2e8), ("F_yp", 3e8), ("F_zp", np.nan))
    }
    of["sweep"] = of["sweep"].assign(sweep_forces)
    of["stability"]["growth_variation_light"] = stability(1.0)["growth_variation"]
    of["separation"]["peak_to_peak"] = 5e-5 * of["separation"]["separation_share"]
    of["film"].attrs["loss_factor"] = 0.12
    of["losses"] = losses(np.full((2, 2, 2), 0.02))
    file = HelicalGearFile.named("he_2007")
    results = SimpleNamespace(settings=SimpleNamespace(file=file), datasets=of)
    pair, *rows = (list(one) for one in summary_rows(results)[2:])
    assert pair[:2] == ["pair", "total contact ratio"]
    unstable = "least factor on the mesh variation that is unstable"
    expected = [
        ["loaded contact", "mean mesh stiffness along x, secant, at 200 N.m", 5e8, "N/m"],
        ["loaded contact", "mean mesh stiffness along x, tangent, at 200 N.m", 5.5e8, "N/m"],
        ["loaded contact", "ISO 6336-1 mesh stiffness along x", 4.2e8, "N/m"],
        ["loaded contact", "secant stiffness, range over mean, at 200 N.m", 0.4, "1"],
        ["loaded contact", "transmission error, peak to peak, at 200 N.m", 0.4e-6, "m"],
        ["loaded contact", "highest share outside the plane of contact, at 200 N.m", 0.07, "1"],
        ["operating point", "mean mesh stiffness along x, of the vibrating pair", 4.4e8, "N/m"],
        *(
            row
            for case, power in (("mu 0.1", 7.0), ("oil film", 11.0))
            for row in (
                *(["operating point", f"{name} peak to peak, {case}", values[1], unit]
                  for name, (_, values) in moves.items()
                  for unit in ("N" if name.startswith("F") else "m",)),
                ["operating point", f"friction power, {case}", power, "W"],
            )
        ),
        # 0.7 um at mu 0.1 and 3000 rpm
        *(
            ["speed sweep", f"{words}largest first mesh order of {name}, mu 0.1", value, unit]
            for name, size, of_it in (
                ("delta_z", 0.7e-6, "m"), ("F_xp", 140.0, "N"), ("F_yp", 210.0, "N")
            )
            for words, value, unit in (("", size, of_it), ("speed of the ", 3000.0, "rpm"))
        ),
        ["speed sweep", "least 1 - |Floquet multiplier|", 0.5, "1"],
        ["stability", f"{unstable}, with the pair's damping", 2.0, "1"],
        ["stability", f"{unstable}, with light damping", 1.0, "1"],
        ["separation", "largest delta_z peak to peak, damping ratio 0.05", 1.25e-5, "m"],
        ["separation", "longest time without contact, damping ratio 0.05", 0.25, "1"],
        ["separation", "folds of the branch, damping ratio 0.05", 2.0, "1"],
        ["oil film", "constant coefficient of friction of the same loss", 0.04, "1"],
        ["oil film", "power loss, static loads", 150.0, "W"],
        ["oil film", "loss factor H_V", 0.12, "1"],
        *(
            ["losses", f"power lost at {torque} N.m, {speed} rpm, {degc} degC, by solved films "
             "(98 % of the load covered)", power, "W"]
            for power, degc, torque, speed in (
                (11.0, 40, 100, 1000), (13.0, 40, 100, 3000), (17.0, 40, 200, 1000),
                (19.0, 40, 200, 3000), (23.0, 90, 100, 1000), (29.0, 90, 100, 3000),
                (31.0, 90, 200, 1000), (60.0, 90, 200, 3000),
            )
        ),
    ]  # fmt: skip
    assert [one[1] for one in rows] == [one[1] for one in expected]
    for got, row in zip(rows, expected, strict=True):
        assert_cells(got, row, row[1])


def test_the_report_of_a_study_has_its_known_tables_and_inputs():
    of = everything()
    of["sweep"].attrs["pinion_teeth"] = TEETH
    of["losses"] = losses().assign(loss_torque=losses()["loss"].sum("part") / 100.0)
    one = HelicalSettings(
        file=HelicalGearFile.named("he_2007"),
        pinion_torque=226.0,
        pinion_speed=100.0 * RPM,
        roughness_rms=0.7e-6,
    )
    results = SimpleNamespace(datasets=of, settings=one)
    heads = ["oil [°C]", "torque [N·m]", "speed [rpm]", "loss torque [N·m]", "sliding [W]",
             "rolling [W]", "sliding by"]  # fmt: skip
    meets = [f"order {order} meets it at [rpm]" for order in (1, 2, 3)]
    expected = {
        "Critical speeds": [
            ["mode", "natural frequency [kHz]", *meets],
            [1, 4.0, 8000.0, 4000.0, 8000.0 / 3.0],  # 60 4000 Hz over 30 teeth
        ],
        "Losses of the pair": [
            heads,
            *([degc, torque, rpm, 0.01 * w, 0.75 * w, 0.25 * w, "formulas"]
              for w, degc, torque, rpm in (
                  (11.0, 40.0, 100.0, 1000.0), (13.0, 40.0, 100.0, 3000.0),
                  (17.0, 40.0, 200.0, 1000.0), (19.0, 40.0, 200.0, 3000.0),
                  (23.0, 90.0, 100.0, 1000.0), (29.0, 90.0, 100.0, 3000.0),
                  (31.0, 90.0, 200.0, 1000.0), (60.0, 90.0, 200.0, 3000.0))),
        ],
    }  # fmt: skip
    assert_tables([_critical_speeds(results), _losses(of["losses"])], expected)
    told = {one.name: (one.value, one.unit) for one in _inputs(results)}
    assert told["pinion torque"] == ("226", "N·m")
    assert told["pinion speed"] == ("100", "rpm")
    assert told["composite roughness"] == ("0.7", "µm")
    assert told["oil temperature"] == (f"{one.oil_temperature - 273.15:.4g}", "°C")


def test_stems_stand_beside_each_other_from_a_floor_below_the_smallest():
    """Two spectra of orders 1 to 4: the least is 1, so the floor is 0.3; the top is thrice 8."""
    first, second = np.array([4.0, 2.0, 1.0, 0.0]), np.array([8.0, 0.0, 5.0, 2.5])
    ax = new_figure(3.0, 3.0).subplots()
    stems(ax, np.arange(1.0, 5.0), [(first, "black", "a"), (second, "red", "b")])
    for lines, dots, heights, beside in zip(
        ax.collections, ax.lines, (first, second), (-0.11, 0.11), strict=True
    ):
        seen = heights > 0.0
        places = np.arange(1.0, 5.0)[seen] + beside
        np.testing.assert_allclose(dots.get_xydata(), np.column_stack([places, heights[seen]]))
        ends = np.array(lines.get_segments())
        np.testing.assert_allclose(ends[:, 0], np.column_stack([places, 0.3 + 0.0 * places]))
        np.testing.assert_allclose(ends[:, 1], dots.get_xydata())
    np.testing.assert_allclose(ax.get_ylim(), (0.3, 24.0))
    np.testing.assert_allclose(ax.get_xlim(), (0.3, 4.7))
