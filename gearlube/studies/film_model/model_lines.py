"""A film model in words."""

from __future__ import annotations

import math

from gearlube_core.film_model.model import FLANK, LINE, ROLLER, FilmModel

_WORDS = {
    "pressure": ("mean pressure over E*", True),
    "ellipse": ("a_y/a_x", True),
    "psi": ("entrainment from the minor axis [deg]", False),
    "slide_roll": ("sliding over entrainment", True),
    "delta": ("sliding from entrainment [deg]", False),
    "viscosity": ("viscosity over 63 uPa s", True),
    "exponent": ("Z of Roelands", True),
    "stress": ("Eyring stress over E*", True),
    "rate": ("kappa u/(E* R_x)", True),
    "peclet": ("u R_x over the solids' diffusivity", True),
    "cooling": ("S0 of Houpert", True),
    "warmth": ("E*/[rho c (T - 138 K)] of the solids", True),
    "conductivity": ("conductivity, oil over solids", True),
    "capacity": ("heat capacity by volume, oil over solids", True),
    "heat": ("beta eta0 u^2/k of the oil", True),
    "thickness": ("(h R_x)^(1/2)/a_x", False),
}
# groups that are constant in contacts of a kind
_CONSTANT = {
    FLANK: (),
    LINE: ("ellipse", "psi", "delta"),
    ROLLER: ("ellipse", "psi", "delta", "slide_roll"),
}


def model_lines(model: FilmModel) -> list[str]:
    """Return provenance, bounds, errors and domain, one line each."""
    lines = [f"checksum: {model.checksum}"]
    for key, value in model.provenance.items():
        if key != "box":
            lines.append(f"{key}: {_text(value)}")
    lines.append(
        f"bounds, 95 %: central film {100.0 * model.film_bound:.2f} %, friction "
        f"{100.0 * model.friction_bound:.2f} %{model.words_of_domain}"
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
