"""Every kernel of the axle, its mesh table and its bearing expansion, compiled and in Python."""

import importlib
import pickle
import pkgutil
import subprocess
import sys
from os import environ

import numpy as np
import pytest
from numba.core.dispatcher import Dispatcher

from gearlube_core.bearings import bearing_type, cage_frame, shaft_expansion
from gearlube_core.bearings.parameters import ROLLERS_MAX
from gearlube_core.dynamics import flank_force, hypoid_axle, mean_power
from gearlube_core.dynamics.hypoid_axle import (
    HypoidAxle,
    bearing_outputs,
    flank_outputs,
    flanks,
    integrate,
    mesh_at_load,
    mesh_force,
    outputs,
    rhs,
)
from gearlube_core.dynamics.hypoid_axle.communication import axle_kernels
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshAtLoad, MeshLevels
from gearlube_core.dynamics.hypoid_axle.outputs import FLANKS, N_OUTPUTS, PINION_BEARINGS
from gearlube_core.dynamics.hypoid_axle.state import (
    LOAD_TORQUE,
    N_ODE,
    N_STATE,
    PHI_P,
    PINION_WORK,
    SIDE,
    TIME_IN_STEP,
    WORK_MARK,
    X,
)
from gearlube_core.dynamics.packed_mesh import N_CHANNELS, pack_mesh
from gearlube_core.kernels.flat_tuples import flatten
from gearlube_core.mesh_table import kernels
from gearlube_core.oil.lubricant_state import lubricant_state
from tests.helpers.axle_cases import OIL, axle_with, running_axle, with_coast_flanks

AXLE, TORQUE_P, TORQUE_G = running_axle(60)
for _ in range(20):
    AXLE.step(1e-4, TORQUE_P, TORQUE_G, OIL)
STATE = AXLE.get_state()[:N_STATE]
MESH = AXLE.packed
P = AXLE.kernel_parameters
PRINTED = HypoidAxle(
    axle_with(equations="as_printed", friction="as_printed", mesh_damping="modal", radii="paper")
).kernel_parameters
STATE_OF_OIL = lubricant_state(P.oil, OIL)
INPUTS = integrate.step_inputs(STATE, TORQUE_P, TORQUE_G, STATE_OF_OIL, P)
SERIES, WINDOW = np.zeros(MESH.series_size), np.zeros(MESH.window_size)
TABLE = MeshLevels(MESH.levels, MESH.series, MESH.orders, MESH.windows, MESH.nodes)
MESH_DATA = MeshAtLoad(SERIES, MESH.orders, WINDOW, MESH.nodes)
mesh_at_load.blend_mesh(STATE[LOAD_TORQUE], 1.0, TABLE, MESH_DATA)
AT_LOAD = (MESH_DATA, STATE_OF_OIL)
FORCE = mesh_force.mesh_force(STATE, SERIES, MESH.orders, P.mesh).force
CHANNELS, FRICTION = np.zeros(N_CHANNELS), np.zeros(rhs.N_FRICTION)
kernels.pair_channels(WINDOW, MESH.nodes, P.mesh.z_p, STATE[PHI_P], 0, N_CHANNELS, CHANNELS)
CONTROL = AXLE.step_control
SCRATCH = np.zeros(rhs.SCRATCH)
SLOPE = np.zeros(N_ODE)
rhs.axle_rhs(STATE, INPUTS, *AT_LOAD, P, 1.0, 1.0, SCRATCH, SLOPE)
MOTION = bearing_type.ShaftMotion(3e-6, -1e-6, 0.5e-6, 1e-3, 2e-3, -1e-3, 0.3, 145.0)
MOVED = bearing_type.ShaftMotion(3.1e-6, -1.2e-6, 0.6e-6, 2e-3, 1e-3, -2e-3, 0.31, 145.0)
TERMS = cage_frame.ApproachTerms(10.0, 3.0, 1.0, 0.5, 20.0, -30.0, 5.0)
LOOP = (12, TERMS, 0.7, 3e-5, 40.0, 3e-5, 0.0)
EXPANSION = np.zeros(bearing_type.N_EXPANSION)
shaft_expansion.expand_shaft_bearings(MOTION, 300.0, 0.0171, 2.4e-8, P.bearing_p, EXPANSION)
SEPARATED = STATE.copy()
SEPARATED[X] = -3.0
COASTING = STATE.copy()
COASTING[X] = -155.0
BOTH = pack_mesh(with_coast_flanks(AXLE.parameters.mesh), 115e9, "consistent", "tangent")
BOTH_SIDES = MeshLevels(BOTH.levels, BOTH.series, BOTH.orders, BOTH.windows, BOTH.nodes)
CROSSED, CROSSED_BACK = STATE.copy(), STATE.copy()
CROSSED[X], CROSSED_BACK[X] = -100.0, -50.0
CROSSED_BACK[SIDE] = -1.0
AT_START = STATE.copy()
AT_START[TIME_IN_STEP] = 0.0
TORQUES = (TORQUE_P, TORQUE_G)


def zeros(size):
    return np.zeros(size)


WORK = zeros(integrate.work_size(MESH.orders, MESH.nodes))
BRACKET = kernels.load_bracket(33.0, 1.0, MESH.levels, MESH.levels.size)
WRITE_SHAFT = (MOTION, 300.0, STATE_OF_OIL, P.bearing_p, PINION_BEARINGS, (2, 1, 0))
CASES = [
    *(
        (kernels.load_bracket, (torque, side, levels, levels.size))
        for torque in (0.0, 33.0, 1e3)
        for side in (1.0, -1.0)
        for levels in (MESH.levels, BOTH.levels)
    ),
    (kernels.blend_levels, (MESH.series, MESH.series_size, BRACKET, zeros(MESH.series_size))),
    (kernels.mesh_series, (SERIES, MESH.orders, 13.0, 0.3)),
    (kernels.transmission_error, (SERIES, MESH.orders, 13.0, 0.3)),
    (kernels.pair_channels, (WINDOW, MESH.nodes, 13.0, 0.3, 1, N_CHANNELS, zeros(N_CHANNELS))),
    (shaft_expansion._sums_line, LOOP),
    (shaft_expansion._sums_general, (*LOOP, 1.3, zeros(bearing_type.N_EXPANSION))),
    (
        shaft_expansion.expand_shaft_bearings,
        (MOTION, 300.0, 0.0171, 2.4e-8, P.bearing_p, zeros(bearing_type.N_EXPANSION)),
    ),
    (
        shaft_expansion.expand_shaft_bearings,
        (
            MOTION,
            300.0,
            0.0171,
            2.4e-8,
            P.bearing_p._replace(n=1.2),
            zeros(bearing_type.N_EXPANSION),
        ),
    ),
    (
        shaft_expansion.expanded_shaft_forces,
        (MOVED, P.bearing_p, EXPANSION),
    ),
    (flank_force.backlash_deflection, (3e-6, 150e-6)),
    (flank_force.backlash_deflection, (-3e-6, 150e-6)),
    (flank_force.backlash_deflection, (-153e-6, 150e-6)),
    (flank_force.gated_force, (900.0, 2278.0, -0.1, 3e-6)),
    (flank_force.gated_force, (-30.0, 2278.0, -0.1, -0.1e-6)),
    (mesh_force.reference_frequency, (P.mesh, 145.0)),
    (mesh_force.reference_frequency, (P.mesh, -1.0)),
    *(
        (mesh_force.mesh_force, (state, SERIES, MESH.orders, parameters.mesh))
        for state in (STATE, SEPARATED, COASTING)
        for parameters in (P, PRINTED)
    ),
    (flanks.sliding_speed, (STATE, CHANNELS)),
    (flanks.pair_friction, (STATE, 900.0, 0.7, CHANNELS, STATE_OF_OIL, P)),
    *(
        (
            flanks.flank_sum,
            (STATE, FORCE, WINDOW, MESH.nodes, STATE_OF_OIL, P, refresh, FRICTION, CHANNELS),
        )
        for refresh in (1.0, 0.0)
    ),
    (rhs.pinion_motion, (STATE,)),
    (rhs.gear_motion, (STATE,)),
    *(
        (rhs.axle_rhs, (state, INPUTS, *AT_LOAD, parameters, fresh, fresh, SCRATCH, SLOPE))
        for state in (STATE, SEPARATED, COASTING)
        for parameters in (P, PRINTED)
        for fresh in (1.0, 0.0)
    ),
    (integrate.step_limit, (P, CONTROL, 145.0, 5e8)),
    (integrate.step_limit, (PRINTED, CONTROL, 145.0, 5e8)),
    *(
        (
            integrate.rk4_step,
            (STATE, 2e-5, first, expand, INPUTS, *AT_LOAD, P, SCRATCH, zeros(N_STATE + 2 * N_ODE)),
        )
        for first in (1.0, 0.0)
        for expand in (1.0, 0.0)
    ),
    (integrate.step_inputs, (STATE, 60.0, 100.0, STATE_OF_OIL, P)),
    (integrate.step_inputs, (STATE, 60.0, 100.0, STATE_OF_OIL, P._replace(drag=0.0))),
    (
        mesh_at_load.blend_mesh,
        (33.0, -1.0, BOTH_SIDES, MESH_DATA),
    ),
    (
        mesh_at_load.lateral_and_unloaded,
        (STATE, kernels.mesh_series(SERIES, MESH.orders, 13.0, 0.3), SERIES, MESH.orders, 13.0),
    ),
    *(
        (mesh_at_load.follow_flank, (state, BOTH_SIDES, parameters, MESH_DATA))
        for state in (STATE, SEPARATED, COASTING, CROSSED, CROSSED_BACK)
        for parameters in (P.mesh, P.mesh._replace(backlash=0.0))
    ),
    (outputs.stored_energy, (STATE, 5e8, STATE_OF_OIL, P)),
    (
        flank_outputs.write_flanks,
        (
            STATE,
            FORCE,
            WINDOW,
            MESH.nodes,
            OIL,
            STATE_OF_OIL,
            P,
            FLANKS,
            CHANNELS,
            zeros(N_OUTPUTS),
        ),
    ),
    (bearing_outputs.write_shaft, (*WRITE_SHAFT, zeros(ROLLERS_MAX), zeros(N_OUTPUTS))),
    *(
        (mean_power.mean_power, (STATE, SLOPE, PINION_WORK, WORK_MARK, duration))
        for duration in (0.0, 1e-4)
    ),
    *((outputs.write_losses, (state, SLOPE, zeros(N_OUTPUTS))) for state in (STATE, AT_START)),
    *(
        (integrate.advance, (STATE, duration, TORQUES, OIL, TABLE, P, CONTROL, WORK))
        for duration in (1e-4, 1e9)
    ),
    (
        outputs.write_outputs,
        (STATE, TORQUES, OIL, TABLE, P, WORK, zeros(ROLLERS_MAX), zeros(N_OUTPUTS)),
    ),
]
COMPILED = axle_kernels(type(P.bearing_p), type(P.flank_law))
CASES += [
    (
        COMPILED.communication_step,
        (
            STATE, zeros(N_STATE), 1e-4, np.array([*TORQUES, OIL]), tuple(TABLE), flatten(P),
            flatten(CONTROL), WORK, zeros(ROLLERS_MAX), zeros(N_OUTPUTS),
        ),
    ),
    (
        COMPILED.outputs,
        (
            STATE, np.array([*TORQUES, OIL]), tuple(TABLE), flatten(P), WORK,
            zeros(ROLLERS_MAX), zeros(N_OUTPUTS),
        ),
    ),
]  # fmt: skip


def numbers(value):
    return np.ravel(flatten(value) if isinstance(value, tuple) else value)


def own_arrays(value):
    """The value with its arrays copied, also those in a tuple."""
    if isinstance(value, tuple):
        parts = [own_arrays(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value.copy() if isinstance(value, np.ndarray) else value


def arrays_in(values):
    """All arrays in nested tuples."""
    for value in values:
        if isinstance(value, tuple):
            yield from arrays_in(value)
        elif isinstance(value, np.ndarray):
            yield value


def everything(function, args):
    """What a function returns or writes, as arrays."""
    own = tuple(own_arrays(a) for a in args)
    returned = function(*own)
    written = list(arrays_in(own))
    return written if returned is None else [*written, numbers(returned)]


def identifiers(cases):
    return [f"{kernel.__name__}-{i}" for i, (kernel, _) in enumerate(cases)]


# sums over 24 rollers that may be taken in any order: 1e-12 of the largest
SUMMING = {"_sums_line", "_sums_general", "expand_shaft_bearings"}
SUMMING |= {"expanded_shaft_forces"}
# the same sums, 24 rollers of 1 kN that cancel to a few 1e-16 each, over a pinion of 12 kg
ACCELERATING = {"axle_rhs", "rk4_step", "advance", "write_outputs"}
ACCELERATING |= {"communication_step", "outputs"}


def same(kernel, compiled, source):
    for one, two in zip(compiled, source, strict=True):
        limit = 0.0
        if kernel.__name__ in SUMMING:
            limit = 1e-12 * np.abs(two).max()
        elif kernel.__name__ in ACCELERATING:
            limit = 2e-11
        # rounding: a few operations in another order
        np.testing.assert_allclose(one, two, rtol=1e-12, atol=limit)


@pytest.mark.parametrize(("kernel", "args"), CASES, ids=identifiers(CASES))
def test_compiled_kernel_equals_its_source(kernel, args):
    same(kernel, everything(kernel, args), everything(kernel.py_func, args))


def test_no_kernel_of_these_modules_is_left_out():
    names = [f"{hypoid_axle.__name__}.{m.name}" for m in pkgutil.iter_modules(hypoid_axle.__path__)]
    names += [kernels.__name__, shaft_expansion.__name__, flank_force.__name__]
    names += [mean_power.__name__]
    found = {
        value
        for name in names
        for value in vars(importlib.import_module(name)).values()
        if isinstance(value, Dispatcher) and value.py_func.__module__ == name
    }
    assert found | set(COMPILED) == {kernel for kernel, _ in CASES}


def test_the_whole_right_hand_side_is_the_same_interpreted(tmp_path):
    """Everything interpreted, so that no compiled callee hides a difference."""
    args = (STATE, INPUTS, *AT_LOAD, P, 1.0, 1.0, zeros(rhs.SCRATCH), zeros(N_ODE))
    (tmp_path / "args").write_bytes(pickle.dumps(args))
    code = (
        "import pickle, sys\n"
        "from pathlib import Path\n"
        "from gearlube_core.dynamics.hypoid_axle.rhs import axle_rhs\n"
        "folder = Path(sys.argv[1])\n"
        "args = pickle.loads((folder / 'args').read_bytes())\n"
        "axle_rhs(*args)\n"
        "(folder / 'slope').write_bytes(args[-1].tobytes())\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path)]
    subprocess.run(command, env=dict(environ, NUMBA_DISABLE_JIT="1"), check=True, timeout=60)
    interpreted = np.frombuffer((tmp_path / "slope").read_bytes())
    rhs.axle_rhs(*args)
    # as for the kernels one by one
    np.testing.assert_allclose(args[-1], interpreted, rtol=1e-12, atol=2e-11)
