"""Kernels of the mesh cycle, compiled and in Python."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from numba.core.dispatcher import Dispatcher

from gearlube_core.dynamics.hypoid_axle import mesh_cycle
from gearlube_core.dynamics.hypoid_axle.bearing_drag import AxleRaceways
from gearlube_core.dynamics.hypoid_axle.integrate import step_inputs
from gearlube_core.dynamics.hypoid_axle.kernel_parameters import without_losses
from gearlube_core.dynamics.hypoid_axle.mesh_at_load import MeshAtLoad, MeshLevels, blend_mesh
from gearlube_core.oil.lubricant import lubricant_state
from tests.helpers.axle_cases import OIL, running_axle
from tests.helpers.kernel_results import everything

KERNELS = sorted(
    {
        value
        for value in vars(mesh_cycle).values()
        if isinstance(value, Dispatcher) and value.py_func.__module__ == mesh_cycle.__name__
    },
    key=lambda kernel: kernel.__name__,
)
SPEED = 150.0


@cache
def all_cases():
    axle, torque, wheel_torque = running_axle(60)
    p, mesh, state = axle.kernel_parameters, axle.packed, axle.get_state()[: axle.state_view.size]
    table = MeshLevels(mesh.levels, mesh.series, mesh.orders, mesh.windows, mesh.nodes)
    data = MeshAtLoad(
        np.zeros(mesh.series_size), mesh.orders, np.zeros(mesh.window_size), mesh.nodes
    )
    blend_mesh(torque, 1.0, table, data)
    oil = lubricant_state(p.oil, OIL)
    inputs = step_inputs(state, torque, wheel_torque, oil, p, AxleRaceways())
    work = np.zeros(mesh_cycle.cycle_work(mesh.orders, mesh.nodes))
    losses = np.zeros(mesh_cycle.N_LOSSES)
    found = np.array([math.inf, OIL, 4.0, 0.1, 0.2, 0.3, 0.4])
    cycle = (state, SPEED, torque, OIL, 3, table, p, without_losses(p), work, losses)
    coast = (state, SPEED, -torque, *cycle[3:])
    return (
        (mesh_cycle.quasi_static_state, (state, torque, SPEED, data, p)),
        (mesh_cycle.quasi_static_state, (state, -torque, SPEED, data, p)),
        (mesh_cycle.mean_rates, (state, torque, SPEED, 3, inputs, data, oil, p, work)),
        (mesh_cycle.mesh_cycle, cycle),
        (mesh_cycle.mesh_cycle, coast),
        (mesh_cycle.flank_extremes, (axle.outputs.copy(), found)),
    )


@pytest.mark.parametrize("kernel", KERNELS, ids=lambda kernel: kernel.__name__)
def test_compiled_kernel_equals_its_source(kernel):
    cases = [args for one, args in all_cases() if one is kernel]
    assert cases
    for args in cases:
        compiled, source = everything(kernel, args), everything(kernel.py_func, args)
        for one, two in zip(compiled, source, strict=True):
            # roundings of bearing forces of 1 kN that cancel, over masses of 12 kg
            limit = 1e-9 * max(1.0, float(np.abs(two[np.isfinite(two)]).max(initial=0.0)))
            np.testing.assert_allclose(one, two, rtol=1e-9, atol=limit)
