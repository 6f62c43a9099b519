"""Derivatives of the Reynolds equation where the fluidity of a node depends on its film too."""

import math

import numpy as np
import pytest

from gearlube_core.ehl.point.equations import reynolds, stencil
from gearlube_core.ehl.point.equations.reynolds import (
    apply_derivatives,
    reynolds_derivatives,
    reynolds_residual,
)
from gearlube_core.ehl.point.equations.shear_factors import AlignedFactors, ObliqueFactors
from gearlube_core.ehl.point.equations.stencil import (
    OFFSETS,
    FilmFlow,
    FlowSlopes,
    MeshMetric,
    NodeSlopes,
    StencilParameters,
    TensorSlopes,
    mean_fluidity,
)
from gearlube_core.ehl.point.settings import AMBIENT
from tests.helpers.each import each
from tests.helpers.source_of import interpret, source_of

SHAPE = (6, 7)
STENCIL = StencilParameters(
    poiseuille_x=3.0,
    poiseuille_y=2.0,
    wedge_x=1.3,
    wedge_y=0.7,
    here=0.75,
    upstream=-0.125,
    downstream=0.375,
    squeeze=0.4,
)


class _SlidingFilm:
    """ln f_x = c - S g p + (n - 3) ln h with its own S, g and n at every node; f_y likewise."""

    def __init__(self) -> None:
        rng = np.random.default_rng(4)
        self.offset_x, self.offset_y = rng.uniform(-1.0, 1.0, (2, *SHAPE))
        self.stiffness = rng.uniform(0.3, 1.0, SHAPE)
        self.thickening = rng.uniform(0.5, 1.5, SHAPE)
        self.power = rng.uniform(3.2, 4.0, SHAPE)
        self.compressibility = rng.uniform(0.05, 0.2, SHAPE)
        self.metric = MeshMetric(rng.uniform(0.8, 1.2, SHAPE[1]), rng.uniform(0.8, 1.2, SHAPE[1]))

    def density(self, pressure):
        return np.exp(self.compressibility * pressure)

    def flow(self, pressure, film):
        log = -self.stiffness * self.thickening * pressure + (self.power - 3.0) * np.log(film)
        x, y = self.offset_x + log, self.offset_y + log
        return FilmFlow(self.density(pressure) * film**3, np.exp(x), np.exp(y), -x, -y)

    def slopes(self):
        zero = np.zeros(SHAPE)
        node = NodeSlopes(-self.stiffness * self.thickening, self.power - 3.0, zero, zero)
        return FlowSlopes(self.compressibility, node, node, node, node)

    def residual(self, pressure, film):
        flow, mass = self.flow(pressure, film), self.density(pressure) * film
        result = np.empty(SHAPE)
        source_of(reynolds_residual)(
            STENCIL, self.metric, pressure, mass, flow, np.zeros(SHAPE), result
        )
        return result


def _fields():
    rng = np.random.default_rng(5)
    return rng.uniform(0.2, 1.2, SHAPE), rng.uniform(0.7, 1.4, SHAPE)


def _difference(function, step=1e-5):
    # five points: a truncation of step^4, far below rounding of 1e-11
    values = [function(k * step) for k in (1, -1, 2, -2)]
    return (8.0 * (values[0] - values[1]) - (values[2] - values[3])) / (12.0 * step)


def test_derivatives_of_a_sheared_film_are_those_of_the_residual(monkeypatch) -> None:
    interpret(monkeypatch, reynolds, stencil)
    sheared, (pressure, film) = _SlidingFilm(), _fields()
    flow = sheared.flow(pressure, film)
    free = np.ones(SHAPE, dtype=np.bool_)
    free[2, 3] = False
    density = sheared.density(pressure)
    by_pressure, by_film = np.empty((2, 7, *SHAPE))
    source_of(reynolds_derivatives)(
        STENCIL,
        sheared.metric,
        pressure,
        flow,
        density,
        sheared.compressibility * density,
        film,
        sheared.slopes(),
        free,
        (0, SHAPE[0]),
        by_pressure,
        by_film,
    )
    rng = np.random.default_rng(6)
    for of_pressure, of_film in ((1.0, 0.0), (0.0, 1.0)):
        p = of_pressure * rng.standard_normal(SHAPE)
        h = of_film * rng.standard_normal(SHAPE)
        expected = _difference(lambda e, p=p, h=h: sheared.residual(pressure + e * p, film + e * h))
        found = np.empty(SHAPE)
        source_of(apply_derivatives)(
            OFFSETS, by_pressure, by_film, AMBIENT.reach(SHAPE[0]), p, h, found
        )
        assert np.abs(found - np.where(free, expected, 0.0)).max() < 1e-8
        assert found[2, 3] == 0.0
        assert np.abs(expected).max() > 1.0


@each("rise", [9e-4, -9e-4, 0.0, 2e-3, -1.5])
def test_logarithmic_mean_and_its_slopes(rise) -> None:
    here = 1.7
    mean, by_here, by_there = source_of(mean_fluidity)(here, here * math.exp(rise), rise, True)
    if rise == 0.0:
        expected, share = here, 0.5
    else:
        expected = here * math.expm1(rise) / rise
        share = 1.0 / rise - 1.0 / math.expm1(rise)  # d ln(mean)/d ln(here)
    # the series leaves rise^3/720; differences of means lose 1e-16/rise^2 to rounding
    assert mean == pytest.approx(expected, rel=1e-11)
    assert by_here == pytest.approx(expected * share, rel=3e-9)
    assert by_there == pytest.approx(expected * (1.0 - share), rel=3e-9)


@pytest.mark.parametrize("oblique", [False, True])
def test_flow_factors_multiply_the_flow_of_both_forms(oblique) -> None:
    rng = np.random.default_rng(8)
    xx, yy, xy = rng.uniform(0.5, 3.0, (3, 3, 4))
    # slopes of the factors as if ln(eta) were all that they depend on by pressure
    growth = TensorSlopes(*(NodeSlopes(*rng.uniform(0.5, 3.0, (4, 3, 4))) for _ in range(3)))

    def rates(thickening, rows=None):
        return TensorSlopes(
            *(part._replace(by_pressure=part.by_pressure * thickening) for part in growth)
        )

    factors = ObliqueFactors(xx, yy, rates, xy) if oblique else AlignedFactors(xx, yy, rates)
    cubic, log_viscosity, thickening, dense = rng.uniform(0.5, 3.0, (4, 3, 4))
    fluidity = np.exp(-log_viscosity)
    flow = factors.flow(factors.cubic_x(cubic), fluidity, log_viscosity)
    # finite elements multiply rho h^3 by the factors, differences multiply 1/eta by them
    np.testing.assert_allclose(factors.cubic_x(cubic) * fluidity, cubic * fluidity * xx)
    np.testing.assert_allclose(factors.cubic_y(cubic) * fluidity, cubic * fluidity * yy)
    cross = cubic * xy if oblique else np.zeros_like(cubic)
    np.testing.assert_allclose(factors.cubic_xy(cubic), cross)
    np.testing.assert_allclose(flow.cubic * flow.fluidity_x, cubic * fluidity * xx)
    np.testing.assert_allclose(flow.cubic * flow.fluidity_y, cubic * fluidity * yy)
    np.testing.assert_allclose(flow.resistance_x, -np.log(flow.fluidity_x))
    np.testing.assert_allclose(flow.resistance_y, -np.log(flow.fluidity_y))
    slopes = factors.slopes(dense, thickening)
    np.testing.assert_array_equal(slopes.dense, dense)
    for found, part, own in ((slopes.x, growth.xx, xx), (slopes.y, growth.yy, yy)):
        # d ln(factor/eta)/dp
        by_pressure = part.by_pressure * thickening / own - thickening
        np.testing.assert_allclose(found.by_pressure, by_pressure, atol=1e-13)
        for name in ("by_film", "by_rise_x", "by_rise_y"):
            np.testing.assert_allclose(getattr(found, name), getattr(part, name) / own)
    if oblique:
        for found, part, own in ((slopes.cross_x, growth.xx, xx), (slopes.cross_y, growth.yy, yy)):
            # quotient rule
            by_film = (growth.xy.by_film * own - xy * part.by_film) / own**2
            np.testing.assert_allclose(found.by_film, by_film, atol=1e-13)
    # elements: (rho h^3/eta factor)' by p and by ln(h)
    mobility = cubic * fluidity
    tensor = factors.tensor_slopes(mobility, dense, thickening)
    components = ((tensor.xx, growth.xx, xx), (tensor.yy, growth.yy, yy))
    if oblique:
        components += ((tensor.xy, growth.xy, xy),)
    for found, part, own in components:
        by_pressure = part.by_pressure * thickening + own * (dense - thickening)
        np.testing.assert_allclose(found.by_pressure, mobility * by_pressure, atol=1e-12)
        np.testing.assert_allclose(found.by_film, mobility * (part.by_film + 3.0 * own))
        np.testing.assert_allclose(found.by_rise_y, mobility * part.by_rise_y)
