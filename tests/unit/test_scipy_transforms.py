"""Deflections without pyfftw: SciPy's transforms give the numbers of FFTW."""

import sys

import numpy as np
import pytest

from gearlube_core.contact import fftw, half_space, half_space_periodic

E_STAR = 115.4e9  # Pa


def half_space_under(single):
    coefficients = half_space.love_coefficients(1e-5, 2e-5, 40, 27, E_STAR)
    return half_space.HalfSpaceConvolution(coefficients, single=single), (40, 27)


def periodic_under(axis, nx, ny):
    modes = half_space_periodic.periodic_modes(1e-5, 2e-5, nx, ny, E_STAR, 1e-3)
    shape = (nx, ny) if axis == "last" else (ny, nx)
    return half_space_periodic.PeriodicDeflection(modes, ny, axis), shape


@pytest.mark.parametrize(
    ("build", "arguments", "within"),
    [
        (half_space_under, (False,), 1e-13),
        (half_space_under, (True,), 1e-6),  # float32
        (periodic_under, ("last", 33, 12), 1e-13),
        (periodic_under, ("first", 33, 12), 1e-13),
        (periodic_under, ("first", 400, 200), 1e-13),  # in blocks: more than 1 MB
    ],
)
def test_deflections_are_those_of_fftw_to_round_off(monkeypatch, build, arguments, within):
    found = []
    for transforms in (fftw.pyfftw, fftw.scipy_transforms):
        for module in (half_space, half_space_periodic):
            monkeypatch.setattr(module, "pyfftw", transforms)
        deflection, shape = build(*arguments)
        pressure = np.random.default_rng(1).random(shape)
        for _ in range(2):  # buffers are used again
            found.append(deflection(pressure).copy())
    assert np.ptp(found[0]) > 0.0
    for one in found[1:]:
        assert np.abs(one - found[0]).max() < within * np.abs(found[0]).max()


def test_scipy_takes_over_where_pyfftw_is_not_installed(monkeypatch):
    assert fftw._installed() is fftw.pyfftw
    monkeypatch.setitem(sys.modules, "pyfftw", None)  # as if it were not installed
    assert fftw._installed() is fftw.scipy_transforms
