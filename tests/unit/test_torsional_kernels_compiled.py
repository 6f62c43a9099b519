"""Every kernel of the torsional pair, compiled and in Python."""

import importlib
import pkgutil
from dataclasses import replace

import numpy as np
import pytest
from numba.core.dispatcher import Dispatcher

from gearlube_core.dynamics import hypoid_torsional
from gearlube_core.dynamics.hypoid_torsional import (
    kernel_parameters,
    mode_march,
    period_map,
    rates,
    time_sweep,
)
from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.kernels.flat_tuples import flatten
from tests.helpers.torsional_cases import reconstructed

MODELS = {
    "hot": HypoidTorsional(
        replace(karagiannis_2012_pair(), friction="thermal_eyring", torque_ripple=0.1)
    ),
    "along": HypoidTorsional(
        replace(karagiannis_2012_pair(), friction="thermal_eyring", entrainment="along_sliding")
    ),
    "cold": HypoidTorsional(replace(karagiannis_2012_pair(), friction="evans_johnson")),
    "printed": HypoidTorsional(
        reconstructed(
            0.003, equations="as_printed", damping_gate="as_printed", load_torque="instantaneous"
        )
    ),
    "reduced": HypoidTorsional(reconstructed(form="one_dof", torque_ripple=0.1)),
}
HOT = MODELS["hot"]
P = HOT.kernel_parameters
ROWS = HOT.rows(16)
MESH = HOT._series, HOT._orders, HOT._window, HOT._nodes, 13.0
W_P, W_G, LOAD, SPEED = 900.0, 325.0, 138.0, 905.0
FLANK = kernel_parameters.PAIRS_AT + int(np.argmax(ROWS[3, kernel_parameters.PAIRS_AT :: 10])) * 10
SLOPES = mode_march.AngleSlope(1.0, 2.0, 3.0, 4.0, 5.0), mode_march.AngleSlope(*range(5))


def zeros(*shape):
    return np.zeros(shape)


PER_SPEED = zeros(2), zeros(2)
WORK = zeros(mode_march.MARCH_WORK)
CASES = [
    (kernel_parameters.mesh_row, (*MESH, 0.3, zeros(kernel_parameters.N_ROW))),
    (kernel_parameters.mesh_rows, (*MESH, zeros(8, kernel_parameters.N_ROW))),
    (kernel_parameters.rows_between, (ROWS, 30, 0.2, 0.9, zeros(3, kernel_parameters.N_ROW))),
    (rates.ripple, (0.3, P)),
    (period_map._add_row, (zeros(4, 5), *SLOPES, 0.1, 2)),
]
for name, model in MODELS.items():
    p, rows = model.kernel_parameters, model.rows(16)
    start = model.initial_state(SPEED)
    for x in (3e-6, 0.2e-6, -20e-6, -153e-6):
        for rate in (-0.4, -0.05):
            mode = rates.contact_mode(x, rate, 4e8, p)
            CASES += [(rates.contact_mode, (x, rate, 4e8, p))]
            CASES += [(rates.force_in_mode, (mode, x, rate, 4e8, p))]
            CASES += [(rates.mode_margin, (mode, x, rate, 4e8, p))]
        y = np.array([x * 1e6, *start[1:]])
        at = y[0], y[1], y[2], 0.1, LOAD, SPEED, rows, 3, mode, p
        CASES += [
            (mode_march.angle_slope, at),
            (mode_march.angle_step, (y, 0.1, 0.03, LOAD, SPEED, rows, 30, mode, p)),
        ]
        step = (
            y,
            0.1,
            0.03,
            0.2,
            0,
            LOAD,
            SPEED,
            rows,
            30,
            p,
            zeros(4),
            zeros(3, kernel_parameters.N_ROW),
        )
        CASES += [
            (mode_march.part_of_step, step),
            (mode_march.approach, (y, SPEED, rows, 3, p)),
            (mode_march._margin, (mode, y, SPEED, rows, 3, p)),
            (
                period_map.tangent_step,
                (
                    y,
                    np.eye(4, 5),
                    0.1,
                    0.03,
                    LOAD,
                    SPEED,
                    rows,
                    30,
                    mode,
                    p,
                    zeros(period_map.WORK),
                ),
            ),
        ]
        if name == "reduced":
            CASES += [(rates.reduced_approach, (y[1], SPEED, rows, 3))]
            CASES += [(rates.reduced_rates, (x, y[1], 0.1, SPEED, rows, 3, mode, p))]
        else:
            CASES += [(rates.pair_approach, (W_P, W_G, rows, 3))]
            CASES += [(rates.pair_rates, (x, W_P, W_G, 0.1, LOAD, SPEED, rows, 3, mode, p))]
    record, no_record = zeros(32, 5), zeros(0, 5)
    CASES += [
        (mode_march.march, (start, 1, 2, LOAD, SPEED, rows, p, record, WORK)),
        (mode_march.march, (start, 1, 2, LOAD, SPEED, rows, p, no_record, WORK)),
        (
            time_sweep.sweep_kernel,
            (
                start,
                np.array([SPEED, 910.0]),
                1,
                1,
                1,
                LOAD,
                rows,
                p,
                zeros(2, 16, 5),
                *PER_SPEED,
                WORK,
            ),
        ),
        (time_sweep.settle_load, (start, 2, LOAD, SPEED, rows, p, WORK)),
        (
            period_map.slope_derivative,
            (start, np.eye(4, 5), 0.1, LOAD, SPEED, rows, 3, 2, p, zeros(4), zeros(4, 5)),
        ),
        (
            period_map.period_map,
            (start, zeros(4, 5), LOAD, SPEED, 1, rows, p, zeros(period_map.WORK)),
        ),
    ]
    if name in ("hot", "along", "cold"):
        CASES += [
            (rates.flank_torques, (rows, 3, W_P, W_G, force, p)) for force in (2400.0, 0.0, -300.0)
        ]
        CASES += [(rates.pair_friction, (rows, 3, FLANK, 900.0, 4.0, W_P, W_G, p))]
        CASES += [(rates.thermal_pair, (rows, 3, FLANK, 900.0, W_P, W_G, p))]
BROKEN = np.array([2e5, SPEED, SPEED, 0.0])
CASES += [
    (time_sweep.settle_load, (BROKEN, 2, LOAD, SPEED, ROWS, P, WORK)),
    (mode_march.march, (BROKEN, 0, 1, LOAD, SPEED, ROWS, P, zeros(0, 5), WORK)),
    (
        time_sweep.sweep_kernel,
        (BROKEN, np.array([SPEED]), 1, 1, 1, LOAD, ROWS, P, zeros(1, 16, 5), *PER_SPEED, WORK),
    ),
    (period_map.period_map, (BROKEN, zeros(4, 5), LOAD, SPEED, 1, ROWS, P, zeros(period_map.WORK))),
]


def everything(function, args):
    """What a function returns or writes, as one array."""
    own = tuple(a.copy() if isinstance(a, np.ndarray) else a for a in args)
    returned = function(*own)
    parts = [np.ravel(a) for a in own if isinstance(a, np.ndarray)]
    if returned is not None:
        parts.append(np.ravel(flatten(returned) if isinstance(returned, tuple) else returned))
    return np.concatenate(parts)


@pytest.mark.parametrize(
    ("kernel", "args"), CASES, ids=[f"{k.__name__}-{i}" for i, (k, _) in enumerate(CASES)]
)
def test_compiled_equals_python(kernel, args):
    compiled, source = everything(kernel, args), everything(kernel.py_func, args)
    # the compiler may fuse products: differences of x' at 20 m/s round at 1e-15 of that, which
    # steps of 1e-5 um in the derivatives raise to 1e-9
    derived = kernel.__name__ in ("period_map", "slope_derivative", "tangent_step")
    scale = np.max(np.abs(source[np.isfinite(source)]))
    limit = 1e-7 if derived else 1e-12
    np.testing.assert_allclose(compiled, source, rtol=limit, atol=1e-15 * scale)


def test_no_kernel_is_left_out():
    found = set()
    for m in pkgutil.iter_modules(hypoid_torsional.__path__):
        name = f"{hypoid_torsional.__name__}.{m.name}"
        values = vars(importlib.import_module(name)).values()
        found |= {v for v in values if isinstance(v, Dispatcher) and v.py_func.__module__ == name}
    assert found == {kernel for kernel, _ in CASES}
