"""Interface of a shear law: the shear rate over that of a Newtonian oil.

    du/dz = (tau0/eta) t G(|t|^2),  t = tau/tau0

A law is a NamedTuple of floats with the field `tau0`, its unit of stress [Pa], and the kernel
`rate_ratio`. A law with closed forms for a film may bring `flow_factor`, `mid_stress` and
`layered_stress` as well (`shear_factors`); without them a quadrature serves.
"""

from __future__ import annotations

from typing import Any

from gearlube_core.kernels.by_class import by_class


@by_class()
def rate_ratio(law: Any, q: float) -> tuple[float, float]:
    """Return G and dG/dq.

    Parameters
    ----------
    law
        Shear law.
    q
        Square of the amount of the stress over tau0 [-].

    Returns
    -------
    tuple of float
        G [-], one at q = 0 and never falling with q; dG/dq [-], finite at q = 0.
    """
    raise NotImplementedError  # never run: it is the declaration of the kernels of that name
