"""Torsional pairs that several tests share."""

from dataclasses import replace

import numpy as np

from gearlube_core.dynamics.hypoid_torsional.model import HypoidTorsional
from gearlube_core.dynamics.hypoid_torsional.parameters import karagiannis_2012_pair
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.synthetic_mesh import synthetic_mesh
from gearlube_core.periodic.shooting import solve_periodic


def reconstructed(mismatch=0.0, **options):
    """The pair with the paper's reconstructed numbers and a radius mismatch."""
    mesh = options.pop("mesh", {})
    pair = karagiannis_2012_pair(synthetic_mesh(radius_mismatch=mismatch, **mesh))
    return replace(pair, **{"radii": "paper", **options})


def periodic_orbit(parameters, speed_ratio, steps=256, periods=1):
    """The periodic motion reached from static deflection, mesh frequency over natural."""
    problem = PeriodProblem(parameters, periods=periods, steps_per_mesh_period=steps)
    speed = problem.model.pinion_speed(speed_ratio * problem.model.natural_frequency)
    motion = solve_periodic(problem.equations(), problem.initial_guess(speed), speed)
    return problem.orbit(motion.unknowns, speed)


def time_rates(model: HypoidTorsional, load_torque, speed):
    """d/dt of (x [m], w_p, w_g, phi_p, phi_g) for any integrator."""

    def rates(_, s):
        r = model.pair_rates(s[0], s[1], s[2], s[3], load_torque, speed)
        return np.array([r.x, r.w_p, r.w_g, s[1], s[2]])

    return rates
