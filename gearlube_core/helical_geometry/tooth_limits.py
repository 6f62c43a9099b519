"""Limits of gear teeth, as plain numbers: tip clearance, tip thickness, undercut.

Pairs on parallel axes are checked in their transverse section, bevel and hypoid blanks as the spur
gears that their normal section suggests.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from scipy.optimize import brentq

from gearlube_core.errors import ParameterError
from gearlube_core.units import MILLIMETRE

THIN_TIP = 0.2  # normal modules; thinner ones are reported
SMALL_CLEARANCE = 0.1  # normal modules; smaller ones are reported
USUAL_FILLET = 0.25  # of the basic rack in normal modules, type C of [iso_53]
_ROUNDING = 1e-9


class RackTool(NamedTuple):
    """The hob that generates a gear, as a rack.

    Parameters
    ----------
    radius : float
        Of the gear's reference circle, r [m].
    pressure_angle, helix_angle : float
        alpha_n, beta [rad].
    depth : float
        Of the tool's tip line below the reference circle [m]: r - r_f.
    fillet : float
        Radius of the tool's corner in the normal section [m].
    """

    radius: float
    pressure_angle: float
    helix_angle: float
    depth: float
    fillet: float


class InvoluteStart(NamedTuple):
    """Where the involute of a generated tooth begins.

    Parameters
    ----------
    roll : float
        Roll length [m].
    undercut : bool
        Whether the tool's corner has cut away a part of the involute.
    """

    roll: float
    undercut: bool


def involute(angle: float) -> float:
    """Return inv(angle) = tan(angle) - angle [rad]."""
    return math.tan(angle) - angle


def profile_shift_sum(teeth: int, normal: float, transverse: float, working: float) -> float:
    """Return x1 + x2 without backlash [-], from both tooth numbers together; [iso_21771].

    x1 + x2 = (z1 + z2)(inv(alpha_wt) - inv(alpha_t))/(2 tan(alpha_n)); pressure angles [rad].
    """
    return 0.5 * teeth * (involute(working) - involute(transverse)) / math.tan(normal)


def largest_fillet(module: float, pressure_angle: float, dedendum: float) -> float:
    """Return the radius of a tool tip without a flat [m], by rack sizes of the normal section [m].

    (pi m/4 - h tan(alpha)) cos(alpha)/(1 - sin(alpha)); zero where its flanks meet before.
    """
    half = 0.25 * math.pi * module - dedendum * math.tan(pressure_angle)
    return max(half, 0.0) * math.cos(pressure_angle) / (1.0 - math.sin(pressure_angle))


def undercut_depth(radius: float, pressure_angle: float, depth: float) -> float:
    """Return how far a straight-sided tool reaches below the limit of undercut [m]; negative: not.

    depth - r sin2(alpha), with r of the pitch circle.
    """
    return depth - radius * math.sin(pressure_angle) ** 2


def involute_start(tool: RackTool) -> InvoluteStart:
    """Return where the involute begins above the fillet that a hob without protuberance leaves.

    The straight flank of the tool ends rho (1 - sin(alpha_n)) above its tip line. Where its end
    meets the line of action above the base circle, the involute begins there. Else the corner's
    path cuts it: point theta of the corner, at depth d and u beside the flank, cuts where its
    normal passes the pitch point,

    w = d cos(theta) cos(beta)/sin(theta),  R = hypot(r - d, w),
    atan(w/(r - d)) - (u + w)/r = inv(acos(r_b/R)) - inv(alpha_t)

    References
    ----------
    [iso_21771] (root form circle); [litvin_fuentes_2004 ch. 6.3] (undercut).
    """
    radius, pressure_angle, fillet = tool.radius, tool.pressure_angle, tool.fillet
    cos_beta, centre = math.cos(tool.helix_angle), tool.depth - fillet
    alpha = math.atan(math.tan(pressure_angle) / cos_beta)
    base = radius * math.cos(alpha)
    end = centre + fillet * math.sin(pressure_angle)
    below = undercut_depth(radius, alpha, end)
    if below <= _ROUNDING * radius:
        return InvoluteStart(max(-below, 0.0) / math.sin(alpha), False)

    def place(theta: float) -> tuple[float, float]:
        """Return R [m] and the angle by which the path lies inside the tooth [rad]."""
        d = centre + fillet * math.sin(theta)
        beside = centre * math.tan(pressure_angle) + fillet / math.cos(pressure_angle)
        u = (beside - fillet * math.cos(theta)) / cos_beta
        w = d * math.cos(theta) * cos_beta / math.sin(theta)
        cut = math.hypot(radius - d, w)
        on_involute = involute(math.acos(min(base / cut, 1.0))) - involute(alpha)
        return cut, math.atan2(w, radius - d) - (u + w) / radius - on_involute

    # the path leaves the base circle outwards and crosses the involute before the flank's end
    outer = brentq(lambda theta: place(theta)[0] - base, pressure_angle, 0.5 * math.pi)
    crossed = brentq(lambda theta: place(theta)[1], pressure_angle, outer)
    cut = place(crossed)[0]
    return InvoluteStart(math.sqrt(max(cut**2 - base**2, 0.0)), True)


def tip_thickness(
    radius: float, thickness: float, tip_radius: float, pressure_angle: float
) -> float:
    """Return the arc at the tip of an involute tooth [m], zero or less where it is pointed.

    r_a (s/r + 2 (inv(alpha) - inv(alpha_a))),  cos(alpha_a) = r cos(alpha)/r_a

    Parameters
    ----------
    radius, thickness : float
        Of a circle and the tooth's arc on it [m].
    tip_radius : float
        [m]
    pressure_angle : float
        On that circle [rad].
    """
    at_tip = math.acos(radius * math.cos(pressure_angle) / tip_radius)
    return tip_radius * (thickness / radius + 2.0 * (involute(pressure_angle) - involute(at_tip)))


def check_tip(role: str, thickness: float, module: float, cure: str) -> list[str]:
    """Return a remark where a member's tip is thin; raise ParameterError where it is pointed."""
    if thickness <= 0.0:
        raise ParameterError(
            f"The {role}'s teeth are pointed: they must have a topland above 0 mm, got "
            f"{thickness / MILLIMETRE:.2f} mm, so the flanks meet below the tip. {cure}"
        )
    if thickness < THIN_TIP * module:
        return [
            f"The {role}'s topland is thin, about {thickness / MILLIMETRE:.2f} mm, below "
            f"{THIN_TIP:g} normal modules."
        ]
    return []


def check_clearance(role: str, clearance: float, module: float, cure: str) -> list[str]:
    """Return a remark where tips come near the roots of a member; raise where they cut into it."""
    what = f"The clearance of the mate's tips over the {role}'s roots"
    if clearance < -_ROUNDING * module:
        raise ParameterError(
            f"{what} must be at least 0 mm, got {clearance / MILLIMETRE:.3f} mm. {cure}"
        )
    if clearance < SMALL_CLEARANCE * module:
        return [
            f"{what} is {clearance / MILLIMETRE:.3f} mm, below {SMALL_CLEARANCE:g} normal modules "
            f"({SMALL_CLEARANCE * module / MILLIMETRE:.2f} mm); 0.25 is usual."
        ]
    return []


def check_reach(role: str, base: float, reached: float, tool: RackTool, module: float) -> list[str]:
    """Return a remark where a member is undercut, or the mate's tips come near its fillets.

    Parameters
    ----------
    role : str
        Name of the member.
    base, reached : float
        Its base radius, and the roll length to which the mate's tips reach down [m].
    tool : RackTool
        That cuts the member.
    module : float
        Normal module [m].

    Raises
    ------
    ParameterError
        The mate's tips run into fillets that even a tool with sharp corners leaves.
    """
    start = involute_start(tool)
    begins, reach = (
        f"{2.0 * math.hypot(base, max(roll, 0.0)) / MILLIMETRE:.2f} mm"
        for roll in (start.roll, reached)
    )
    hob = f"a hob with a corner radius of {tool.fillet / module:.3g} normal modules"
    if start.undercut:
        lost = "and contact below is lost" if reached < start.roll else "so no contact is lost"
        return [
            f"The {role} is undercut by {hob}: its involute begins at a diameter of {begins}. The "
            f"mate's tips reach down to {reach}, {lost}."
        ]
    if reached >= start.roll:
        return []
    sharp = involute_start(tool._replace(fillet=0.0))
    cure = f"Reduce the mate's tip diameter or the {role}'s root diameter."
    if not sharp.undercut and reached < sharp.roll:
        raise ParameterError(
            f"The mate's tips must stay above the fillets of the {role}, at a diameter of at least "
            f"{2.0 * math.hypot(base, sharp.roll) / MILLIMETRE:.2f} mm, got {reach}: the teeth "
            f"interfere. {cure}"
        )
    return [
        f"The mate's tips reach down to a diameter of {reach} on the {role}; the involute that "
        f"{hob} leaves begins at {begins}, above its fillet. {cure}"
    ]
