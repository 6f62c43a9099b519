"""Harmonic balance of the linear helical pair, apart from the march and the kernels of the package.

Lines of contact are clipped here, forces and strains are vectors integrated over each line, and the
Fourier series of their matrix over a mesh period replaces steps in time. [he_2007 (1)-(41)] with
the corrections that docs/helical.md lists; numbers as printed, or completed in its gear file.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise

import numpy as np

INCH = 0.0254
TEETH = (25, 31)
MASS, POLAR = (2.206598, 2.767004), (941.1636e-6, 1852.951e-6)  # kg, kg.m2
WIDTH, CENTRES = 1.25 * INCH, 3.5 * INCH
TIP = (0.5 * 3.38 * INCH, 0.5 * 4.13 * INCH)
HELIX, TRANSVERSE = math.radians(21.5), math.radians(25.0)  # at the reference circles
SPEED, TORQUE = 1000.0 * math.pi / 30.0, 225.96966  # rad/s, N.m
SUPPORT, ARM, DAMPING = 1401.014e6, 0.0508, 0.05  # of a gear [N/m], of a bearing [m], [-]
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(3)

MODULE = INCH / 8.0
BASE = tuple(0.5 * MODULE * z * math.cos(TRANSVERSE) for z in TEETH)
WORKING = math.acos(sum(BASE) / CENTRES)
TAN_B = math.tan(HELIX) * math.cos(TRANSVERSE)
COS_B, SIN_B = math.cos(math.atan(TAN_B)), math.sin(math.atan(TAN_B))
LENGTH = CENTRES * math.sin(WORKING)  # between the tangent points
START = LENGTH - math.sqrt(TIP[1] ** 2 - BASE[1] ** 2)
END = math.sqrt(TIP[0] ** 2 - BASE[0] ** 2)
PITCH_LINE = BASE[0] * math.tan(WORKING)
PITCH = 2.0 * math.pi * BASE[0] / TEETH[0]


def _pieces(phase: float) -> list[tuple[float, float, float]]:
    """Return X of the line and both ends of each piece of all lines, cut at the pitch line."""
    found = []
    for number in range(5):
        X = START + (phase + number) * PITCH
        low, high = max(START, X - WIDTH * TAN_B), min(X, END)
        cuts = sorted({low, high, min(max(PITCH_LINE, low), high)})
        found += [(X, a, b) for a, b in pairwise(cuts) if high > low]
    return found


def _mesh(phase: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Return the mesh per density without friction and what friction adds, and sum L [m].

    Forces on (pinion, gear) are -density * (first + mu * second) @ q; both (12, 12) [m, m2, m3].
    """
    X, low, high = (np.array(column)[:, None] for column in zip(*_pieces(phase), strict=True))
    x = (0.5 * (low + high) + 0.5 * (high - low) * _PLACES).ravel()
    dl = (0.5 * (high - low) * _WEIGHTS / SIN_B).ravel()
    z = 0.5 * WIDTH - (X - x.reshape(X.size, -1)).ravel() / TAN_B
    side = np.sign(x - PITCH_LINE)

    def generalised(force: np.ndarray) -> np.ndarray:
        # forces and moments on both members of a force on the pinion, which has its reaction
        arms = [
            np.stack((x - centre, np.full(x.size, radius), z), axis=1)
            for centre, radius in ((0.0, BASE[0]), (LENGTH, -BASE[1]))
        ]
        parts = [force, np.cross(arms[0], force), -force, -np.cross(arms[1], force)]
        return np.concatenate(parts, axis=1)

    normal = generalised(np.tile([-COS_B, 0.0, SIN_B], (x.size, 1)))
    sliding = generalised(np.outer(side, [0.0, 1.0, 0.0]))
    # the flanks are pressed together by minus the work of the force between them
    strain = -normal * dl[:, None]
    return -normal.T @ strain, -sliding.T @ strain, float(dl.sum())


@cache
def _mesh_over_period(samples: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    smooth, sliding, length = zip(*map(_mesh, np.arange(samples) / samples), strict=True)
    return np.array(smooth), np.array(sliding), np.array(length)


def _constants() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return mass, damping and stiffness of the bodies on their bearings, and the torques."""
    mass, stiffness, damping, torque = (np.zeros(12) for _ in range(4))
    for member in range(2):
        first = 6 * member
        disc = 0.5 * POLAR[member] + MASS[member] * WIDTH**2 / 12.0
        mass[first : first + 6] = [MASS[member]] * 3 + [disc] * 2 + [POLAR[member]]
        stiffness[first : first + 5] = [SUPPORT] * 3 + [SUPPORT * ARM**2] * 2
        torque[first + 5] = -TORQUE * BASE[member] / BASE[0]
    damping[:] = 2.0 * DAMPING * np.sqrt(stiffness * mass)
    return mass, damping, stiffness, torque


def amplitudes(
    density: float, mu: float, orders: int = 5, *, kept: int = 20, samples: int = 512
) -> dict[str, np.ndarray]:
    """Return amplitudes of mesh orders 1 to `orders` [m, N] by name.

    Parameters
    ----------
    density
        Stiffness of the mesh over length of contact [N/m2].
    mu
        [-].
    orders
        Returned.
    kept
        Orders of the series.
    samples
        Of the mesh over its period.
    """
    mass, damping, stiffness, torque = _constants()
    # psi = r_p th_zp + r_g th_zg stands for both rotations; their common turn does no strain
    expand = np.zeros((12, 11))
    expand[:5, :5] = np.eye(5)
    expand[6:11, 5:10] = np.eye(5)
    expand[5, 10] = 1.0 / BASE[0]  # strain asks for psi alone
    inertia = 1.0 / (BASE[0] ** 2 / POLAR[0] + BASE[1] ** 2 / POLAR[1])
    reduce = np.zeros((11, 12))
    reduce[:5, :5] = np.eye(5)
    reduce[5:10, 6:11] = np.eye(5)
    reduce[10, 5], reduce[10, 11] = inertia * BASE[0] / POLAR[0], inertia * BASE[1] / POLAR[1]
    rest = [0, 1, 2, 3, 4, 6, 7, 8, 9, 10]
    M = np.append(mass[rest], inertia)
    C, K = np.append(damping[rest], 0.0), np.append(stiffness[rest], 0.0)
    F = reduce @ torque

    smooth, sliding, length = _mesh_over_period(samples)
    series = density * reduce @ (smooth + mu * sliding) @ expand
    dampers = 2.0 * DAMPING * np.sqrt(inertia * density * COS_B**2 * length)
    mesh_orders = np.fft.fft(series, axis=0) / samples
    damper_orders = np.fft.fft(dampers) / samples

    omega = TEETH[0] * SPEED
    numbers = np.arange(-kept, kept + 1)
    size = 11 * numbers.size
    system, load = np.zeros((size, size), dtype=complex), np.zeros(size, dtype=complex)
    for row, n in enumerate(numbers):
        at = slice(11 * row, 11 * row + 11)
        for column, m in enumerate(numbers):
            block = mesh_orders[(n - m) % samples].copy()
            block[10, 10] += damper_orders[(n - m) % samples] * 1j * m * omega
            system[at, 11 * column : 11 * column + 11] = block
        system[at, at] += np.diag(K + 1j * n * omega * C - (n * omega) ** 2 * M)
    load[11 * kept : 11 * kept + 11] = F
    q = np.linalg.solve(system, load).reshape(numbers.size, 11)[kept + 1 : kept + 1 + orders]

    names = ["u_xp", "u_yp", "u_zp", "th_xp", "th_yp", "u_xg", "u_yg", "u_zg", "th_xg", "th_yg"]
    s = dict(zip([*names, "psi"], q.T, strict=True))
    s["delta_x"] = BASE[0] * s["th_xp"] + BASE[1] * s["th_xg"] + s["u_zp"] - s["u_zg"]
    s["delta_y"] = BASE[0] * s["th_yp"] + BASE[1] * s["th_yg"] + s["u_zp"] - s["u_zg"]
    s["delta_z"] = s["psi"] - s["u_xp"] + s["u_xg"]
    rate = 1j * omega * np.arange(1, orders + 1)
    for member in "pg":
        for axis in "xyz":
            i = names.index(f"u_{axis}{member}")
            s[f"F_{axis}{member}"] = (K[i] + C[i] * rate) * s[f"u_{axis}{member}"]
    return {name: 2.0 * np.abs(value) for name, value in s.items()}
