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

from gearlube_core.bearings import shaft_expansion
from gearlube_core.dynamics import flank_force, hypoid_axle, mean_power
from gearlube_core.dynamics.hypoid_axle import (
    rhs,
)
from gearlube_core.mesh_table import kernels
from tests.helpers.axle_compiled_arguments import COMPILED
from tests.helpers.axle_kernel_arguments import all_cases
from tests.helpers.kernel_results import everything, own_arrays

# test_bearing_kernels.py
ENERGIES = {
    shaft_expansion.roller_energy,
    shaft_expansion._sum_line,
    shaft_expansion.bearing_energy,
    shaft_expansion.shaft_bearing_energy,
}


def kernels_of_these_modules():
    found = {m.name for m in pkgutil.iter_modules(hypoid_axle.__path__)}
    found.remove("mesh_cycle")  # test_mesh_cycle_kernels_compiled.py
    names = [f"{hypoid_axle.__name__}.{name}" for name in sorted(found)]
    names += [kernels.__name__, shaft_expansion.__name__, flank_force.__name__]
    names += [mean_power.__name__]
    return {
        value
        for name in names
        for value in vars(importlib.import_module(name)).values()
        if isinstance(value, Dispatcher) and value.py_func.__module__ == name
    } - ENERGIES


KERNELS = sorted(kernels_of_these_modules() | set(COMPILED), key=lambda kernel: kernel.__name__)


SUMMING = {"_sums_line", "_sums_general", "expand_shaft_bearings"}
SUMMING |= {"expanded_shaft_forces"}
# the same sums, 24 rollers of 1 kN that cancel to a few 1e-16 each, over a pinion of 12 kg
ACCELERATING = {"axle_rhs", "rk4_step", "advance", "write_outputs"}
ACCELERATING |= {"communication_step", "step_without_outputs", "outputs", "write_derivatives"}
ACCELERATING |= {"_write_rates"}
ACCELERATING |= {"continuous_rates"}


def same(kernel, compiled, source, case):
    for one, two in zip(compiled, source, strict=True):
        limit = 0.0
        if kernel.__name__ in SUMMING:
            limit = 1e-12 * np.abs(two).max()
        elif kernel.__name__ in ACCELERATING:
            limit = 2e-11
        # rounding: a few operations in another order
        np.testing.assert_allclose(one, two, rtol=1e-12, atol=limit, err_msg=f"case {case}")


# large kernels that others contain: communication_step and axle_rhs are compared by default
CONTAINED = {"advance", "rk4_step", "flank_sum", "pair_friction", "_sums_line", "_sums_general",
             "write_flanks", "write_outputs", "mesh_force", "stored_energy"}  # fmt: skip


@pytest.mark.parametrize(
    "kernel",
    [
        pytest.param(one, id=one.__name__, marks=[pytest.mark.slow] * (one.__name__ in CONTAINED))
        for one in KERNELS
    ],
)
def test_compiled_kernel_equals_its_source(kernel):
    cases = [args for one, args in all_cases() if one is kernel]
    for case, args in enumerate(cases):
        same(kernel, everything(kernel, args), everything(kernel.py_func, args), case)


def test_no_kernel_of_these_modules_is_left_out():
    assert set(KERNELS) == {kernel for kernel, _ in all_cases()}


def test_the_whole_right_hand_side_is_the_same_interpreted(tmp_path):
    """Everything interpreted, so that no compiled callee hides a difference."""
    args = own_arrays(next(args for kernel, args in all_cases() if kernel is rhs.axle_rhs))
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
