"""What would make claims 28 and 30 of Karagiannis et al. 2012 hold: stress, roughness, reading."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from docs.resonance.contacts import COLD, HOT, Contacts, contacts
from docs.validation.decision import Decision, decision_table, table

SLOW = 0.3  # mesh over natural frequency
LARGEST = 0.4  # F_b over F_v, claim 28
_READINGS: tuple[tuple[str, float | None, dict[str, Any]], ...] = (
    ("as on this page, Eyring stress 2 MPa", None, {}),
    ("Eyring stress 1 MPa", 1e6, {}),
    ("Eyring stress 5 MPa", 5e6, {}),
    ("Eyring stress 7.5 MPa", 7.5e6, {}),
    ("Eyring stress 10 MPa", 1e7, {}),
    ("Eyring stress 20 MPa", 2e7, {}),
    ("roughness 0.25 um", None, {"roughness_rms": 0.25e-6}),
    ("mean pressure of a circle", None, {"contact_pressure": "circular"}),
    ("entrainment along sliding", None, {"entrainment": "along_sliding"}),
    ("film at inlet temperature", None, {"film_temperature": "inlet"}),
    (
        "consistent film at inlet temperature",
        None,
        {"film": "consistent", "film_temperature": "inlet"},
    ),
    ("surfaces heated by friction", None, {"flash_temperature": True}),
)


@dataclass(frozen=True, slots=True)
class HotAndCold:
    """The contacts at 100 and at 40 degC."""

    hot: Contacts
    cold: Contacts

    @property
    def boundary_share(self) -> float:
        """Largest boundary over largest viscous friction at 100 degC."""
        return _top(self.hot, "boundary_friction") / _top(self.hot, "viscous_friction")

    def over_cold(self, name: str) -> float:
        """Largest of a quantity at 100 degC over that at 40 degC."""
        return _top(self.hot, name) / _top(self.cold, name)

    @property
    def over_inlet(self) -> float:
        """The same of effective viscosity, each over the viscosity of its own inlet."""
        oil = self.hot.cycle.motion.problem.model.parameters.oil
        inlet = oil.dynamic_viscosity(HOT) / oil.dynamic_viscosity(COLD)
        return self.over_cold("effective_viscosity") / inlet


def both(stress: float | None, **options: Any) -> HotAndCold:
    """Return the contacts with an Eyring stress [Pa] and options of the pair."""
    return HotAndCold(*(contacts(SLOW, T, stress, **options) for T in (HOT, COLD)))


def crossing(share: Callable[[float], float], low: float, high: float) -> float:
    """Return where `share` crosses LARGEST between two values, to a hundredth, by bisection."""
    rises = share(high) > share(low)
    while high / low > 1.01:
        middle = (low * high) ** 0.5
        if (share(middle) > LARGEST) == rises:
            high = middle
        else:
            low = middle
    return (low * high) ** 0.5


def flank_section() -> str:
    """Return the table of readings, and the rows of claims 28 and 30."""
    rows, found = [], {}
    for words, stress, options in _READINGS:
        found[words] = pair = both(stress, **options)
        rows.append(
            [
                words,
                f"{100.0 * pair.boundary_share:.0f}",
                f"{pair.over_cold('effective_viscosity'):.3f}",
                f"{pair.over_inlet:.2f}",
                f"{pair.over_cold('shear_stress'):.2f}",
                f"{pair.over_cold('shear_rate'):.1f}",
                f"{100.0 * _top(pair.cold, 'rise_effective') / COLD:.1f}",
            ]
        )
    page = found[_READINGS[0][0]]
    stress = crossing(lambda tau0: _share(tau0), 2e6, 1e7)
    roughness = crossing(lambda sigma: _share(None, roughness_rms=sigma), 0.2e-6, 0.5e-6)
    decisions = [
        Decision(
            "28",
            "The Eyring stress, or the roughness",
            f"2 MPa and 0.5 um: {100.0 * page.boundary_share:.0f} %",
            f"{1e-6 * stress:.1f} MPa, or {1e6 * roughness:.2f} um: {100.0 * LARGEST:.0f} %",
            "For the stress: yes. It is not printed, and the curve of fig. 19a bends where one of "
            "5 MPa and more would bend (claim 20), though the film is then 5 % warmer (claim 18). "
            "For the roughness: no, because it is printed.",
        ),
        Decision(
            "30",
            "The number by which the viscosity is divided",
            f"Both by the same number: {page.over_cold('effective_viscosity'):.3f}",
            f"Each by the viscosity of its inlet: {page.over_inlet:.2f} (asked: 0.2 to 0.5)",
            "Open. Fig. 21a has no units, and the text says that it is divided as fig. 18. With "
            "one divisor no Eyring stress does it. Viscosity is stress over shear rate. The shear "
            "rate is set by the hot film, which is a fifth of the cold one (claim 26). So the "
            "stress would have to be higher in the hot film.",
        ),
    ]
    heads = ["Reading", "28: F_b/F_v, %", "30: viscosity, hot over cold", "each over its inlet"]
    heads += ["stress, hot over cold", "shear rate, hot over cold", "18: rise at 40 degC, %"]
    text = (Path(__file__).parent / "text" / "flanks.md").read_text(encoding="utf-8")
    return text.format(table=table(heads, rows), decisions=decision_table(decisions))


def _share(stress: float | None, **options: Any) -> float:
    hot = contacts(SLOW, HOT, stress, **options)
    return _top(hot, "boundary_friction") / _top(hot, "viscous_friction")


def _top(contact: Contacts, name: str) -> float:
    return float(contact.loaded(name).max())
