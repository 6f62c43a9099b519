"""Damping of the mesh against the relative rotation along the line of action: kernels.

One law for every motion of the pair:

    F = 2 zeta sqrt(m_e k_m) s d(psi)/dt

k_m is the stiffness along the line of action of all contact lines, loaded or not, s the share of it
that touches, each point's part built up over its first penetration. With all lines in contact, as
in linear motions, s is one. F turns the members against each other with moments r_bp F and r_bg F,
in place of [he_2007 (36)] and [he_2007 (37)], which are not each other's reaction.
"""

from __future__ import annotations

import math

from gearlube_core.kernels.jit import kernel


@kernel
def damping_factor(ratio: float, effective_mass: float, cos_b: float) -> float:
    """Return 2 zeta sqrt(m_e) cos(b), the damping constant over sqrt(stiffness) [sqrt(kg)].

    Parameters
    ----------
    ratio
        zeta [-].
    effective_mass
        m_e [kg].
    cos_b
        Of the base helix angle [-]; k_m is cos(b)^2 times the lines' stiffness.
    """
    return 2.0 * ratio * math.sqrt(effective_mass) * cos_b


@kernel
def damping_constant(factor: float, stiffness: float) -> float:
    """Return the damping constant of the whole mesh [N s/m].

    Parameters
    ----------
    factor
        See `damping_factor`.
    stiffness
        Of all lines, normal to the flanks [N/m]; none below zero.
    """
    return factor * math.sqrt(max(0.0, stiffness))


@kernel
def built_up(depth: float, build_up: float) -> float:
    """Return the share of a point's damping [-] at a penetration; both in [m]."""
    return min(1.0, depth / build_up)


@kernel
def flank_damping(constant: float, share: float, closing: float, elastic: float) -> float:
    """Return the damping force of one flank along the line of action [N], positive while it closes.

    Parameters
    ----------
    constant
        See `damping_constant`.
    share
        Of the mesh's stiffness that touches on this flank, built up [-].
    closing
        Rate at which its teeth approach along the line of action [m/s].
    elastic
        Elastic force along it, not negative [N]: the damper takes at most all of it away, flanks do
        not adhere.
    """
    return max(constant * share * closing, -elastic)
