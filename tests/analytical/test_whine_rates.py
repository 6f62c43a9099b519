"""Derivatives of whine: from settings through the mesh table to the periodic motion."""

from dataclasses import replace

import numpy as np
import pytest

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.dynamics.hypoid_torsional.whine_rates import whine_rates
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.sensitivity.loaded_rates import QUANTITIES, loaded_rates
from gearlube_core.hypoid_contact.sensitivity.parameter import Variations
from gearlube_core.hypoid_contact.sensitivity.series_rates import (
    SeriesSettings,
    assembled,
)
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from tests.helpers.contact_cases import shipped_file, shipped_pair
from tests.helpers.differences import changed_pair, extrapolated
from tests.helpers.each import each
from tests.helpers.frozen_contact import SOFT_TEETH, Frozen

LIMIT = 1e-6
NAMES = (
    "misalignment.pinion_axial",
    "pinion.machine.tilt_angle_deg",
)
CYCLE = SeriesSettings(parameters=NAMES, torque=80.0, positions=5)
KEPT = ("rotation", "touching", "gear_torque", "force")


def one_level(torque=50.0):
    table = shipped_mesh_table("mohammadpour_2015")
    here = table.torque == torque
    return replace(
        table,
        torque=table.torque[here],
        series={name: values[here] for name, values in table.series.items()},
        windows={name: values[here] for name, values in table.windows.items()},
    )


def amplitudes(parameters, speed):
    found = whine_rates(parameters, {}, speed)
    return np.concatenate([found.transmission_error, found.force])


def near(found, expected):
    """Each of three orders of the error, and of the force, to 1e-6 of the largest of its kind."""
    for part in (slice(0, 3), slice(3, 6)):
        scale = np.abs(expected[part]).max()
        np.testing.assert_allclose(found[part], expected[part], rtol=0.0, atol=LIMIT * scale)


# below resonance, at the second order's, and near the first order's, where teeth part
@each("ratio", [0.3, 0.5, 0.93])
def test_orders_move_as_those_of_motions_found_anew(ratio):
    table = one_level()
    pair = karagiannis_2012_pair(table)
    model = HypoidTorsional(pair)
    speed = model.pinion_speed(ratio * model.natural_frequency)
    shapes = np.random.default_rng(3).standard_normal((4, *table.series["e"].shape[1:]))
    shapes[:, 0, 1] = 0.0
    size = {"k_t": 1e7, "k_m": 1e7, "R_p": 1e-4, "e": 1e-7}
    rates = {
        name: scale * shape[None] for (name, scale), shape in zip(size.items(), shapes, strict=True)
    }

    def analysed_again(change):
        moved = {name: table.series[name] + change * rate for name, rate in rates.items()}
        mesh = replace(table, series={**table.series, **moved})
        return amplitudes(replace(pair, mesh=mesh), speed)

    found = whine_rates(pair, rates, speed)
    near(
        np.concatenate([found.transmission_error_rate[0], found.force_rate[0]]),
        extrapolated(analysed_again, 2e-3),
    )


def test_error_of_constant_teeth_swings_as_a_linear_mass_on_its_spring():
    # (x + e)/e = (k + i c w)/(k - m w^2 + i c w) for two inertias on a constant spring
    table = synthetic_mesh(stiffness_harmonics=(), error_harmonics=((0.2e-6, 0.0),))
    pair = karagiannis_2012_pair(table)
    model = HypoidTorsional(pair)
    k, m = model.stiffness, model.equivalent_mass
    speed = model.pinion_speed(0.3 * model.natural_frequency)
    w = 2.0 * np.pi * 0.3 * model.natural_frequency
    damped = 1j * pair.damping * w
    swing = abs((k + damped) / (k - m * w**2 + damped)) / model.kernel_parameters.R_p0
    rate = np.zeros((1, *table.series["e"].shape[1:]))
    rate[0, 1, 0] = 1e-6
    found = whine_rates(pair, {"e": rate}, speed)
    value, moved = found.amplitudes("transmission_error")
    # e' over R_p is 1e-4, and the damping builds up with the deflection
    assert value[0] == pytest.approx(0.2e-6 * swing, rel=2e-3)
    assert moved[0, 0] == pytest.approx(1e-6 * swing, rel=2e-3)


@pytest.fixture(scope="module")
def cells():
    """Frozen cells at all phases and both torques."""
    pair = shipped_pair("drive")
    phases = np.arange(CYCLE.positions) / CYCLE.positions
    return [[Frozen(pair, float(phase), torque) for torque in CYCLE.torques] for phase in phases]


def table_of(records, parameters=()):
    return assembled(shipped_file(), parameters, records, CYCLE)


@pytest.mark.slow
def test_settings_move_whine_as_analyses_of_frozen_strips_do(cells):
    variations = Variations.of(shipped_file(), cells[0][0].pair, NAMES)
    found = [[loaded_rates(variations, one.state, SOFT_TEETH) for one in row] for row in cells]
    records = {
        name: np.array([[getattr(one.value, name) for one in row] for row in found])
        for name in KEPT
    }
    records |= {
        f"{name}_rate": np.array([[getattr(one.rate, name) for one in row] for row in found])
        for name in KEPT
    }
    here = table_of(records, variations.parameters)
    pair = replace(karagiannis_2012_pair(here.table), pinion_torque=CYCLE.torque)
    model = HypoidTorsional(pair)
    speed = model.pinion_speed(0.6 * model.natural_frequency)
    rates = whine_rates(pair, here.rates, speed)
    places = [QUANTITIES.index(name) for name in KEPT]
    for k, parameter in enumerate(variations.parameters):

        def analysed_again(change, parameter=parameter):
            values = np.array(
                [
                    [
                        one.quantities(changed_pair(shipped_file(), one.pair, parameter, change))
                        for one in row
                    ]
                    for row in cells
                ],
                dtype=object,
            )
            moved = {
                name: np.array([[one[place] for one in row] for row in values])
                for name, place in zip(KEPT, places, strict=True)
            }
            moved |= {f"{name}_rate": np.zeros((CYCLE.positions, 2, 0)) for name in KEPT}
            return amplitudes(replace(pair, mesh=table_of(moved).table), speed)

        near(
            np.concatenate([rates.transmission_error_rate[k], rates.force_rate[k]]),
            extrapolated(analysed_again, parameter.step),
        )


def test_what_has_no_derivative_is_refused():
    with pytest.raises(ParameterError, match="one level"):
        whine_rates(karagiannis_2012_pair(), {}, 100.0)
