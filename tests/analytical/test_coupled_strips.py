"""The elastic teeth under a strip of cells: their compliance adds to that of the half-space."""

import numpy as np
import pytest
from scipy.sparse import csr_array, hstack

from gearlube_core.tooth_compliance.flank_compliance import (
    FlankCompliance,
    interpolation_weights,
)
from gearlube_core.tooth_contact.coupled_strips import (
    CoupledStrip,
    PairStiffness,
    solve_coupled,
)

ARM, CELL = 40e-3, (20e-6, 250e-6)
NODES = np.array([0.0, 0.5, 1.0])


def teeth(pinion, gear):
    """Teeth that yield alike wherever the force acts: compliances of both members [m/N]."""
    even = np.ones((9, 9))
    return PairStiffness(
        pinion=FlankCompliance(s=NODES, t=NODES, image=pinion * even, elastic=even),
        gear=FlankCompliance(s=NODES, t=NODES, image=gear * even, elastic=even),
        contact_modulus=115e9,
    )


@pytest.mark.parametrize("pairs", [1, 2])
def test_even_compliances_of_both_teeth_add_their_closing_to_that_of_the_cells(pairs):
    """theta R = (half-space) + (C_p + C_g) F, whatever the pressure; each pair has its own teeth.

    Equal pairs share the force, so that each tooth bears F over the number of pairs.
    """
    nx, ny = 24, 12
    x = (np.arange(nx) - 0.5 * (nx - 1)) * CELL[0]
    gap = np.broadcast_to((x**2 / (2.0 * 10e-3))[:, None], (nx, ny)).copy()
    hats = teeth(0.0, 0.0).pinion
    weights = interpolation_weights(np.full((nx, ny), 0.6), np.linspace(0.1, 0.9, ny)[None], hats)
    strip = CoupledStrip(
        cell=CELL,
        gap=gap,
        arm=np.full((nx, ny), ARM),
        area=np.full((nx, ny), CELL[0] * CELL[1]),
        weights=csr_array(hstack([weights, weights])),
    )
    torque, C_p, C_g = 20.0, 1.5e-9, 2.5e-9
    rigid, elastic = (
        solve_coupled([strip] * pairs, stiffness, torque, 1e-10).solution.rotation
        for stiffness in (teeth(0.0, 0.0), teeth(C_p, C_g))
    )
    force = torque / ARM / pairs
    # the tolerance of the solution, of the whole rotation
    assert (elastic - rigid) * ARM == pytest.approx((C_p + C_g) * force, rel=1e-6)
