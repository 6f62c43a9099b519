"""Maps and oscillators with known periodic motions, shared by tests of the search for them."""

import math
from typing import NamedTuple

import numpy as np

from gearlube_core.kernels.jit import kernel
from gearlube_core.periodic import PeriodicProblem, fixed_point_residual

PARAMETERS = {"frequency": 0.0, "stiffness": 1.0, "force": 2.0}


class Oscillator(NamedTuple):
    """x'' = f cos wt - (d - g (1 - x^2)) x' - (k + e cos wt + b x^2) x - s max(x - gap, 0)."""

    frequency: float = 1.0
    stiffness: float = 1.0
    force: float = 0.0
    damping: float = 0.0
    self_excitation: float = 0.0
    parametric: float = 0.0
    cubic: float = 0.0
    stop: float = 0.0
    gap: float = 0.0


@kernel
def acceleration(x, v, tau, o):
    return (
        (o.force - o.parametric * x) * math.cos(tau)
        - (o.damping - o.self_excitation * (1.0 - x * x)) * v
        - (o.stiffness + o.cubic * x * x) * x
        - o.stop * max(x - o.gap, 0.0)
    )


@kernel
def _rates(y, tau, o, which, slope):
    """Write d/dtau, tau = w t, of y = (x, v, four derivatives by the start, two by p)."""
    x, v, w = y[0], y[1], o.frequency
    a = acceleration(x, v, tau, o)
    a_x = (
        -o.stiffness
        - o.parametric * math.cos(tau)
        - 2.0 * o.self_excitation * x * v
        - 3.0 * o.cubic * x * x
        - (o.stop if x > o.gap else 0.0)
    )
    a_v = -o.damping + o.self_excitation * (1.0 - x * x)
    slope[0], slope[1] = v / w, a / w
    for j in range(3):
        slope[2 + j], slope[5 + j] = y[5 + j] / w, (a_x * y[2 + j] + a_v * y[5 + j]) / w
    if which == 0.0:
        slope[4] -= v / (w * w)
        slope[7] -= a / (w * w)
    elif which == 1.0:
        slope[7] -= x / w
    else:
        slope[7] += math.cos(tau) / w


@kernel
def _march(y, o, which, steps, work):
    k1, k2, k3, k4, trial = work[0], work[1], work[2], work[3], work[4]
    h = 2.0 * math.pi / steps
    for step in range(steps):
        tau = step * h
        _rates(y, tau, o, which, k1)
        trial[:] = y + 0.5 * h * k1
        _rates(trial, tau + 0.5 * h, o, which, k2)
        trial[:] = y + 0.5 * h * k2
        _rates(trial, tau + 0.5 * h, o, which, k3)
        trial[:] = y + h * k3
        _rates(trial, tau + h, o, which, k4)
        y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


def oscillator_map(oscillator, parameter, steps=256):
    """Return the map of (x, v) over one period of the force, against one parameter."""
    which, work = PARAMETERS[parameter], np.zeros((5, 8))

    def period_map(z, p):
        y = np.array([z[0], z[1], 1.0, 0.0, 0.0, 0.0, 1.0, 0.0])
        _march(y, oscillator._replace(**{parameter: p}), which, steps, work)
        derivatives = y[2:].reshape(2, 3)
        return y[:2], derivatives[:, :2], derivatives[:, 2]

    return period_map


def oscillator_problem(oscillator, parameter, *, steps=256, periods=1, scale=1.0):
    return PeriodicProblem(
        residual=fixed_point_residual(
            oscillator_map(oscillator, parameter, steps), periods=periods
        ),
        unknown_scale=np.full(2, scale),
        parameter_scale=1.0,
    )


def normal_form(f, f_z, f_p):
    """Return the problem f(z, p) = 0 of one unknown, stable where f falls with z."""

    def residual(z, p):
        slope = np.array([[f_z(z[0], p)]])
        return np.array([f(z[0], p)]), slope, np.array([f_p(z[0], p)]), np.exp(slope)

    return PeriodicProblem(residual=residual, unknown_scale=np.ones(1), parameter_scale=1.0)


def logistic_map(z, p):
    return p * z * (1.0 - z), np.array([[p * (1.0 - 2.0 * z[0])]]), z * (1.0 - z)


def delayed_logistic_map(z, p):
    """Return the map (a, b) -> (b, p b (1 - a)), May 1975."""
    a, b = z
    end = np.array([b, p * b * (1.0 - a)])
    return end, np.array([[0.0, 1.0], [-p * b, p * (1.0 - a)]]), np.array([0.0, b * (1.0 - a)])


def map_problem(period_map, count, periods=1):
    return PeriodicProblem(
        residual=fixed_point_residual(period_map, periods=periods),
        unknown_scale=np.ones(count),
        parameter_scale=1.0,
    )
