"""The Eyring stress and the roughness with which claim 28 of Karagiannis et al. 2012 would hold."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from docs.page import Page, border
from docs.resonance.contacts import HOT, Contacts, contacts
from docs.resonance.evidence import kept

SLOW = 0.3  # mesh over natural frequency
LARGEST = 0.4  # F_b over F_v, claim 28


def crossing(share: Callable[[float], float], low: float, high: float) -> float:
    """Return where `share` crosses LARGEST between two values, to a hundredth, by bisection."""
    rises = share(high) > share(low)
    within = math.log(1.01)
    return border(lambda one: (share(one) > LARGEST) == rises, high, low, within, ratio=True)


def flank_decisions(page: Page, work: Path) -> None:
    """Put in the Eyring stress and the roughness that claim 28 needs."""
    stress, roughness = kept(work, "readings", readings)
    page.fill("needs tau0 {} MPa, or {} um instead of", f"{1e-6 * stress:.1f}",
              f"{1e6 * roughness:.2f}")  # fmt: skip


def readings() -> tuple[float, float]:
    """Return the Eyring stress [Pa] and the roughness [m] with which claim 28 holds."""
    stress = crossing(_share, 2e6, 1e7)
    return stress, crossing(lambda sigma: _share(None, roughness_rms=sigma), 0.2e-6, 0.5e-6)


def _share(stress: float | None, **options: Any) -> float:
    hot = contacts(SLOW, HOT, stress, **options)
    return _top(hot, "boundary_friction") / _top(hot, "viscous_friction")


def _top(contact: Contacts, name: str) -> float:
    return float(contact.loaded(name).max())
