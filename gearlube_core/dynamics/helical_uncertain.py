"""How uncertain the losses of a helical pair are: data and laws that are known to a factor."""

from __future__ import annotations

from dataclasses import replace

from gearlube_core.dynamics.hypoid_axle.uncertain import UNCERTAIN as OF_AXLE
from gearlube_core.dynamics.hypoid_axle.uncertain import Uncertain
from gearlube_core.friction.flank_laws import AranaShare
from gearlube_core.number import numbers_of
from gearlube_core.oil.lubricant import Lubricant

_OF_AXLE = {one.name: one for one in OF_AXLE}
UNCERTAIN = (
    *(_OF_AXLE[name] for name in ("viscosity", "eyring_stress", "alpha", "roughness")),
    Uncertain(
        "sliding", "law of sliding", 1.2, "laws of traction among each other; assumed", None,
        ("friction",),
    ),
    Uncertain("rolling", "law of rolling", 2.0, "flooded or starved inlet"),
    _OF_AXLE["high_pressure"],
)  # fmt: skip


def uncertain_of(oil: Lubricant, asperities: AranaShare | None = None) -> tuple[Uncertain, ...]:
    """Return the uncertain data, with the factors that oil and law of asperities have of their own.

    Examples
    --------
    >>> {one.name: one.factor for one in uncertain_of(Lubricant.named("fva_3"))}["sliding"]
    1.2
    """
    own = {
        "alpha": oil.alpha_factor,
        "eyring_stress": oil.eyring_stress_factor,
        "high_pressure": oil.high_pressure_factor,
    }
    law = numbers_of(AranaShare).items() if asperities else ()
    return tuple(
        one if (factor := own.get(one.name)) is None else replace(one, factor=factor, why=oil.name)
        for one in UNCERTAIN
        if one.name != "high_pressure" or oil.pressure_factor() is not None
    ) + tuple(Uncertain(name, one.text, one.factor, one.source) for name, one in law)
