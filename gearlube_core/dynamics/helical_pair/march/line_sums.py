"""Load and friction of one flank, summed over its contact lines: kernel."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.dynamics.flank_force import DAMPING_BUILD_UP
from gearlube_core.dynamics.helical_pair.march.flanks import POINTS_PER_LINE, FlankConstants
from gearlube_core.dynamics.helical_pair.march.line_moments import (
    LINEAR,
    built_up_stations,
    cell_ends,
    energy_and_growth,
    fill_moments,
    load_moment,
    moment,
)
from gearlube_core.dynamics.helical_pair.march.mesh_data import (
    LEVEL,
    LINE_HEAD,
    N_MOMENTS,
    STATIONS_AT,
    density_at,
)
from gearlube_core.helical_geometry.contact_line import clip_line, pitch_crossing
from gearlube_core.kernels.flat_tuples import tuple_from_array
from gearlube_core.kernels.jit import kernel
from gearlube_core.kernels.places import place_below

GAUSS = 0.21132486540518713  # (1 - 1/sqrt(3))/2: first of two points between 0 and 1
_HALF_APART = 0.28867513459481287  # 1/(2 sqrt(3)): of the two points
_PER_APART = 1.7320508075688772  # sqrt(3): reciprocal of their distance
_LEAST_SIDE = 1e-5  # share of a line; a side of the pitch line below it has one mean friction
_PER_BUILD_UP = 1.0 / DAMPING_BUILD_UP  # 1/m, as `mesh_damping.built_up`
_FEW_STATIONS = 3  # up to so many, moments save nothing


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
def friction_law(mu_1: float, mu_2: float, start: float, end: float) -> tuple[float, float, float]:
    """Return mu at station 0, its slope, and its least value on one side of the pitch line.

    It is a straight line through `mu_1` and `mu_2` at the Gauss points of the side, which lies
    between the stations `start` and `end`.
    """
    size = end - start
    if mu_1 == mu_2 or size < _LEAST_SIDE:
        mean = 0.5 * (mu_1 + mu_2)
        return mean, 0.0, mean
    slope = (mu_2 - mu_1) * _PER_APART / size
    origin = mu_1 - slope * (start + GAUSS * size)
    return origin, slope, origin + min(slope * start, slope * end)


@kernel
def line_sums(a: float, tilt: float, phase: float, data: Array, mu: Array, mu_at: int) -> LineSums:
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
    polynomials of at most third degree, fourth in Fz where mu varies: two Gauss points are exact.
    The part of a line that touches all along takes no points, see `line_moments`. `moving` keeps
    the energy balance: a spring that enters or leaves loaded takes or gives work, which the pinion
    feels as a torque -r_bp moving. It is about 1e-4 of the mesh torque and missing in He et al.
    2007.
    """
    p: FlankConstants = tuple_from_array(data, FlankConstants)
    plane = p.plane
    half = 0.5 * plane.W
    tan_b = plane.sin_b / plane.cos_b
    inverse = 1.0 / tan_b if tan_b > 0.0 else 0.0
    lines = int(p.lines)
    n_s = int(p.stations)
    n_phase = int(p.phases)
    to_offset = n_phase * lines * n_s
    at_density = density_at(n_s, to_offset)
    per_X = n_phase / plane.pitch
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
        if row == n_phase - 1:  # the line is the next older one when the phase starts again
            after = at_density + (i + 1) * n_s if i + 1 < lines and n_phase > 1 else here
        N_line = Nz_line = F_line = Fz_line = energy_line = 0.0
        per_span = 1.0 / span
        t_pitch = (z_pitch - z_low) * per_span
        mu_0, mu_slope, least = friction_law(mu[at_mu], mu[at_mu + 1], 0.0, t_pitch)
        mu_1, mu_slope_1, least_1 = friction_law(mu[at_mu + 2], mu[at_mu + 3], t_pitch, 1.0)
        low = high = n_s
        if n_s > _FEW_STATIONS and min(least, least_1) >= 0.0:
            b0 = base + slope * z_low
            b1 = slope * span
            at = STATIONS_AT + n_s + (row * lines + i) * (LINE_HEAD + N_MOMENTS * n_s)
            if data[at] != data[LEVEL]:
                fill_moments(here, after, to_offset, at, n_s, data)
            # from station `low` to `high` the line touches everywhere, its damping is built up
            low, high = 0, n_s - 1
            if not min(b0, b0 + b1) - data[at + 1] >= DAMPING_BUILD_UP:
                low, high = built_up_stations(b0, b1, here, after, to_offset, part, n_s, data)
        if low < high:
            at += LINE_HEAD
            at_low = at + N_MOMENTS * low
            at_high = at + N_MOMENTS * high
            weight = span * per_cos
            touched = weight * (
                moment(0, at_low, at_high, data) + part * moment(LINEAR, at_low, at_high, data)
            )
            stiffness += touched
            whole += touched
            built += touched
            w = load_moment(0, b0, b1, at_low, at_high, part, data)
            w_t = load_moment(1, b0, b1, at_low, at_high, part, data)
            w_tt = load_moment(2, b0, b1, at_low, at_high, part, data)
            energy_line, growth = energy_and_growth(b0, b1, at_low, at_high, part, data)
            energy_line *= weight
            moving += 0.5 * weight * growth * per_X
            N_line = weight * w
            Nz_line = z_low * N_line + weight * span * w_t
            # what of it lies before the pitch line
            c = low
            while c < high and data[STATIONS_AT + c + 1] <= t_pitch:
                c += 1
            at_pitch = at + N_MOMENTS * c
            before = load_moment(0, b0, b1, at_low, at_pitch, part, data)
            before_t = load_moment(1, b0, b1, at_low, at_pitch, part, data)
            before_tt = load_moment(2, b0, b1, at_low, at_pitch, part, data)
            t_a = data[STATIONS_AT + c]
            if c < high and t_a < t_pitch:
                cell = cell_ends(here + c, after + c, to_offset, part, data)
                size = t_pitch - t_a
                per_cell = 1.0 / (data[STATIONS_AT + c + 1] - t_a)
                for point in range(2):
                    t = (0.5 + (2 * point - 1) * _HALF_APART) * size
                    u = t * per_cell
                    t += t_a
                    g = b0 + b1 * t - cell.e_a - u * (cell.e_b - cell.e_a)
                    load = 0.5 * size * (cell.k_a + u * (cell.k_b - cell.k_a)) * g
                    before += load
                    before_t += load * t
                    before_tt += load * t * t
            drag = mu_1 * (w - before) + mu_slope_1 * (w_t - before_t)
            drag -= mu_0 * before + mu_slope * before_t
            drag_t = mu_1 * (w_t - before_t) + mu_slope_1 * (w_tt - before_tt)
            drag_t -= mu_0 * before_t + mu_slope * before_tt
            F_line = weight * drag
            Fz_line = z_low * F_line + weight * span * drag_t
        done = high - low
        for n in range(n_s - 1 - done):
            c = n if n < low else n + done
            t_a = data[STATIONS_AT + c]
            t_size = data[STATIONS_AT + c + 1] - t_a
            z_a = z_low + t_a * span
            width = t_size * span
            k_a, k_b, e_a, e_b, dk_a, dk_b, de_a, de_b = cell_ends(
                here + c, after + c, to_offset, part, data
            )
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
                built += touched_1 * min(1.0, g_1 * _PER_BUILD_UP)
                built += touched_2 * min(1.0, g_2 * _PER_BUILD_UP)
                N_line += load_1 + load_2
                Nz_line += load_1 * z_1 + load_2 * z_2
                energy_line += load_1 * g_1 + load_2 * g_2
                if n_phase > 1:
                    moving -= load_1 * (de_a + t_1 * (de_b - de_a)) * per_X
                    moving -= load_2 * (de_a + t_2 * (de_b - de_a)) * per_X
                    stiffening = (dk_a + t_1 * (dk_b - dk_a)) * g_1 * g_1
                    stiffening += (dk_a + t_2 * (dk_b - dk_a)) * g_2 * g_2
                    moving += 0.5 * weight * stiffening * per_X
                origin = mu_0 if side == 0 else mu_1
                gradient = mu_slope if side == 0 else mu_slope_1
                drag_1 = max(origin + gradient * (t_a + t_1 * t_size), 0.0)
                drag_2 = max(origin + gradient * (t_a + t_2 * t_size), 0.0)
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
            growth = (rate_high - rate_low) * per_span
            moving += growth * (0.5 * energy_line + slope * (Nz_line - z_low * N_line))
    return LineSums(N, Nx, Nz, F, Fx, Fz, energy, moving, stiffness, whole, built)
