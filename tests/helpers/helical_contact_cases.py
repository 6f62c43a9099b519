"""What tests of loaded helical contact share: pairs, a coarse tooth body, and stiff teeth."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import xarray as xr

from gearlube_core.helical_contact.contact_dataset import HelicalContact
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings, pair_stiffness
from gearlube_core.helical_geometry.modification import FlankModification, ModifiedPair, TipRelief
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.mesh_table.line_mesh import LineMesh
from gearlube_core.tooth_compliance.flank_compliance import CondensationSettings, FlankCompliance
from gearlube_core.tooth_compliance.tooth_mesh import MeshDensity
from gearlube_core.tooth_contact.coupled_strips import PairStiffness
from tests.helpers.named_pairs import named_pair
from tests.helpers.session_folder import shared_folder

HE_2007 = named_pair("he_2007")
TORQUE = 225.97  # N.m, 2000 lb in of He et al. 2007

# the whole mesh comes out 1.0 to 1.8 % stiffer than with the default body, in a tenth of its time
COARSE_BODY = HelicalBodySettings(
    condensation=CondensationSettings(
        profile_hats=4,
        lengthwise_hats=7,
        density=MeshDensity(
            profile=6, lengthwise=12, thickness=3, growth=1.8, fillet=3, slot=1, rim=2
        ),
    )
)
# straight teeth on He's blanks; transverse contact ratio 1.49
SPUR = replace(
    HE_2007,
    name="spur",
    helix_angle=0.0,
    normal_module=25.4e-3 / 8.0,
    normal_pressure_angle=math.radians(25.0),
)
# equal members, so that the mesh is the same from either end
EQUAL = replace(
    HE_2007,
    name="equal",
    gear_teeth=25,
    centre_distance=3.125 * 25.4e-3,
    gear_tip_radius=HE_2007.pinion_tip_radius,
    gear_root_radius=HE_2007.pinion_root_radius,
)


def even_contact(mesh: LineMesh) -> HelicalContact:
    """Return the contact of a mesh with one stiffness along all lines, whose edges do not press."""
    pressure = np.zeros((1, 1, mesh.lines + 2))
    return HelicalContact(
        xr.Dataset({"pressure_max": (("phase", "torque", "line"), pressure)}), mesh
    )


TEETH_CACHE = shared_folder("teeth")


@cache
def coarse_stiffness(pair: HelicalPair) -> PairStiffness:
    """Return finite-element teeth, solved once in a session."""
    return pair_stiffness(pair, COARSE_BODY, cache=TEETH_CACHE, jobs=1)


def stiff_teeth(modulus: float) -> PairStiffness:
    """Return teeth that neither bend nor end: only their surfaces give way."""
    flat = np.zeros((4, 4))
    ends = np.array([0.0, 1.0])
    flank = FlankCompliance(s=ends, t=ends, image=flat, elastic=flat)
    return PairStiffness(pinion=flank, gear=flank, contact_modulus=modulus)


def relieved(pair: HelicalPair, amount: float, extent: float) -> ModifiedPair:
    """Return linear tip relief on both members."""
    flank = FlankModification(tip_relief=TipRelief(amount=amount, extent=extent, k=0.0))
    return ModifiedPair(pair=pair, pinion=flank, gear=flank)
