"""Frequencies of the geared rotors by ROSS; its `M`, `K` are also solved by SciPy."""

import math
import time
from importlib.metadata import version

import numpy as np
import ross as rs
import scipy.linalg
from cases import COUNT, PAIR, found_frequencies, serve


def rotor(side, cuts, held=True):
    steel = rs.Material(name="steel", rho=PAIR["density"], E=PAIR["E"], G_s=PAIR["G"])
    sizes = zip(PAIR["lengths"][side], PAIR["diameters"][side], strict=True)
    shaft = [
        rs.ShaftElement(L=length / cuts, idl=0.0, odl=diameter, material=steel)
        for length, diameter in sizes
        for _ in range(cuts)
    ]
    discs = [
        rs.DiskElement(n=node * cuts, m=mass, Id=inertia, Ip=polar)
        for node, mass, inertia, polar in PAIR["discs"][side]
    ]
    node, mass, inertia, polar = PAIR["gears"][side]
    teeth = PAIR["teeth"][side]
    gear = rs.GearElement(
        n=node * cuts, m=mass, Id=inertia, Ip=polar, n_teeth=teeth,
        pitch_diameter=PAIR["module"] * teeth, pr_angle=PAIR["pressure_angle"],
    )  # fmt: skip
    nodes, k_x, k_y = PAIR["bearings"][side]
    bearings = [rs.BearingElement(n=n * cuts, kxx=k_x, kyy=k_y, cxx=0.0) for n in nodes]
    return rs.Rotor(shaft, [*discs, gear], bearings if held else [])


def save(side, cuts, path):
    """Write a rotor without its bearings, as gearlube reads it."""
    free = rotor(side, cuts, held=False)
    np.savez_compressed(
        path, places=free.nodes_pos, stiffness=free.K(0), mass=free.M(), gyroscopic=free.G()
    )


def run(mesh, matrices=False, first=COUNT, files=()):
    for side, path in enumerate(files):
        save(side, mesh, path)
    began = time.perf_counter()
    pair = rs.MultiRotor(
        rotor(0, mesh), rotor(1, mesh), gear_mesh_stiffness=PAIR["mesh_stiffness"],
        coupled_nodes=(PAIR["gears"][0][0] * mesh, PAIR["gears"][1][0]),
    )  # fmt: skip
    built = time.perf_counter()
    if matrices:
        squares = scipy.linalg.eigvalsh(pair.K(0), pair.M())
        found = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * math.pi)
    else:
        found = np.sort(pair.run_modal(speed=0, num_modes=48).wn) / (2.0 * math.pi)
    return found_frequencies(found, first, began, built)


if __name__ == "__main__":
    serve(run, version("ross-rotordynamics"))
