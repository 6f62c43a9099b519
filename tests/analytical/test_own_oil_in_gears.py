"""Laws of an oil from outside the package in the formulas of the axle and of the helical pair."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.contact.solid import contact_modulus
from gearlube_core.dynamics.helical_model.outputs import OUTPUT_NAMES as PAIR_NAMES
from gearlube_core.dynamics.hypoid_axle import OUTPUT_INDEX, OUTPUT_NAMES, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshAtLoad, MeshLevels, blend_mesh
from gearlube_core.dynamics.packed_mesh import ENTRAIN, N_CHANNELS, PRESSURE, R_E, pack_mesh
from gearlube_core.mesh_table.kernels import pair_channels
from gearlube_core.oil.oil_file import OilFile
from tests.helpers.each import each
from tests.helpers.oil_with_own_law import SHEET
from tests.helpers.own_oil_in_gears import (
    BARUS,
    LIMIT,
    LINE,
    LOW_LIMIT,
    OIL,
    RIB,
    SOLID,
    SPEED,
    TORQUE,
    Q,
)
from tests.helpers.own_process import INTERPRETED, report_of

AXLE = mohammadpour_2015_axle()
FLANKS = (0, 1, 2)
PLAIN = (
    OilFile.from_data(SHEET | BARUS | {"eyring_stress_mpa": 4.0}, "the oil").described().lubricant
)
E_STAR = contact_modulus(AXLE.solid, AXLE.solid)
EFFUSIVITY_SQUARED = SOLID.conductivity * SOLID.density * SOLID.heat_capacity


@cache
def reported():
    return report_of("own_oil_in_gears", **INTERPRETED)


@cache
def contacts():
    return report_of("own_oil_in_gears", "report_contacts", **INTERPRETED)


def plateau(exponent, film, p, speed, radius):
    """Friction coefficient of Evans and Johnson 1986 at ln(eta/eta0), by hand."""
    oil = PLAIN.state(OIL)
    zeta = 4.0 / math.pi * oil.conductivity / film
    zeta *= math.sqrt(p * radius / (2.0 * E_STAR * EFFUSIVITY_SQUARED * speed))
    heat = 2.0 * oil.conductivity * oil.eta0 / (oil.beta * (1.0 + 9.6 * zeta))
    stress = 0.87 * exponent + 1.74 * math.log(1.2 / (oil.tau0 * film) * math.sqrt(heat))
    return stress * oil.tau0 / p


def own_power(p):
    """ln(eta/eta0) by hand."""
    return Q * math.log(1.0 + PLAIN.state(OIL).alpha * p / Q)


def yasutomi(p):
    """ln(eta/eta0) by hand, pressures scaled to 15 1/GPa at 40 degC."""

    def decades(p, temperature):
        above = temperature - 206.09 - 81.565 * math.log(1.0 + 1.1041e-9 * p)
        X = above * (1.0 + 8.7961e-9 * p) ** -0.19905
        return -15.5505 * X / (25.363 + X)

    slope = (decades(1e3, 313.15) - decades(-1e3, 313.15)) * math.log(10.0) / 2e3
    return (decades(15e-9 / slope * p, OIL) - decades(0.0, OIL)) * math.log(10.0)


def flank_channels():
    mesh = pack_mesh(AXLE.mesh, E_STAR, AXLE.radii, AXLE.mesh_stiffness)
    table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
    window = np.zeros(mesh.window_size)
    at_load = MeshAtLoad(np.zeros(mesh.series_size), mesh.orders, window, mesh.nodes)
    blend_mesh(TORQUE, 1.0, table, at_load)
    channels = np.zeros((len(FLANKS), N_CHANNELS))
    for pair in FLANKS:
        teeth = float(AXLE.mesh.pinion_teeth)
        pair_channels(window, mesh.nodes, teeth, 0.0, pair, N_CHANNELS, channels[pair])
    return channels


@pytest.mark.slow
@each(("law", "grown"), [("own_power", own_power), ("yasutomi", yasutomi)])
def test_friction_of_the_axle_s_flanks_is_evans_and_johnson_s_at_the_viscosity_of_the_law(
    law, grown
):
    outputs, without = reported()[law]["axle"], reported()["none"]["axle"]
    compared = 0
    for pair, channels in zip(FLANKS, flank_channels(), strict=True):
        load, film, mu = (
            outputs[OUTPUT_INDEX[f"flank[{pair + 1}].{name}"]]
            for name in ("load", "film_thickness", "friction_coefficient")
        )
        if load == 0.0:
            continue
        place = OUTPUT_INDEX[f"flank[{pair + 1}].film_thickness"]
        if law == "own_power":  # the film takes alpha, which is that of the oil without the law
            assert film == pytest.approx(without[place], rel=1e-12)
        else:  # less: in warm oil this law has less than a constant Roelands exponent gives
            assert 0.9 * without[place] < film < without[place]
        p = channels[PRESSURE] * load ** (1.0 / 3.0)
        speed = abs(channels[ENTRAIN]) * SPEED
        expected = plateau(grown(p), film, p, speed, channels[R_E])
        # smooth flanks under a film of 15 roughnesses: what asperities carry is below rounding
        assert mu == pytest.approx(max(expected, 0.0), rel=1e-9 if law == "own_power" else 1e-5)
        if expected > 0.0:
            compared += 1
            assert mu < 0.95 * without[OUTPUT_INDEX[f"flank[{pair + 1}].friction_coefficient"]]
    assert compared


@pytest.mark.slow
def test_the_shipped_power_of_mcewen_is_the_same_law():
    found, own = contacts()["mcewen"], contacts()["own_power"]
    for part in ("line", "rib"):
        assert found[part] == pytest.approx(own[part], rel=1e-9)


@pytest.mark.slow
def test_the_axle_s_outputs_are_those_of_the_shipped_power_of_mcewen():
    found, own = reported()["mcewen"], reported()["own_power"]
    # rounding; q has another factor in the band of the loss
    kept = [i for i, name in enumerate(OUTPUT_NAMES) if name not in ("loss.low", "loss.high")]
    axles = [np.asarray(one["axle"])[kept] for one in (found, own)]
    np.testing.assert_allclose(*axles, rtol=1e-8, atol=1e-8)


def test_friction_of_a_contact_line_is_the_same_at_the_viscosity_of_the_power_law():
    found, without = contacts()["own_power"]["line"], contacts()["none"]["line"]
    w, R, u, _ = LINE
    p = math.pi / 4.0 * math.sqrt(w * SOLID.contact_modulus / (math.pi * R))
    film = without["film_thickness"]
    assert found["film_thickness"] == pytest.approx(film, rel=1e-12)
    expected = plateau(own_power(p), film, p, u, R)
    assert found["friction_coefficient"] == pytest.approx(expected, rel=1e-9)


def test_a_shear_law_bounds_the_friction_by_its_own_stress():
    """tau = tau_l tanh(eta dU/(h tau_l)), Gecim and Winer 1980."""
    found, without = contacts()["gecim_winer"]["line"], contacts()["none"]["line"]
    w, R, _, slip = LINE
    p = math.pi / 4.0 * math.sqrt(w * SOLID.contact_modulus / (math.pi * R))
    oil, film = PLAIN.state(OIL), without["film_thickness"]
    rate = oil.eta0 * math.exp(oil.alpha * p) * slip / film
    expected = LIMIT * math.tanh(rate / LIMIT) / p
    assert without["friction_coefficient"] > 1.5 * expected
    assert found["friction_coefficient"] == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_a_shear_law_bounds_the_friction_of_the_axle_s_flanks():
    outputs, without = reported()["gecim_winer"]["axle"], reported()["none"]["axle"]
    bounded = 0
    for pair, channels in zip(FLANKS, flank_channels(), strict=True):
        place = OUTPUT_INDEX[f"flank[{pair + 1}].friction_coefficient"]
        load = outputs[OUTPUT_INDEX[f"flank[{pair + 1}].load"]]
        if load > 0.0:
            p = channels[PRESSURE] * load ** (1.0 / 3.0)
            # at any sliding worth the name tanh is 1
            assert outputs[place] == pytest.approx(min(without[place], LIMIT / p), rel=1e-9)
            bounded += without[place] > LIMIT / p
    assert bounded


@pytest.mark.slow
@each("model", ("axle", "pair"))
def test_barus_by_another_package_is_the_barus_of_the_formulas(model):
    """All outputs of axle and pair: the law reaches every place where a formula takes it."""
    found, shipped = reported()["own_barus"][model], reported()["none"][model]
    names = OUTPUT_NAMES if model == "axle" else PAIR_NAMES
    for name, one, two in zip(names, found, shipped, strict=True):
        # rounding of alpha p/p; forces are differences of larger terms
        assert one == pytest.approx(two, rel=1e-9, abs=1e-9), name


def test_ribs_have_roelands_s_law_unless_the_oil_brings_another():
    """Roelands by another package, whose kernel follows the oil's temperature, changes nothing."""
    rib = {name: found["rib"] for name, found in contacts().items()}
    assert rib["over_eta0_followed"] == pytest.approx(rib["none"], rel=1e-9)
    # Barus is above Roelands, and the power law with q = 20 below Barus
    mu = {name: one["coefficient"] for name, one in rib.items()}
    assert mu["own_barus"] > 1.05 * mu["none"]
    assert mu["own_power"] < 0.95 * mu["own_barus"]
    # a limit far below the film's stress is all that is left
    of_rib, load, _ = RIB
    p = hertz_ellipse(of_rib.R_meridian, of_rib.R_sliding, 0.5 * of_rib.reduced_modulus, load)[2]
    assert mu["gecim_winer"] == pytest.approx(LOW_LIMIT / p, rel=1e-9)


@pytest.mark.slow
def test_an_fmu_with_the_files_computes_what_the_python_model_computes():
    found = reported()["own_power"]
    assert found["axle FMU"] == found["axle moving"]
    assert found["pair FMU"] == found["pair moving"]
    for model, names in (("axle", OUTPUT_NAMES), ("pair", PAIR_NAMES)):
        lost = names.index("friction.power_loss")
        assert found[model][lost] < 0.95 * reported()["none"][model][lost]
        # the mean over a step of 0.1 ms beside the power at its start
        assert found[f"{model} moving"][lost] == pytest.approx(found[model][lost], rel=0.05)


@pytest.mark.slow
def test_mean_losses_of_the_axle_fall_with_the_law_as_those_of_a_step_do():
    lost = {law: reported()[law]["viscous loss"] for law in ("none", "own_barus", "own_power")}
    assert lost["own_barus"] == pytest.approx(lost["none"], rel=1e-9)
    place = OUTPUT_INDEX["friction.power_loss"]
    powers = [reported()[law]["axle"][place] for law in ("own_power", "none")]
    # four angles of the mesh cycle against one
    assert lost["own_power"] / lost["none"] == pytest.approx(powers[0] / powers[1], rel=0.02)


@pytest.mark.slow
def test_fmus_error_bars_and_film_models_know_the_law():
    found = report_of("own_oil_in_gears", "report_names", **INTERPRETED)
    assert found["literals"] == [["custom"], ["custom"]]
    assert found["starts"] == found["by number"] == [1, 1]
    assert (
        "arana_2019_n100, arana_2019_pao100 do not have its law own_power" in found["description"]
    )
    assert found["code"] == [True, True]  # the GUID changes with the file of the law
    eta0, alpha = found["as given"]
    # two standard deviations are the factor; ln eta by hand at 1 GPa
    for name, by in (("viscosity", (1.08, 1.0, 1.0)), ("alpha", (1.0, 1.15, 1.0)),
                     ("oil_q", (1.0, 1.0, 1.2))):  # fmt: skip
        expected = by[0] * eta0, by[1] * alpha
        q = by[2] * Q
        under = math.log(expected[0]) + q * math.log(1.0 + expected[1] * 1e9 / q)
        assert found["moved"][name] == pytest.approx([*expected, under], rel=1e-9), name
    # film models are of Roelands's oils: the formulas come in, and the outputs say so
    assert found["share outside"] == 1.0
    solved, formula = found["films"]
    assert solved == formula
    assert "viscosity law own_power (model: roelands or modulus, eyring)" in found["film model"]
    slope, over_eta0, followed = found["refusals"]
    assert "by the viscosity law steeper must be alpha, 15 1/GPa at 313.15 K" in slope
    assert "got 30 1/GPa. Give the oil the alpha of the law" in slope
    assert "law over_eta0 must depend on alpha p alone" in over_eta0
    assert "the method law_at(eta0, alpha)" in over_eta0
    assert followed == ""


@pytest.mark.slow
def test_native_fmus_have_the_laws_of_their_oil_file(tmp_path):
    found = report_of("own_oil_in_gears", "report_native", NUMBA_CACHE_DIR=str(tmp_path))
    assert set(found) == {"axle", "pair"}
    for name, (native, python) in found.items():
        # other instructions in object code: rounding of some 1e2 operations
        np.testing.assert_allclose(native, python, rtol=1e-9, atol=1e-9, err_msg=name)
