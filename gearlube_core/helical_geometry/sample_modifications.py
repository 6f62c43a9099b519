"""The modified flanks of the thesis' two gear pairs."""

from __future__ import annotations

from gearlube_core.checks import check_option
from gearlube_core.helical_geometry.modification import Crown, FlankModification, ModifiedPair
from gearlube_core.helical_geometry.sample_pairs import named_pair
from gearlube_core.helical_geometry.tip_relief import PowerTipRelief, TipRelief

_AMOUNT, _EXTENT, _CROWN = 70e-6, 2e-3, 8e-6  # m, Jamali 2015 Table 4.1


def jamali_2015(
    design: str,
    *,
    k: float = 1.0,
    beta: float | None = None,
    crown_start: float = 0.0,
    facets: int = 0,
) -> ModifiedPair:
    """Return design "a" or "b" of Jamali 2015 Table 4.1 with relief and crown on all flanks.

    Parameters
    ----------
    design
        "a" (33:34) or "b" (33:99).
    k
        Parabolic share of the tip relief (eq. 5.2) [-]; 1 is the thesis' default.
    beta
        Given, the relief follows the power law (5.6) instead [-].
    crown_start
        F_o [m]; 0 is the default.
    facets
        n_f of chapter 6 on both flanks [-]; 0 is smooth.

    Returns
    -------
    ModifiedPair
        The crown of 8 um is on both teeth: with one crowned tooth the contact at the largest load
        would be longer than the 0.93 w of sec. 4.3.
    """
    check_option("design", design, ("a", "b"))
    relief: TipRelief | PowerTipRelief = TipRelief(amount=_AMOUNT, extent=_EXTENT, k=k)
    if beta is not None:
        relief = PowerTipRelief(amount=_AMOUNT, extent=_EXTENT, beta=beta)
    crown = Crown(amount=_CROWN, start=crown_start)
    flank = FlankModification(tip_relief=relief, crown=crown, facets=facets)
    return ModifiedPair(pair=named_pair(f"jamali_2015_{design}"), pinion=flank, gear=flank)
