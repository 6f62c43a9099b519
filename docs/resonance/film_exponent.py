"""How the film follows the load, claim 16."""

from __future__ import annotations

import math

from docs.resonance.contacts import Contacts
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import PAIRS_AT, TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import thermal_pair
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.friction.thermal_eyring_data import INLET

_STEP = 1e-3


def load_exponents(contacts: Contacts) -> tuple[float, float]:
    """Return d ln h/d ln W at the hardest loaded contact: film at inlet and as it is run."""
    p = contacts.cycle.motion.problem.model.kernel_parameters
    inlet = p._replace(thermal=p.thermal._replace(film_temperature=INLET))
    return _exponent(contacts, inlet), _exponent(contacts, p)


def _exponent(contacts: Contacts, p: TorsionalParameters) -> float:
    motion = contacts.cycle.motion
    pair, sample = contacts.cycle.hardest
    rows = motion.problem.model.rows(motion.orbit.x.size)[::2]
    load = contacts.at_hardest("load")
    speeds = float(motion.orbit.pinion_speed[sample]), float(motion.orbit.gear_speed[sample])
    at = PAIRS_AT + pair * N_CHANNELS
    films = [
        thermal_pair(rows, sample, at, float(load * factor), *speeds, p).film_thickness
        for factor in (1.0 - _STEP, 1.0 + _STEP)
    ]
    return math.log(films[1] / films[0]) / math.log((1.0 + _STEP) / (1.0 - _STEP))
