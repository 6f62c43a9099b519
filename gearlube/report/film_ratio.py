"""What a film ratio (film over composite rms roughness) and the temperature of a film say."""

from __future__ import annotations

from collections.abc import Callable

import xarray as xr

from gearlube.report.parts import GOOD, NOTE, WARNING, Finding

FULL_FILM, MIXED = 3.0, 1.0  # between full film, mixed and mostly dry contact


def film_ratio_level(ratio: float) -> str:
    """Return how a finding with this film ratio is shown: good, note or warning."""
    return GOOD if ratio >= FULL_FILM else NOTE if ratio >= MIXED else WARNING


def film_ratio_words(ratio: float) -> str:
    """Return a sentence on what carries the load.

    Examples
    --------
    >>> film_ratio_words(0.4)
    'Below 1 asperities carry much of the load; watch wear and friction.'
    """
    if ratio >= FULL_FILM:
        return f"Above {FULL_FILM:g}: full film."
    if ratio >= MIXED:
        return f"Below {FULL_FILM:g} the highest asperities are in contact: mixed lubrication."
    return f"Below {MIXED:g} asperities carry much of the load; watch wear and friction."


def hot_film(
    hottest: xr.DataArray, oil_end: float, where: Callable[[xr.DataArray], str]
) -> list[Finding]:
    """Return the finding of films hotter than the oil data; may be empty.

    Parameters
    ----------
    hottest : DataArray
        Temperature of the hottest film at each point [degC]; nan where there is none.
    oil_end : float
        Highest temperature of the oil data [degC]; nan if it is not known.
    where : callable
        Returns where a point is, from its element of `hottest`.
    """
    beyond = hottest > oil_end
    if not beyond.any():
        return []
    worst = hottest.isel(hottest.argmax(list(hottest.dims), skipna=True))  # type: ignore[arg-type]
    share = 100.0 * float(beyond.sum() / hottest.notnull().sum())
    return [
        Finding(
            WARNING,
            f"The hottest flank film, {float(worst):.0f} °C at {where(worst)}, is extrapolated: "
            f"the oil data end at {oil_end:.0f} °C.",
            "Read it as hotter than the data, not as a temperature. Film and friction follow the "
            f"same laws of the oil beyond their data, at {share:.0f} % of the points.",
        )
    ]
