"""Films and models in words: what limits training, and what a model is good for."""

from __future__ import annotations

import math

import numpy as np

from gearlube.studies.film_model.solves import SolveTable
from gearlube_core.arrays import Array
from gearlube_core.film_model.model import FLANK, LINE, ROLLER, FilmModel

# limiting stress over pressure: a measured polyalphaolefin, a mineral oil, and a high one; see
# docs/film_model_axle.md for the sources
LIMITS = (0.035, 0.05, 0.08)
_WORDS = {
    "pressure": ("mean pressure over E*", True),
    "ellipse": ("a_y/a_x", True),
    "psi": ("entrainment from the minor axis [deg]", False),
    "slide_roll": ("sliding over entrainment", True),
    "delta": ("sliding from entrainment [deg]", False),
    "sharpness": ("alpha p over thickness^(2/3)", True),
    "shape": ("ln(eta/eta0) over alpha p at mean pressure", True),
    "stress": ("Eyring stress at mean pressure over E*", True),
    "limited": ("1 with a local Eyring stress, 0 with a constant one", False),
    "rate": ("eta0 u/(E* R_x)", True),
    "peclet": ("u R_x over the solids' diffusivity", True),
    "cooling": ("d ln(eta)/dT at mean pressure over at ambient", True),
    "warmth": ("beta T of the inlet", True),
    "conductivity": ("conductivity, oil over solids", True),
    "capacity": ("heat capacity by volume, oil over solids", True),
    "heat": ("beta eta0 u^2/k of the oil", True),
    "thickness": ("(h R_x)^(1/2)/a_x", True),
}
# groups that are constant in contacts of a kind
_CONSTANT = {
    FLANK: (),
    LINE: ("ellipse", "psi", "delta"),
    ROLLER: ("ellipse", "psi", "delta", "slide_roll"),
}


def limit_in_words(friction: Array, contacts: str) -> str:
    """Return in how many films the mean shear stress is above a limit.

    Parameters
    ----------
    friction : ndarray
        Coefficients of friction of the films: mean shear stress over mean pressure [-].
    contacts
        What the films are, "films that the axle visits".

    Notes
    -----
    In the middle of a contact the stress is above its mean, so a limit acts a little earlier.
    """
    shares = [f"{100.0 * np.mean(friction > limit):.0f}" for limit in LIMITS]
    limits = [f"{limit:g}" for limit in LIMITS]
    return (
        f"A limiting shear stress of {', '.join(limits[:-1])} or {limits[-1]} times the pressure "
        f"would cut {', '.join(shares[:-1])} or {shares[-1]} % of the {contacts}"
    )


def limits_of(table: SolveTable) -> list[str]:
    """Return the sentence for the films of a training set; none for rollers, which do not slide."""
    first = table.kind.visited, table.kind.nodes  # each contact once
    friction = np.array(
        [
            row.solved.friction
            for row in table.rows.values()
            if (row.task.kind, row.task.nodes) == first and not row.failure
        ]
    )
    if table.kind.name == ROLLER or friction.size == 0:
        return []
    return [f"{limit_in_words(friction, 'films that are visited')}; the model has no such limit."]


def model_lines(model: FilmModel) -> list[str]:
    """Return provenance, bounds, errors and domain, one line each."""
    lines = [f"checksum: {model.checksum}"]
    for key, value in model.provenance.items():
        if key != "box":
            lines.append(f"{key}: {_text(value)}")
    lines.append(
        f"bounds, 95 %: central film {100.0 * model.film_bound:.2f} %, friction "
        f"{100.0 * model.friction_bound:.2f} %"
    )
    lines.append("domain:")
    for group, (low, high) in model.domain.items():
        if group in _CONSTANT[model.kind]:
            continue
        words, logarithmic = _WORDS[group]
        if logarithmic:
            low, high = math.exp(low), math.exp(high)
        elif group in ("psi", "delta"):
            low, high = math.degrees(low), math.degrees(high)
        lines.append(f"  {words:45} {low:.4g} to {high:.4g}")
    if model.provenance.get("state") != "final":
        lines.append("This model is a trial. Do not use its results.")
    return lines


def _text(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{key} {_text(one)}" for key, one in value.items())
    if isinstance(value, list):
        return ", ".join(map(str, value))
    return str(value)
