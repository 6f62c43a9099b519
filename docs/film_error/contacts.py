"""Random contacts, drawn with a seed, whose error of the grid is looked at."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlube_core.contact.hertz import log_curvature_ratio
from gearlube_core.ehl.point.contact_domain import elliptical_contact
from gearlube_core.ehl.point.problem import PointContactProblem
from gearlube_core.oil.film_oil_data import film_oil

SEED = 20260
COUNT = 300
LOADS = (5.0, 1000.0)  # M, drawn evenly in its logarithm, as are the next two
MATERIALS = (2.0, 20.0)  # L
ELLIPTICITIES = (0.4, 5.0)  # a_y/a_x of the dry contact
SLIDE_ROLL = (0.0, 1.0)
EYRING_STRESSES = (2e6, 10e6)  # Pa, of every other contact
MOST_PRESSURE = 3e9  # Pa, of the dry contact; those above are drawn again

RADIUS = 0.01  # m, along the motion
REDUCED_MODULUS = 2.26e11  # Pa
ALPHA = 2e-8  # 1/Pa
ETA0 = 0.04  # Pa s


@dataclass(frozen=True, slots=True, kw_only=True)
class RandomContact:
    """A smooth contact entrained along x; `eyring_stress` [Pa], 0: Newtonian."""

    number: int
    M: float
    L: float
    ellipticity: float
    slide_roll: float
    eyring_stress: float

    def problem(self, nodes: int) -> PointContactProblem:
        """Return the contact on a square number of nodes."""
        U = 0.5 * (self.L / (ALPHA * REDUCED_MODULUS)) ** 4
        speed = U * REDUCED_MODULUS * RADIUS / ETA0
        stress = self.eyring_stress or None
        return elliptical_contact(
            R_x=RADIUS,
            R_y=RADIUS * _radius_ratio(self.ellipticity),
            entrainment=(speed, 0.0),
            load=self.M * (2.0 * U) ** 0.75 * REDUCED_MODULUS * RADIUS**2,
            contact_modulus=0.5 * REDUCED_MODULUS,
            lubricant=film_oil(eta0=ETA0, alpha=ALPHA, eyring_stress=stress),
            sliding=(self.slide_roll * speed, 0.0),
            nodes=(nodes, nodes),
        )


def random_contacts(count: int = COUNT, seed: int = SEED) -> list[RandomContact]:
    """Return the first `count` contacts of a seed."""
    numbers = np.random.default_rng(seed)
    contacts: list[RandomContact] = []
    while len(contacts) < count:
        M, L, ellipticity = (
            math.exp(numbers.uniform(*map(math.log, limits)))
            for limits in (LOADS, MATERIALS, ELLIPTICITIES)
        )
        slide_roll, stress = numbers.uniform(*SLIDE_ROLL), numbers.uniform(*EYRING_STRESSES)
        contact = RandomContact(
            number=len(contacts),
            M=M,
            L=L,
            ellipticity=ellipticity,
            slide_roll=slide_roll,
            eyring_stress=stress if len(contacts) % 2 else 0.0,
        )
        if contact.problem(129).hertz_contact[2] <= MOST_PRESSURE:
            contacts.append(contact)
    return contacts


def _radius_ratio(ellipticity: float) -> float:
    exponent = log_curvature_ratio(abs(math.log(ellipticity)))
    return math.exp(exponent if ellipticity >= 1.0 else -exponent)
