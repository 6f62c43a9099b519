"""The pair of He et al. 2007; data missing in the paper are completed."""

from __future__ import annotations

from gearlube_core.dynamics.helical_pair.gear_file_pair import helical_pair_parameters
from gearlube_core.dynamics.helical_pair.parameters import HelicalPairParameters
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.pair import HelicalPair

PINION_TORQUE = 225.96966  # N.m, 2000 lbf in, [he_2007 sec. 6]
PINION_SPEED = 104.71975511965977  # rad/s, 1000 rpm, [he_2007]


def he_2007_pair(mu: float, pair: HelicalPair | None = None) -> HelicalPairParameters:
    """Return the NASA-ART pair at 2000 lbf in with a constant coefficient of friction.

    Parameters
    ----------
    mu
        [-]; 0.01 and 0.1 in the paper's figures.
    pair
        Another geometry with the same bodies and bearings, for instance of another helix angle.

    Notes
    -----
    Printed: teeth, masses, polar inertias, torque. Completed: the stiffness density, see
    `iso_line_density`, and in the gear file bearings, diametral inertias (solid discs) and the
    damping of every motion.
    """
    file = HelicalGearFile.named("he_2007")
    return helical_pair_parameters(file, pinion_torque=PINION_TORQUE, mu=mu, pair=pair)
