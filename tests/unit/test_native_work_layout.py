"""Places in the work array of the native helical pair."""

import numpy as np

from fmu_src.native import helical_pair as native
from gearlube_core.dynamics.helical_pair.march.equilibrium import EQUILIBRIUM_WORK
from gearlube_core.dynamics.helical_pair.march.flanks import LINES_MAX
from gearlube_core.dynamics.helical_pair.march.integrate import WORK_SIZE
from gearlube_core.dynamics.helical_pair.march.mesh_data import pack_march_mesh
from gearlube_core.dynamics.helical_pair.march.state import N_STATE
from gearlube_core.mesh_table.line_mesh import LineMesh


def test_density_of_as_many_lines_as_there_may_be_has_room():
    one_density = np.full((1, 1, LINES_MAX, 1), 1e10)
    mesh = LineMesh(
        name="uniform", source="made up", pinion_teeth=25, gear_teeth=31, base_pitch=9e-3,
        torque=np.array([200.0]), phase=np.zeros(1), station=np.array([0.5]),
        density=one_density, offset=np.zeros_like(one_density),
    )  # fmt: skip
    needed = pack_march_mesh(mesh).density.shape[1]
    assert needed == native.TRIAL_AT - native.DENSITY_AT


def test_trial_state_and_scratch_have_room():
    assert native.SCRATCH_AT - native.TRIAL_AT == N_STATE
    assert native.DATA_AT - native.SCRATCH_AT >= WORK_SIZE
    assert native.DATA_AT - native.SCRATCH_AT >= EQUILIBRIUM_WORK + N_STATE
    assert native.BEARINGS_AT - native.LIMITS_AT == 2 * native.N_INPUTS  # low and high
    assert native.CONTROL_AT - native.INPUTS_AT == native.N_INPUTS
    assert native.INPUTS_AT == N_STATE
