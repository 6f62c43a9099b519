"""Derivatives of a helical pair's whine: from reliefs through the mesh table to the motion."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.whine_rates import whine_rates
from gearlube_core.errors import ParameterError
from gearlube_core.helical_contact.loaded_contact import (
    LoadedSettings,
    MeshPosition,
    coupled_strip,
)
from gearlube_core.helical_contact.series_rates import (
    HelicalSeriesSettings,
    helical_series_rates,
    usual_flank_parameters,
)
from gearlube_core.helical_contact.strips import StripSettings, normal_gap
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.tooth_contact.coupled_strips import solve_coupled
from gearlube_core.tooth_contact.series_rates import series_of_records, torques_about
from tests.helpers.differences import extrapolated
from tests.helpers.helical_contact_cases import TORQUE, stiff_teeth

FILE = HelicalGearFile.named("he_2007").varied(
    {
        f"{role}.flank": {
            "tip_relief_um": 15.0,
            "tip_relief_depth_mm": 2.0,
            "crown_um": 6.0,
            "lead_slope_um": 2.0,
        }
        for role in ("pinion", "gear")
    }
)
MODULUS = 1.1e11
NAMES = ("pinion.flank.tip_relief_um", "gear.flank.crown_um")
COARSE = LoadedSettings(strips=StripSettings(cells_across=11, cells_along=20), tolerance=1e-9)
SERIES = HelicalSeriesSettings(parameters=NAMES, torque=TORQUE, positions=5, loaded=COARSE)
PAIR = FILE.helical_pair()
STEP = 2e-3  # um: no cell of the frozen contact goes


def motion(series, speed=None, rates=None):
    """Return the orders at 0.6 of the resonance of the pair as it stands, and that speed."""
    pair = replace(
        karagiannis_2012_pair(series.table),
        pinion_torque=TORQUE,
        pinion_inertia=FILE.body("pinion").polar_inertia,
        gear_inertia=FILE.body("gear").polar_inertia,
        mesh_damping="modal",
    )
    if speed is None:
        model = HypoidTorsional(pair)
        speed = model.pinion_speed(0.6 * model.natural_frequency)
    return whine_rates(pair, rates or {}, speed), speed


@pytest.fixture(scope="module")
def teeth():
    return stiff_teeth(MODULUS)


@pytest.fixture(scope="module")
def frozen(teeth):
    """Loaded lines of all phases at both torques."""
    modified = FILE.modified_pair()
    found = {}
    for torque in torques_about(TORQUE):
        for phase in np.arange(SERIES.positions) / SERIES.positions:
            state = MeshPosition.at(modified, float(phase)).load(torque, teeth, COARSE)
            lines = [line for line in state.lines if (line.forces > 0.0).any()]
            found[torque, float(phase)] = lines
    return found


def analysed_again(frozen, teeth, name, change):
    """Return the orders with one field changed, on the cells that carried before."""
    role, _, key = name.split(".")
    value = getattr(getattr(FILE, role).flank, key)
    changed = FILE.varied({name: value + change}).modified_pair()
    phases = sorted({phase for _, phase in frozen})
    rows = []
    for torque in torques_about(TORQUE):
        for phase in phases:
            strips = []
            for line in frozen[torque, phase]:
                there = line.forces > 0.0
                gap = normal_gap(changed, line.strip.X, line.strip.y, line.strip.z)
                held = replace(line.strip, gap=np.where(there, gap, np.inf))
                strips.append(coupled_strip(PAIR, held, teeth))
            rotation = solve_coupled(strips, teeth, torque, 1e-12).solution.rotation
            touching = MeshPosition.at(changed, phase).unloaded_rotation
            rows.append((rotation, touching, torque * PAIR.ratio, torque / PAIR.pinion_base_radius))
    values = np.array(rows).reshape(2, len(phases), 4).transpose(2, 1, 0)
    names = ("rotation", "touching", "gear_torque", "force")
    records = dict(zip(names, values, strict=True))
    records |= {f"{one}_rate": np.zeros((len(phases), 2, 0)) for one in names}
    return series_of_records(FILE, (PAIR.pinion_teeth, PAIR.gear_teeth), (), records, TORQUE)


@pytest.mark.slow
def test_whine_moves_by_reliefs_as_analyses_of_frozen_lines_do(frozen, teeth):
    series = helical_series_rates(FILE, SERIES, stiffness=teeth)
    found, speed = motion(series, rates=series.rates)
    for k, name in enumerate(NAMES):

        def orders(change, name=name):
            one, _ = motion(analysed_again(frozen, teeth, name, change), speed)
            return np.concatenate([one.transmission_error, one.force])

        expected = extrapolated(orders, STEP)
        rates = np.concatenate([found.transmission_error_rate[k], found.force_rate[k]])
        for part in (slice(0, 3), slice(3, 6)):
            scale = np.abs(expected[part]).max()
            np.testing.assert_allclose(rates[part], expected[part], rtol=0.0, atol=1e-6 * scale)


@pytest.mark.slow
def test_arms_are_the_base_radii_and_the_torques_balance(teeth):
    series = helical_series_rates(FILE, replace(SERIES, parameters=NAMES[:1]), stiffness=teeth)
    table = series.table
    assert table.mean("R_p", TORQUE) == pytest.approx(PAIR.pinion_base_radius, rel=1e-12)
    assert table.mean("R_g", TORQUE) == pytest.approx(PAIR.ratio * PAIR.pinion_base_radius)
    assert not series.rates["R_p"].any()


def test_what_has_no_derivative_is_refused_and_the_usual_fields_are_those_with_amounts(teeth):
    assert "pinion.flank.crown_um" in usual_flank_parameters(FILE)
    plain = HelicalGearFile.named("he_2007")
    assert set(usual_flank_parameters(plain)) == {
        f"{role}.flank.{key}"
        for role in ("pinion", "gear")
        for key in ("lead_slope_um", "profile_slope_um")
    }
    wrong = replace(SERIES, parameters=("pinion.machine.tilt_angle_deg",))
    with pytest.raises(ParameterError, match="must be a number of its flanks"):
        helical_series_rates(FILE, wrong, stiffness=teeth)
