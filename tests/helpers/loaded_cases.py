"""What tests of loaded tooth contact share: the shipped pair and teeth of known compliance."""

from __future__ import annotations

import numpy as np

from gearlube_core.tooth_compliance.flank_compliance import FlankCompliance
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from tests.helpers.contact_cases import shipped_file

MODULUS = 115.4e9  # Pa, steel on steel
FILE = shipped_file()


def teeth(softness: float) -> FlankCompliance:
    """Return a tooth that bends by about `softness` [m/N] at its tip, less far from the load."""
    s, t = np.linspace(0.0, 1.0, 7), np.linspace(0.0, 1.0, 13)
    height, place = (a.ravel() for a in np.meshgrid(0.1 + s, t, indexing="ij"))
    reach = np.exp(-0.5 * (2.5 * (place[:, None] - place)) ** 2)
    image = softness * np.outer(height, height) * reach
    return FlankCompliance(s=s, t=t, image=image, elastic=image)


def stiffness(softness: float = 1.2e-9) -> PairStiffness:
    return PairStiffness(pinion=teeth(softness), gear=teeth(softness), contact_modulus=MODULUS)
