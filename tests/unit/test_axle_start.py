"""Static equilibrium and step control of the axle, against SciPy and LAPACK."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from gearlube_core.bearings.bearing_type import RollerFilms
from gearlube_core.bearings.followed_shaft import (
    N_FORCES,
    SOLVED_FILMS,
    drag_of_shaft,
    raceways_of_shaft,
)
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, shafts_at_rest
from gearlube_core.dynamics.hypoid_axle.as_train import memory_of_means, numbers_at_rest
from gearlube_core.dynamics.hypoid_axle.mesh_cycle import mean_series
from gearlube_core.dynamics.hypoid_axle.state import (
    U_G,
    U_P,
    W_G,
    W_P,
    gear_motion,
    pinion_motion,
)
from gearlube_core.dynamics.hypoid_mesh.kernel_parameters import without_losses
from gearlube_core.dynamics.hypoid_mesh.mesh_at_load import MeshLevels
from gearlube_core.dynamics.train.march import STIFFNESS, work_size
from gearlube_core.errors import ConvergenceError
from gearlube_core.mesh_table.kernels import N_SERIES, N_X, R_P
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import axle_with
from tests.helpers.each import each

OIL = 350.0  # K


def started(torque, speed=200.0, **settings):
    axle = HypoidAxle(axle_with(**settings))
    axle.initialise(
        pinion_speed=speed, pinion_torque=torque, wheel_torque=2.0 * torque, oil_temperature=OIL
    )
    return axle


def axle_means(axle, torque):
    packed = axle.parameters.packed_mesh()
    table = MeshLevels(packed.levels, packed.series, packed.orders, packed.windows, packed.nodes)
    means = np.zeros(N_SERIES)
    mean_series(torque, table, means)
    return means


def with_scipy(axle, torque):
    """The displacements at rest [um] from MINPACK's hybrid method, on forces of the bearings."""
    p, means = without_losses(axle.kernel_parameters), axle_means(axle, torque)
    on_gear = p.lateral_sign * torque / means[R_P] * means[N_X : N_X + 3]
    forces = np.r_[-on_gear, on_gear]
    problem = shafts_at_rest._Problem(
        forces, lubricant_state(p.oil, OIL), p, np.zeros(1), np.zeros(N_FORCES)
    )

    def missing(u):
        out = np.zeros(6)
        shafts_at_rest._missing(1e-6 * np.array(u), problem, out)
        return out

    return root(missing, np.zeros(6), method="hybr", options={"xtol": 1e-12}).x


@each("equations", ["consistent", "as_printed"])
@each("torque", [-350.0, 0.0, 5.0, 600.0])
@each("preload", [0.0, 2500.0])
def test_displacements_at_rest_are_those_that_scipy_finds(equations, torque, preload):
    axle = started(torque, equations=equations, bearing_preload=preload)
    found = 1e6 * np.r_[axle.state_view[U_P : U_P + 3], axle.state_view[U_G : U_G + 3]]
    # xtol of MINPACK is 1e-12 of the norm; without preload and load it stops 1e-5 um from 0
    assert found == pytest.approx(
        with_scipy(axle, torque), rel=1e-9, abs=2e-5 if not torque else 1e-9
    )


@each("size", [1e-7, 1e-5, 1e-3])
@each("sense", [1.0, -1.0])
def test_flanks_of_either_side_bear_a_small_torque_at_the_start(size, sense):
    # the force is in proportion to a small torque, but for rounding at a backlash of 0.15 mm
    loaded = started(sense).output("mesh.force")
    assert started(size * sense).output("mesh.force") == pytest.approx(size * loaded, rel=1e-2)


@each("equations", ["consistent", "as_printed"])
@each("torque", [-200.0, 60.0, 400.0])
def test_the_step_is_tied_to_the_highest_mode_that_lapack_finds(equations, torque):
    axle = started(torque, equations=equations)
    made, rest = axle.assembly, np.array(axle.state_view)
    rest[[W_P, W_G]] = 0.0  # the start is one of shafts that do not turn yet
    work = np.zeros(work_size(made.sizes))
    numbers = numbers_at_rest(axle.elements, made, axle.parameters.oil)
    m = int(
        axle.operate(
            STIFFNESS, rest, OIL, numbers, memory_of_means(made), made.plan, 0.0, 0.0, work
        )
    )
    # of the printed equations some are complex: the step is tied to their modulus
    squares = np.abs(np.linalg.eigvals(work[: m * m].reshape(m, m)))
    highest = math.sqrt(squares.max()) / (2.0 * math.pi)
    # K from differences over 10 nm has 1e-13 of its own; the same K is used here
    assert axle.highest_frequency == pytest.approx(highest, rel=1e-11)


@pytest.mark.slow
def test_drag_at_the_start_is_that_of_each_roller_by_itself():
    """Nodes of films, which steps keep, differ by 1e-4 here, and their slopes by far more."""
    axle = started(60.0, speed=800.0, bearing_torque_loss="solved_films")
    p, oil = axle.kernel_parameters, lubricant_state(axle.kernel_parameters.oil, OIL)
    films = RollerFilms(axle.parameters.roller_model(), np.zeros(0), 0.0)
    lost = 0.0
    for bearings, motion, preload in (
        (p.bearing_p, pinion_motion(axle.state_view), p.preload_p),
        (p.bearing_g, gear_motion(axle.state_view), p.preload_g),
    ):
        raceways = raceways_of_shaft(bearings, motion, SOLVED_FILMS, oil, films)
        drag = drag_of_shaft(bearings, motion, preload, SOLVED_FILMS, oil, raceways)
        lost += drag.torque * motion.speed
    # sums of rounding
    assert axle.output("bearing.power_loss") == pytest.approx(lost, rel=1e-12)


def test_rollers_without_contact_angle_carry_no_axial_force():
    parameters = axle_with()
    bearing = replace(parameters.bearing, contact_angle=0.0, preload=None, interference=1e-5)
    axle = HypoidAxle(replace(parameters, bearing=bearing))
    before = axle.get_state()
    with pytest.raises(ConvergenceError, match="no static equilibrium at a pinion torque of 60"):
        axle.initialise(pinion_speed=1.0, pinion_torque=60.0, wheel_torque=0.0, oil_temperature=OIL)
    np.testing.assert_array_equal(axle.get_state(), before)


@each("clearance", [0.0, 1e-6, 20e-6, 100e-6])
@each("torque", [-1.0, 60.0])
def test_shafts_with_clearance_settle_on_the_loaded_rollers(clearance, torque):
    parameters = axle_with()
    bearing = replace(parameters.bearing, preload=None, interference=-clearance)
    axle = HypoidAxle(replace(parameters, bearing=bearing))
    axle.initialise(pinion_speed=0.0, pinion_torque=torque, wheel_torque=0.0, oil_temperature=OIL)
    means = axle_means(axle, torque)
    for pair in ((1, 2), (3, 4)):
        carried = np.array(
            [sum(axle.output(f"bearing[{j}].force.{c}") for j in pair) for c in "xyz"]
        )
        # both bearings of a shaft carry F = T / R_p together; the balance is closed to 1e-4 of it
        assert np.linalg.norm(carried) == pytest.approx(
            abs(torque) / means[R_P] * np.linalg.norm(means[N_X : N_X + 3]), rel=1e-4
        )
