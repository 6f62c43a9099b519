"""Load and friction of one flank, summed over its contact lines: kernel."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.helical_pair.march.constants import MotionConstants
from gearlube_core.dynamics.helical_pair.march.mesh_data import STATIONS_AT
from gearlube_core.dynamics.helical_pair.march.state import POINTS_PER_LINE
from gearlube_core.dynamics.helical_pair.mesh.mesh_damping import built_up
from gearlube_core.helical_geometry.contact_line import clip_line, pitch_crossing
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.places import place_below

GAUSS = 0.21132486540518713  # (1 - 1/sqrt(3))/2: first of two points between 0 and 1
_HALF_APART = 0.28867513459481287  # 1/(2 sqrt(3)): of the two points
_PER_APART = 1.7320508075688772  # sqrt(3): reciprocal of their distance


class LineSums(NamedTuple):
    """Integrals along the contact lines of one flank; w is the load per length, normal to it."""

    N: float  # of w [N]
    Nx: float  # of w x [N.m]
    Nz: float  # of w z [N.m]
    F: float  # of mu w sgn(x - x_P) [N]
    Fx: float  # of mu w sgn(x - x_P) x [N.m]
    Fz: float  # of mu w sgn(x - x_P) z [N.m]
    energy: float  # of k (delta - e)^2/2 [J]
    moving: float  # d(energy)/dX at fixed deviations: the lines move [N]
    stiffness: float  # of k where flanks touch [N/m]
    whole: float  # of k, touching or not [N/m]
    built_up: float  # of k where flanks touch, as far as its damping is built up [N/m]


@kernel
def pair_slot(phase: float, line: int, lines: int) -> int:
    """Return the place of the tooth pair on line `line`; it keeps its place from entry to exit."""
    first = np.floor(phase)
    slot = place_below(first - lines * np.floor(first / lines), lines) - line
    return slot + lines if slot < 0 else slot


@kernel
def line_sums(
    a: float,
    tilt: float,
    phase: float,
    data: Array,
    mu: Array,
    mu_at: int,
) -> LineSums:
    """Return the sums over all lines of a flank.

    delta = a + tilt (z cos(b) + x sin(b));  w = max(k (delta - e), 0)

    Parameters
    ----------
    a
        Compression at x = z = 0 [m].
    tilt
        th_yp - th_yg [rad].
    phase
        Mesh phase [mesh periods].
    data : ndarray
        Pair data, see `mesh_data`; density and offset are linear between phases and stations.
    mu : ndarray
        From `mu_at` on the coefficients of friction of every tooth pair at the Gauss points before
        and after the pitch line; linear between.

    Returns
    -------
    LineSums

    Notes
    -----
    Within a piece between stations, the pitch line and the end of contact, all integrands are
    polynomials of at most third degree: two Gauss points are exact. `moving` keeps the energy
    balance: a spring that enters or leaves loaded takes or gives work, which the pinion feels as
    a torque -r_bp moving. It is about 1e-4 of the mesh torque and missing in He et al. 2007.
    """
    motion: MotionConstants = tuple_from_array(data, MotionConstants)
    p = motion.flanks
    plane = p.plane
    half = 0.5 * plane.W
    tan_b = plane.sin_b / plane.cos_b
    inverse = 1.0 / tan_b if tan_b > 0.0 else 0.0
    lines = int(p.lines)
    n_s = int(p.stations)
    n_phase = int(p.phases)
    at_density = STATIONS_AT + n_s
    to_offset = n_phase * lines * n_s
    fraction = phase - np.floor(phase)
    row = place_below(fraction * n_phase, n_phase)
    part = fraction * n_phase - row
    per_cos = 1.0 / plane.cos_b
    slope = tilt * per_cos
    slot = pair_slot(phase, 0, lines)
    N = Nx = Nz = F = Fx = Fz = energy = moving = stiffness = whole = built = 0.0
    for i in range(lines):
        X = plane.A + (fraction + i) * plane.pitch
        at_mu = mu_at + POINTS_PER_LINE * slot
        slot = slot - 1 if slot > 0 else lines - 1
        segment = clip_line(X, plane)
        z_low = segment.z_low
        z_high = segment.z_high
        span = z_high - z_low
        if span <= 0.0:
            continue
        z_pitch = pitch_crossing(X, segment, plane)
        rate_low = -inverse if z_low > -half else 0.0
        rate_high = -inverse if z_high < half else 0.0
        base = a + tilt * plane.sin_b * (X - half * tan_b)
        here = at_density + (row * lines + i) * n_s
        after = here + lines * n_s
        if row == n_phase - 1:  # the line is the next older one when the phase starts anew
            after = at_density + (i + 1) * n_s if i + 1 < lines else here
        N_line = Nz_line = F_line = Fz_line = energy_line = 0.0
        for c in range(n_s - 1):
            t_a = data[STATIONS_AT + c]
            t_size = data[STATIONS_AT + c + 1] - t_a
            z_a = z_low + t_a * span
            width = t_size * span
            k_a = data[here + c]
            k_b = data[here + c + 1]
            e_a = data[here + to_offset + c]
            e_b = data[here + to_offset + c + 1]
            dk_a = dk_b = de_a = de_b = 0.0
            if n_phase > 1:
                dk_a = data[after + c] - k_a
                dk_b = data[after + c + 1] - k_b
                de_a = data[after + to_offset + c] - e_a
                de_b = data[after + to_offset + c + 1] - e_b
                k_a += part * dk_a
                k_b += part * dk_b
                e_a += part * de_a
                e_b += part * de_b
            whole += 0.5 * (k_a + k_b) * width * per_cos
            g_a = base + slope * z_a - e_a
            g_b = base + slope * (z_a + width) - e_b
            if g_a <= 0.0 and g_b <= 0.0:
                continue
            # as fractions of the piece: where it touches and where the pitch line crosses it
            first = g_a / (g_a - g_b) if g_a < 0.0 else 0.0
            last = g_a / (g_a - g_b) if g_b < 0.0 else 1.0
            middle = last
            if z_pitch <= z_a:
                middle = first
            elif z_pitch < z_a + width:
                middle = min(max((z_pitch - z_a) / width, first), last)
            for side in range(2):
                start = first if side == 0 else middle
                end = middle if side == 0 else last
                size = end - start
                if size <= 0.0:
                    continue
                weight = 0.5 * size * width * per_cos
                centre = 0.5 * (start + end)
                t_1 = centre - _HALF_APART * size
                t_2 = centre + _HALF_APART * size
                z_1 = z_a + t_1 * width
                z_2 = z_a + t_2 * width
                k_1 = k_a + t_1 * (k_b - k_a)
                k_2 = k_a + t_2 * (k_b - k_a)
                g_1 = g_a + t_1 * (g_b - g_a)
                g_2 = g_a + t_2 * (g_b - g_a)
                touched_1 = weight * k_1
                touched_2 = weight * k_2
                stiffness += touched_1 + touched_2
                load_1 = touched_1 * g_1
                load_2 = touched_2 * g_2
                built += touched_1 * built_up(g_1, DAMPING_BUILD_UP)
                built += touched_2 * built_up(g_2, DAMPING_BUILD_UP)
                N_line += load_1 + load_2
                Nz_line += load_1 * z_1 + load_2 * z_2
                energy_line += load_1 * g_1 + load_2 * g_2
                if n_phase > 1:
                    per_X = n_phase / plane.pitch
                    moving -= load_1 * (de_a + t_1 * (de_b - de_a)) * per_X
                    moving -= load_2 * (de_a + t_2 * (de_b - de_a)) * per_X
                    stiffening = (dk_a + t_1 * (dk_b - dk_a)) * g_1 * g_1
                    stiffening += (dk_a + t_2 * (dk_b - dk_a)) * g_2 * g_2
                    moving += 0.5 * weight * stiffening * per_X
                mu_1 = mu[at_mu + 2 * side]
                mu_2 = mu[at_mu + 2 * side + 1]
                drag_1 = mu_1
                drag_2 = mu_2
                if mu_1 != mu_2:
                    side_low = z_low if side == 0 else z_pitch
                    side_span = z_pitch - z_low if side == 0 else z_high - z_pitch
                    gradient = (mu_2 - mu_1) * _PER_APART / side_span
                    ahead = side_low + GAUSS * side_span
                    drag_1 = max(mu_1 + gradient * (z_1 - ahead), 0.0)
                    drag_2 = max(mu_1 + gradient * (z_2 - ahead), 0.0)
                if side == 0:
                    drag_1 = -drag_1
                    drag_2 = -drag_2
                F_line += drag_1 * load_1 + drag_2 * load_2
                Fz_line += drag_1 * load_1 * z_1 + drag_2 * load_2 * z_2
        x_middle = X - half * tan_b
        N += N_line
        Nz += Nz_line
        Nx += x_middle * N_line + tan_b * Nz_line
        F += F_line
        Fz += Fz_line
        Fx += x_middle * F_line + tan_b * Fz_line
        energy += 0.5 * energy_line
        moving += (tilt * plane.sin_b + slope * rate_low) * N_line
        if rate_high != rate_low:
            growth = (rate_high - rate_low) / span
            moving += growth * (0.5 * energy_line + slope * (Nz_line - z_low * N_line))
    return LineSums(N, Nx, Nz, F, Fx, Fz, energy, moving, stiffness, whole, built)
