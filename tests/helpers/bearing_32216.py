"""The measured bearing 32216 and its eleven torques, Wingertszahn et al. 2023."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from gearlube_core.bearings.losses.geometry import BearingGeometry, Rib
from gearlube_core.bearings.losses.loss import BearingLoss, LossModel, bearing_loss
from gearlube_core.oil.lubricant import Lubricant

DEG = math.pi / 180.0
RPM = math.pi / 30.0
F_A = 6000.0  # N

BEARING = BearingGeometry(
    bore_diameter=80e-3,
    outside_diameter=140e-3,
    pitch_diameter=108.5e-3,
    roller_diameter=17e-3,
    roller_length=22.7e-3,
    n_rollers=16,
    outer_angle=15.64 * DEG,
    inner_angle=11.44 * DEG,
    rib=Rib(contact_height=2.5e-3),
    series="322",
)
# temperature of the outer ring [degC], radial load [N]: speed [rpm] to torque [N m]
MEASURED = {
    (50.0, 0.0): {500: 1.30, 2000: 2.95, 4000: 3.75},
    (50.0, 6500.0): {500: 1.50, 1000: 1.95, 2000: 2.50, 4000: 3.25},
    (42.0, 6500.0): {500: 2.00, 1000: 2.65, 2000: 3.50, 4000: 4.45},
}


def loss_at(
    rpm: float,
    *,
    temperature_degc: float = 50.0,
    radial_load: float = 0.0,
    axial_load: float = F_A,
    changes: dict[str, Any] | None = None,
    **model: Any,
) -> BearingLoss:
    """Return the loss of the bearing, with fields of its geometry changed; by Zhou and Hoeprich."""
    return bearing_loss(
        replace(BEARING, **(changes or {})),
        Lubricant.named("fva_3"),
        LossModel(**({"law": "zhou_hoeprich"} | model)),
        speed=rpm * RPM,
        axial_load=axial_load,
        radial_load=radial_load,
        temperature=temperature_degc + 273.15,
    )
