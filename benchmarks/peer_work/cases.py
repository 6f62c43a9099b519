"""Numbers of the work that all programs do, and how a program takes its turn.

Every side runs in a Python of its own, from 3.9 on, so only NumPy is imported here.
"""

import json
import math
import os
import sys
import time

import numpy as np

# Geared turbo-alternator of Rao et al. 1998, doi 10.1016/S0094-114X(97)00056-6, as in ROSS's
# `two_shaft_rotor_example`; both pitch radii from one module, no damping.
# Lengths in m, masses in kg, inertias in kg m2, stiffness in N/m.
PAIR = {
    "E": 207e9,
    "G": 79.5e9,
    "density": 7800.0,
    "teeth": (328, 23),
    "module": 2.0 * 0.5505 / 328,
    "pressure_angle": math.radians(22.5),
    "mesh_stiffness": 1e8,
    "lengths": ((0.1, 4.24, 1.16, 0.3), (0.3, 5.0, 0.1)),
    "diameters": ((0.3, 0.3, 0.22, 0.22), (0.15, 0.15, 0.15)),
    # node, mass, inertia about a diameter, polar inertia
    "discs": (((1, 525.7, 16.1, 32.2), (2, 116.04, 3.115, 6.23)), ((2, 7.45, 0.0745, 0.149),)),
    "gears": ((4, 726.4, 56.95, 113.9), (0, 5.0, 0.002, 0.004)),
    # nodes, stiffness along x and y
    "bearings": (((0, 3), 183.9e6, 200.4e6), ((1, 3), 10.1e6, 41.6e6)),
}
LOWEST, COUNT = 0.5, 12  # Hz: below are rigid motions; frequencies that are compared

# Steady smooth film of [mourier_2006], as in study A of EHL-FBNS.
FILM = {
    "radius": 12.5e-3,  # m
    "load": 15.0,  # N
    "speed": 0.09,  # m/s, mean of both surfaces
    "reduced_modulus": 110e9,  # Pa, 2/((1 - nu^2)/E + (1 - nu^2)/E)
    "eta0": 0.25,  # Pa s
    "alpha": 22e-9,  # 1/Pa
    "roelands_pressure": 1.0 / 5.1e-9,  # Pa
    "density_pressure": 5.9e8,  # Pa, of Dowson and Higginson's law
    "density_factor": 1.34,
    "half_width": 3.0,  # of the domain, in Hertzian radii
}
FILM["hertz_radius"] = (1.5 * FILM["load"] * FILM["radius"] / FILM["reduced_modulus"]) ** (1 / 3)
FILM["roelands_z"] = FILM["alpha"] * FILM["roelands_pressure"] / (math.log(FILM["eta0"]) + 9.67)
FILM["hertz_pressure"] = 1.5 * FILM["load"] / (math.pi * FILM["hertz_radius"] ** 2)

# Periodic rough patch on a half-space: side [m], E* [Pa], mean pressure over E* and rms slope.
SIDE, MODULUS, SLOPE = 1e-3, 1e11, 0.02
LOADS = (0.02, 0.05, 0.1, 0.2)
WAVE_SHARE = 0.3  # of the pressure that closes a wave, [johnson_1985 sec. 13.2]


def rough_patch(nodes, seed=7):
    """Return self-affine heights [m], Hurst exponent 0.8, waves of 1/4 to 1/32 of the side."""
    step = SIDE / nodes
    along = 2.0 * math.pi * np.fft.fftfreq(nodes, step)
    wave = np.hypot(along[:, None], 2.0 * math.pi * np.fft.rfftfreq(nodes, step))
    longest = 2.0 * math.pi / SIDE
    band = (wave >= 4.0 * longest) & (wave <= 32.0 * longest)
    size = np.where(band, np.where(band, wave, 1.0) ** -1.8, 0.0)
    phase = np.random.default_rng(seed).random(size.shape)
    height = np.fft.irfft2(size * np.exp(2j * math.pi * phase), (nodes, nodes))
    power = np.abs(np.fft.fft2(height)) ** 2 * (along[:, None] ** 2 + along**2)
    return height * SLOPE * nodes**2 / math.sqrt(power.sum())


def waved_patch(nodes):
    """Return heights [m] of one straight wave along the first axis."""
    crest = np.cos(2.0 * math.pi * (np.arange(nodes) + 0.5) / nodes - math.pi)
    return SLOPE * SIDE / (2.0 * math.pi) * crest[:, None] + np.zeros(nodes)


def westergaard(nodes):
    """Return mean pressure and pressure [Pa] of the straight wave, [johnson_1985 sec. 13.2].

    p = 2 pm cos(psi)/sin(psi_a)^2 sqrt(sin(psi_a)^2 - sin(psi)^2), psi = pi x/L,
    sin(psi_a)^2 = pm/p*, p* = pi E* A/L
    """
    amplitude = SLOPE * SIDE / (2.0 * math.pi)
    mean = WAVE_SHARE * math.pi * MODULUS * amplitude / SIDE
    psi = math.pi * ((np.arange(nodes) + 0.5) / nodes - 0.5)
    inside = np.maximum(WAVE_SHARE - np.sin(psi) ** 2, 0.0)
    return mean, (2.0 * mean / WAVE_SHARE * np.cos(psi) * np.sqrt(inside))[:, None] + np.zeros(
        nodes
    )


def rough_loads(press):
    """Return the work on rough patches from a function of heights, mean pressure and tolerance."""

    def run(nodes, tolerance, out, wave=False):
        if wave:
            height, loads = waved_patch(nodes), [westergaard(nodes)[0]]
        else:
            height, loads = rough_patch(nodes), [one * MODULUS * SLOPE for one in LOADS]
        began = time.perf_counter()
        pressures = [press(height, load, tolerance) for load in loads]
        seconds = time.perf_counter() - began
        np.save(out, np.array(pressures))
        return {"seconds": seconds}

    return run


def found_frequencies(found, first, began, built):
    """Return the answer on a gear pair: times [s] and the first frequencies [Hz] above LOWEST."""
    return {
        "seconds": time.perf_counter() - began,
        "building": built - began,
        "frequencies": found[found > LOWEST][:first].tolist(),
    }


def serve(run, version):
    """Answer each line of JSON on the standard input by one; prints of a program go elsewhere."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    print(json.dumps({"version": version}), file=answers, flush=True)
    for line in sys.stdin:
        began = time.perf_counter()
        try:
            found = run(**json.loads(line))
        except Exception as error:
            found = {"error": (str(error) or type(error).__name__)[:200]}
        print(json.dumps({"seconds": time.perf_counter() - began, **found}), file=answers)
        answers.flush()
