"""Error bars of the laws of bearing friction against two measured bearings."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.stats import chi2

from docs.bearing.make import LAWS, ratios, ratios_32008
from gearlube_core.bearings.losses.loss import UNCALIBRATED
from tests.helpers.each import each


@each("law", LAWS)
def test_the_error_bar_holds_95_percent_of_the_measured_torques(law):
    misfits = np.log(np.concatenate([ratios(law), ratios_32008(law)]))
    factor = UNCALIBRATED[law]
    assert misfits.size == 25
    assert np.mean(np.abs(misfits) < math.log(factor)) >= 0.95
    # 95 % of a normal misfit about zero, with 95 % confidence from half as many points: those of
    # one bearing share their error. chi2_0.05(12.5) is 5.56
    assert chi2.ppf(0.05, 12.5) == pytest.approx(5.56, abs=0.01)
    wanted = math.exp(1.96 * math.sqrt(np.mean(misfits**2) * 12.5 / 5.56))
    assert factor >= max(2.0, wanted)
    assert factor < max(2.0, wanted) + 0.5  # no wider than the next half
