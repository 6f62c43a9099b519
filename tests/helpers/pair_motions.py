"""Motion of a helical pair as an array, whose places have names."""

from __future__ import annotations

import numpy as np

from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_model.outputs import STATE_NAMES
from gearlube_core.dynamics.helical_pair.march.flanks import PairMotion

PSI, W_P, W_G, PHI_P = (
    STATE_NAMES.index(name)
    for name in ("mesh.rotation", "pinion.speed", "wheel.speed", "pinion.angle")
)
U_P, TH_P, U_G, TH_G, V_P, OM_P, V_G, OM_G = (
    STATE_NAMES.index(f"{member}.{quantity}.x")
    for quantities in (("displacement", "tilt"), ("velocity", "tilt_speed"))
    for member in ("pinion", "wheel")
    for quantity in quantities
)
N_MOTION = len(STATE_NAMES)


def pair_motion(s: np.ndarray) -> PairMotion:
    """Motion in an array whose places are those of the continuous states."""
    return PairMotion(
        s[PSI], s[PHI_P], s[W_P], s[W_G],
        *s[U_P : U_P + 3], *s[TH_P : TH_P + 2], *s[U_G : U_G + 3], *s[TH_G : TH_G + 2],
        *s[V_P : V_P + 2], *s[OM_P : OM_P + 2], *s[V_G : V_G + 2], *s[OM_G : OM_G + 2],
    )  # fmt: skip


def motion_of(model: HelicalPairModel) -> PairMotion:
    """Present motion of a model."""
    return pair_motion(model.continuous)
