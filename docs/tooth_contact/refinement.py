"""What the numbers of cells, elements and hats, and the size of the elastic body, do."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.strips import StripSettings
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity

POSITIONS = 6
TORQUES = (50.0, 200.0)
_HALF_AGAIN = MeshDensity(
    profile=18, lengthwise=36, thickness=6, growth=1.6 ** (2.0 / 3.0), fillet=8, slot=2, rim=5
)


@dataclass(frozen=True, slots=True)
class Refinement:
    """An analysis of the shipped pair with other numerical settings, and why."""

    name: str
    label: str
    settings: ContactSettings


def _settings(
    body: ToothBodySettings | None = None, loaded: LoadedSettings | None = None
) -> ContactSettings:
    cycle = CycleSettings(positions=POSITIONS, torques=TORQUES, loaded=loaded or LoadedSettings())
    return ContactSettings(cycle=cycle, body=body or ToothBodySettings())


def refinements() -> list[Refinement]:
    """Return the default first, then numerical refinements, then other sizes of the body."""
    fine_hats = CondensationSettings(profile_hats=10, lengthwise_hats=19, density=_HALF_AGAIN)
    return [
        Refinement(
            "default",
            "default: 32 x 48 cells, 7 x 13 hats, base 3 modules, 1 pitch of rim",
            _settings(),
        ),
        Refinement(
            "cells",
            "64 x 96 cells",
            _settings(loaded=LoadedSettings(strips=StripSettings(cells_across=64, cells_along=96))),
        ),
        Refinement(
            "elements",
            "elements finer by half in each direction",
            _settings(ToothBodySettings(condensation=CondensationSettings(density=_HALF_AGAIN))),
        ),
        Refinement(
            "hats",
            "the same elements with 10 x 19 hats",
            _settings(ToothBodySettings(condensation=fine_hats)),
        ),
        *(
            Refinement(
                f"base_{depth:g}",
                f"base {depth:g} modules deep",
                _settings(ToothBodySettings(base_depth_modules=depth)),
            )
            for depth in (2.0, 4.0)
        ),
        *(
            Refinement(
                f"rim_{rim:g}",
                f"{rim:g} pitches of rim beside the tooth",
                _settings(ToothBodySettings(neighbour_pitches=rim)),
            )
            for rim in (0.5, 1.5)
        ),
    ]
