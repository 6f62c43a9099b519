"""Viscosity and density on a grid, cold and warm, against laws node by node and differences."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.oil import film_oil as module
from gearlube_core.oil.film_laws import density_ratio, log_viscosity
from gearlube_core.oil.film_oil_data import film_oil
from tests.helpers.source_of import interpret

OIL = film_oil(eta0=0.04, alpha=1.7e-8, rho0=870.0)
P = np.array([[0.0, 2e7, 3e8], [1e8, 7e8, 5e7]])
COOLING = np.array([[1.0, 0.93, 0.8], [0.7, 0.97, 0.9]])
DILATION = np.array([[1.0, 0.97, 0.99], [0.94, 0.98, 0.96]])


@pytest.mark.parametrize("warm", [None, (COOLING, DILATION)], ids=["cold", "warm"])
def test_fields_hold_the_laws_and_their_slopes(monkeypatch, warm):
    interpret(monkeypatch, module)
    cooling, dilation = warm or (np.ones_like(P), np.ones_like(P))
    eta, eta_slope, rho, rho_slope = module.film_properties(OIL, P, warm)

    def viscosity(p: float, factor: float) -> float:
        return 0.04 * math.exp(log_viscosity(OIL.viscosity, p, factor)[0])

    for at in np.ndindex(P.shape):
        p, step = P[at], 1e3
        assert eta[at] == pytest.approx(viscosity(p, cooling[at]), rel=1e-12)
        # central differences, and at ambient pressure one of one side, which errs by alpha step
        low = max(p - step, 0.0)
        change = viscosity(p + step, cooling[at]) - viscosity(low, cooling[at])
        assert eta_slope[at] == pytest.approx(change / (p + step - low), rel=1e-4)
        ratio = [density_ratio(OIL.density, one)[0] for one in (p, p + step, low)]
        assert rho[at] == pytest.approx(870.0 * dilation[at] * ratio[0], rel=1e-12)
        change = 870.0 * dilation[at] * (ratio[1] - ratio[2])
        assert rho_slope[at] == pytest.approx(change / (p + step - low), rel=1e-4)
