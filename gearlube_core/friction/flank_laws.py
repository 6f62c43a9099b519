"""The laws of flank friction by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import SurfaceParameters
from gearlube_core.contact.solid import SolidParameters
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import (
    AS_PRINTED,
    CONSISTENT,
    PRINTED_TRACTION,
    ZHOU_HOEPRICH_SHARE,
    ContactGeometry,
    FlankState,
)
from gearlube_core.friction.flank_law import FlankLawMaker
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.lubricant_state import LubricantState


class MixedFlankFriction(NamedTuple):
    """Mixed friction of Mohammadpour et al. 2015; see `flank.flank_friction`."""

    surface: SurfaceParameters
    solid: SolidParameters
    form: float  # CONSISTENT, AS_PRINTED, PRINTED_TRACTION or ZHOU_HOEPRICH_SHARE [-]

    @kernel
    def flank_state(
        self,
        load: float,
        entrainment_speed: float,
        sliding_speed: float,
        geometry: ContactGeometry,
        oil: LubricantState,
    ) -> FlankState:
        """Return film, friction and temperature of one flank."""
        return flank_friction(
            load,
            entrainment_speed,
            sliding_speed,
            geometry,
            oil,
            self.surface,
            self.solid,
            int(self.form),
        )


def consistent(surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
    """Return the law with the corrected misprints of the paper."""
    return MixedFlankFriction(surface, solid, float(CONSISTENT))


def as_printed(surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
    """Return the law as printed in the paper."""
    return MixedFlankFriction(surface, solid, float(AS_PRINTED))


def printed_traction(surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
    """Return the law with the traction coefficient as printed in (13), all else consistent."""
    return MixedFlankFriction(surface, solid, float(PRINTED_TRACTION))


def zhou_hoeprich_share(surface: SurfaceParameters, solid: SolidParameters) -> MixedFlankFriction:
    """Return the law with asperities that carry exp(-B Lambda^C) of the load, all else consistent.

    Source: [zhou_hoeprich_1991 (45)]
    """
    return MixedFlankFriction(surface, solid, float(ZHOU_HOEPRICH_SHARE))


FLANK_LAWS: Mapping[str, FlankLawMaker] = {
    "consistent": consistent,
    "as_printed": as_printed,
    "printed_traction_circular": printed_traction,
    "zhou_hoeprich_1991": zhou_hoeprich_share,
}

# the mean pressure that a law is given, by the law's name; "elliptical" for all others
CONTACT_PRESSURES: Mapping[str, str] = {"printed_traction_circular": "circular"}
