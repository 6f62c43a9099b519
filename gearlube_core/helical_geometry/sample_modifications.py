"""The modified flanks of the thesis' two gear pairs."""

from __future__ import annotations

from gearlube_core.checks import check_option
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.gear_file_sections import Member
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.units import MILLIMETRE


def jamali_2015(
    design: str,
    *,
    k: float = 1.0,
    beta: float | None = None,
    crown_start: float = 0.0,
    facets: int = 0,
) -> ModifiedPair:
    """Return design "a" or "b" of [jamali_2015 Table 4.1] with its relief and crown on all flanks.

    Parameters
    ----------
    design
        "a" (33:34) or "b" (33:99).
    k
        Parabolic share of the tip relief k of [jamali_2015 (5.2)] [-]; 1 is the default there.
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
    file = HelicalGearFile.named(f"jamali_2015_{design}")
    changes: dict[str, float | str] = {
        "tip_relief_parabola": k,
        "crown_start_mm": crown_start / MILLIMETRE,
        "facets": facets,
    }
    if beta is not None:
        changes |= {"tip_relief_form": "power", "tip_relief_exponent": beta}

    def changed(member: Member) -> Member:
        return member.model_copy(update={"flank": member.flank.model_copy(update=changes)})

    members = {"pinion": changed(file.pinion), "gear": changed(file.gear)}
    return file.model_copy(update=members).modified_pair()
