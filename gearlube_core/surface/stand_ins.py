"""Stand-ins for the measured profiles of [jamali_2015 7.6, 7.9], which are not published.

What is published: a profile of a disc, 4 mm long with Ra 0.31 um, from which parts of 149 and
100 um (cases A and B, from two places) and of 114 and 131 um (case C, from one place) are
repeated; the spacing is a/200. All else is assumed here: skewness, kurtosis, correlation length
and band.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlube_core.checks import check_option
from gearlube_core.errors import ParameterError
from gearlube_core.surface.extrusion import Lay, periodic_section
from gearlube_core.surface.generator import Generated, generated_profile
from gearlube_core.surface.generator_request import RoughnessRequest
from gearlube_core.surface.heights import Profile

CASES = ("A", "B", "C")
SEEDS = (1, 2, 3, 4, 5)
WIDTH = 1e-3  # m, L_y
_LENGTH, _SPACING = 4e-3, 1.19e-6  # m, a/200 with a = 0.238 mm
# periods [m] of the fast and the slow surface, and where their parts begin [m]
_PARTS = {
    "A": ((149e-6, 0.5e-3), (100e-6, 1.2e-3)),
    "B": ((149e-6, 2.0e-3), (100e-6, 3.0e-3)),
    "C": ((114e-6, 0.5e-3), (131e-6, 0.5e-3)),
}
_MEAN = 0.31e-6  # m, Ra
_REQUEST = RoughnessRequest(
    arithmetic_mean=_MEAN,
    correlation_length=8e-6,  # m, assumed
    skewness=-0.7,  # assumed: run in, more valleys than peaks
    kurtosis=4.0,  # assumed
    shortest_wave=12e-6,  # m, assumed: ten points
    longest_wave=100e-6,  # m, assumed: the shortest part
)


@dataclass(frozen=True, eq=False, slots=True, kw_only=True)
class StandIn:
    """Profiles of both surfaces of a case; no measured ones, but made to their few known numbers.

    Parameters
    ----------
    case
        A, B or C.
    seed
        Of the long profile.
    full
        The 4 mm from which both are cut.
    fast, slow
        Periodic parts for the faster and the slower surface.
    """

    case: str
    seed: int
    full: Generated[Profile]
    fast: Profile
    slow: Profile

    @property
    def lays(self) -> tuple[Lay, Lay]:
        """Lays of the fast and the slow surface over 1 mm, one turn each."""
        fast, slow = (
            Lay(period=one.length, width=WIDTH, turns=1) for one in (self.fast, self.slow)
        )
        return fast, slow


def stand_in(case: str, seed: int = SEEDS[0], *, same_mean: bool = False) -> StandIn:
    """Return made-up profiles for both surfaces of a case of Jamali 2015.

    The measured profiles are not published. The long made-up profile has Ra 0.31 um; its short
    parts scatter about that, as parts of a measured profile do.

    Parameters
    ----------
    case
        A, B or C. Case C prescribes the longer period for the slower surface, which helical
        teeth cannot have; so in this case the faster surface has the larger angle.
    seed
        Whole number from 0; published results of this package are for 1 to 5.
    same_mean
        Scale each part to Ra 0.31 um too.

    Raises
    ------
    ParameterError
        The case is not known, or the seed is no whole number from 0.

    Examples
    --------
    >>> [round(lay.angle * 180.0 / np.pi, 3) for lay in stand_in("A").lays]
    [8.475, 5.711]
    """
    check_option("case", case, CASES)
    if isinstance(seed, bool) or seed != int(seed) or seed < 0:
        raise ParameterError(f"seed must be a whole number from 0 on, got {seed!r}.")
    count = round(_LENGTH / _SPACING)
    full = generated_profile(_REQUEST, _LENGTH, count, np.random.default_rng(seed))
    fast, slow = (periodic_section(full.surface, start, length) for length, start in _PARTS[case])
    if same_mean:
        fast, slow = _scaled(fast), _scaled(slow)
    return StandIn(case=case, seed=seed, full=full, fast=fast, slow=slow)


def _scaled(part: Profile) -> Profile:
    factor = _MEAN / float(np.abs(part.height).mean())
    return replace(part, height=factor * part.height)
