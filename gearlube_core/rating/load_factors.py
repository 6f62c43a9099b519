"""Load factors of ISO 6336-1 that cylindrical and bevel gears share; N, mm, um, kg."""

from __future__ import annotations

import math

from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.rating.gears import Gears, RatedGear
from gearlube_core.rating.pairs import MPA, UM, Pair

_CONTACT_CHECKS = {
    "full_load": (1.0, 1.0, 1.0), "light_load": (1.05, 1.10, 1.25), "none": (1.20, 1.32, 1.50),
}  # fmt: skip


def effective_deviations(gears: Gears) -> tuple[float, float, float]:
    """Return what counts of the worse pitch and profile, and of both for K_H alpha, run in [um].

    For K_H alpha the larger of both deviations counts, less what runs in of the pitch.
    """

    def run_in(deviation: float, gear: RatedGear) -> float:
        if gear.treatment == "through_hardened":
            return deviation * (1.0 - min(160.0 / (MPA * gear.contact_limit), 1.0))
        return deviation - min(0.075 * deviation, 3.0)

    pitch = max(gears, key=lambda one: one.pitch_deviation)
    profile = max(gears, key=lambda one: one.profile_deviation)
    f_p, f_f = UM * pitch.pitch_deviation, UM * profile.profile_deviation
    left = run_in(f_p, pitch)
    return left, run_in(f_f, profile), max(f_p, f_f) - (f_p - left)


def resonance(teeth: float, masses: Pair, stiffness: float, speed: float) -> Pair:
    """Return n_E1 of a pinion [1/min], and N, its speed [rad/s] over that of resonance [-].

    Masses are those per face width, reduced to the line of action [kg/mm], and the stiffness is
    c_gamma alpha [N/(mm um)].
    """
    n_E1 = 3e4 / (math.pi * teeth) * math.sqrt(stiffness * (1.0 / masses[0] + 1.0 / masses[1]))
    return n_E1, speed * 30.0 / math.pi / n_E1


def dynamic_factor(
    N: float, contact_ratio: float, shares: tuple[float, float, float], main: Pair
) -> float:
    """Return K_v of method B [-] at a speed N over that of resonance; [iso_6336_1], [iso_10300_1].

    `contact_ratio` is epsilon_gamma, `shares` are B_p, B_f, B_k of pitch and profile deviation and
    tip relief. The range of the main resonance begins and ends at `main`; above it K_v falls
    until N is 1.5.
    """
    (B_p, B_f, B_k), e = shares, contact_ratio
    C_2, C_3, C_4, C_6 = 0.34, 0.23, 0.90, 0.47
    if e > 2.0:
        C_2, C_3 = 0.57 / (e - 0.3), 0.096 / (e - 1.56)
        C_4, C_6 = (0.57 - 0.05 * e) / (e - 1.44), 0.12 / (e - 1.74)
    C_7 = 1.0 if e > 2.5 else 0.125 * math.sin(math.pi * (e - 2.0)) + 0.875 if e > 1.5 else 0.75
    deviations = 0.32 * B_p + C_2 * B_f
    if main[0] >= N:
        return 1.0 + N * (deviations + C_3 * B_k)
    resonant = 1.0 + deviations + C_4 * B_k
    if main[1] >= N:
        return resonant
    above = 0.47 * B_p + C_6 * B_f + C_7
    return above + max(1.5 - N, 0.0) / (1.5 - main[1]) * (resonant - above)


def transverse_factor(contact_ratio: float, X: float) -> float:
    """Return K_H alpha [-] before its bounds; X is stiffness times deviation over line load."""
    e = contact_ratio
    few = 0.5 * e * (0.9 + 0.4 * X)
    return few if e <= 2.0 else 0.9 + 0.4 * math.sqrt(2.0 * (e - 1.0) / e) * X


def face_load_factor(
    line_load: float, face_width: float, pinion_diameter: float, stiffness: float, *,
    misalignment: float, bending: float = 0.0, correction: Pair = (1.0, 1.0),
    contact_limit: float | None = None,
) -> float:  # fmt: skip
    """Return K_H beta of a pinion between bearings, method C [-]; a solved one is better.

    f_sh = (F_m/b) 0.023 (|1 + K' l s/d^2 (d/d_sh)^4 - 0.3| + 0.3) (b/d)^2
    F_bx = 1.33 B1 f_sh + B2 f_ma,  F_by = F_bx - y_b
    K_Hb = 1 + F_by c b/(2 F_m), above 2: (2 F_by c b/F_m)^(1/2)

    Parameters
    ----------
    line_load, face_width, pinion_diameter
        F_m/b = F_t K_A K_gamma K_v/b [N/m], b [m], d [m].
    stiffness, misalignment
        c_gamma beta [N/m2], see `iso_stiffness`; f_ma, by manufacture [m].
    bending, correction
        K' l s/d^2 (d/d_sh)^4 of the pinion's place between its bearings [-], with its sign; B1, B2
        of helix modifications [-].
    contact_limit
        sigma_H lim of a through-hardened pair [Pa]; None: hard flanks, of which 15 % run in, at
        most 6 um.

    Examples
    --------
    >>> round(face_load_factor(5e5, 0.1, 0.15, 15e9, misalignment=10e-6), 2)  # [iso_6336_1]
    1.21
    """
    check_positive("line_load", line_load, "N/m", "Give that of the loaded pair.")
    check_within("misalignment", misalignment, 0.0, 2e-3, "m", "10 um is 1e-5 m.")
    w, c = 1e-3 * line_load, 1e-9 * stiffness
    bend = (abs(0.7 + bending) + 0.3) * (face_width / pinion_diameter) ** 2
    wide = abs(1.33 * correction[0] * 0.023 * w * bend + correction[1] * UM * misalignment)
    left = wide - min(0.15 * wide, 6.0)
    if contact_limit is not None:
        left = wide * (1.0 - min(320.0 / (MPA * contact_limit), 1.0))
    K = 1.0 + 0.5 * left * c / w
    return K if K <= 2.0 else math.sqrt(2.0 * left * c / w)


def bevel_face_factor(contact_check: str, cantilevers: int) -> float:
    """Return K_H beta of bevel gears from how they are mounted [-]; a solved one is better.

    The contact pattern was checked at "full_load", "light_load" or "none", and 0, 1 or 2 members
    are mounted overhung: `cantilevers`.

    >>> round(bevel_face_factor("light_load", 1), 2)  # [iso_10300_1]
    1.65
    """
    check_option("contact_check", contact_check, _CONTACT_CHECKS)
    check_within("cantilevers", cantilevers, 0, 2, "", "Count the overhung members.")
    return 1.5 * _CONTACT_CHECKS[contact_check][int(cantilevers)]
