"""Dimensionless form of a line contact: x/b, p/p_H, h R/b^2; defined only here."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.ehl.line.problem import LineProblem
from gearlube_core.ehl.line.rows import STENCILS, RowCoefficients

# Hertz pressures; the film's order is lost only where the pressure is of this size
_BLEND = 1e-3


class LineScales(NamedTuple):
    """Units of the dimensionless form."""

    length: float  # b [m]
    pressure: float  # p_H [Pa]
    film: float  # b^2/R [m]
    speed: float  # reference speed [m/s]

    @property
    def time(self) -> float:
        """Unit of time, length over speed [s]."""
        return self.length / self.speed


def line_scales(problem: LineProblem) -> LineScales:
    """Return the units of a problem; the speed is the largest of mean and surface speeds."""
    b = problem.half_width
    speed = max(abs(problem.entrainment_speed), abs(problem.speed_1), abs(problem.speed_2))
    return LineScales(b, problem.hertz_pressure, b * b / problem.radius, speed or 1.0)


def row_coefficients(
    problem: LineProblem, scales: LineScales, step: float, stencil: str, mass_conserving: bool
) -> RowCoefficients:
    """Return the numbers of a steady balance on a grid of spacing `step` [Hertz half widths].

    1/lambda = H-scale^3 p_H/(12 eta0 b) over the flow scale u_ref b^2/R
    """
    oil = problem.lubricant
    tau0 = oil.shear.tau0
    flow = scales.film**2 * scales.pressure / (12.0 * oil.eta0 * scales.length)
    sliding = problem.speed_2 - problem.speed_1
    return RowCoefficients(
        step=step,
        speed=problem.entrainment_speed / scales.speed,
        mobility=flow / scales.speed,
        pressure=scales.pressure,
        sigma=scales.film * scales.pressure / (2.0 * tau0 * scales.length) if tau0 else 0.0,
        shear=oil.eta0 * sliding / (scales.film * tau0) if tau0 else 0.0,
        weight=1.0,
        storage=0.0,
        stencil=STENCILS[stencil],
        blend=_BLEND if mass_conserving else 0.0,
    )
