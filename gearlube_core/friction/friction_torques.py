"""Torques and lost power of the friction of one flank on both members."""

from __future__ import annotations

from gearlube_core.kernels.jit import kernel


@kernel
def flank_speeds(w_p: float, w_g: float, arm_p: float, arm_g: float) -> tuple[float, float]:
    """Return mean surface speed along sliding and sliding speed of the pinion over the gear.

    u = (w_p r_p + w_g r_g)/2,  dU = w_p r_p - w_g r_g

    Parameters
    ----------
    w_p, w_g
        Speeds of pinion and gear [rad/s].
    arm_p, arm_g
        Friction arms r_fr,p and r_fr,g along the sliding direction [m].

    Returns
    -------
    tuple of float
        u and dU [m/s].

    Notes
    -----
    u leaves out what both surfaces have in common across sliding; the mean vector is the
    entrainment arm of a mesh table times w_p. In (19) dU has the opposite sign.
    Source: [karagiannis_2012 (7)] [karagiannis_2012 (12)] [karagiannis_2012 (19)]
    """
    u_p, u_g = w_p * arm_p, w_g * arm_g
    return 0.5 * (u_p + u_g), u_p - u_g


@kernel
def friction_torques(
    friction: float, sliding_speed: float, arm_p: float, arm_g: float
) -> tuple[float, float, float]:
    """Return the friction torques on pinion and gear, and the power lost to friction.

    Q_p = -s f r_p,  Q_g = s f r_g,  s = sign(dU),  P = f |dU|

    Parameters
    ----------
    friction
        Magnitude f [N].
    sliding_speed
        dU of `flank_speeds` [m/s].
    arm_p, arm_g
        Friction arms [m].

    Returns
    -------
    tuple of float
        Q_p and Q_g, positive in the direction of rotation of each member [N.m], and P [W];
        Q_p w_p + Q_g w_g = -P.

    Notes
    -----
    A single flank may drive the pinion (arm of opposite sign to dU).
    (25) prints vector products; the power is that of each flank's sliding.
    Source: [karagiannis_2012 (5)] [karagiannis_2012 (6)] [karagiannis_2012 (25)]
    """
    signed = -friction if sliding_speed < 0.0 else friction
    return -signed * arm_p, signed * arm_g, signed * sliding_speed
