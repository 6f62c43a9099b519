"""Share of a load that asperities carry over the film ratio, Zhou and Hoeprich 1991."""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel

# of rollers on a race, the values of [wingertszahn_2023]; none for gear flanks are known
RACE_B, RACE_C = 2.32, 0.97


@kernel
def asperity_share(film_ratio: float, B: float, C: float) -> float:
    """Return the share of the load that asperities carry, exp(-B Lambda^C) [-].

    Parameters
    ----------
    film_ratio
        Lambda, film over composite rms roughness [-].
    B, C
        Of the pair of surfaces [-]: 1.90 and 0.99 for a rib, 2.32 and 0.97 for a race, the
        values of [wingertszahn_2023].

    Notes
    -----
    The printed equation lost its minus; without it the share would be above 1.
    Source: [zhou_hoeprich_1991 (45)]
    """
    return math.exp(-B * max(film_ratio, 0.0) ** C)
