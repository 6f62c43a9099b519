"""The kernels that models and FMUs call, compiled and with all that they call interpreted."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.helpers.kernel_entries import FAMILIES, numbers
from tests.helpers.own_process import INTERPRETED, report_of


@cache
def interpreted():
    return report_of("kernel_entries", **INTERPRETED)


def check(family, **settings):
    for name, compiled in numbers(family, **settings).items():
        source = np.array(interpreted()[family][name])
        # a few operations in another order, of which forces of 24 rollers of 1 kN cancel to 1e-12
        # N; differences over 1e-5 um, as in derivatives, round 1e5 times as much
        differences = "linear" in name or "map" in name
        limit = 1e-7 if differences else 1e-9
        largest = np.abs(source[np.isfinite(source)]).max(initial=0.0)
        np.testing.assert_allclose(
            compiled, source, rtol=limit, atol=1e-9 * largest if differences else 1e-11,
            err_msg=f"{family} {name}",
        )  # fmt: skip


@pytest.mark.slow  # by default the native FMUs are compared with the models, see test_native_axle
@pytest.mark.parametrize("family", FAMILIES)
def test_compiled_entries_equal_their_source(family):
    check(family, **({"of_fmus": False} if family == "axle" else {}))


@pytest.mark.slow
def test_what_fmus_alone_call_equals_its_source():
    check("axle", of_fmus=True)
