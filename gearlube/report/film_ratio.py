"""What a film ratio says: film over the composite rms roughness of both surfaces."""

from __future__ import annotations

from gearlube.report.parts import GOOD, NOTE, WARNING

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
