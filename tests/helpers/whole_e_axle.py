"""The e-axle in its case with all finite elements of the case: an assembly of its own."""

from __future__ import annotations

import itertools
import math
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp

from drivetrain.train.part_section import read_part
from examples.e_axle_case import WholeCase
from gearlube_core.dynamics.train.shaft import Shaft
from gearlube_core.shafts.beam import shaft_beam

_SPRINGS = ("K_xx_n_per_um", "K_yy_n_per_um", "K_zz_n_per_um",
            "K_ax_n_m_per_rad", "K_ay_n_m_per_rad")  # fmt: skip


class WholeAxle(NamedTuple):
    """Matrices of case, shafts and wheels, and where each place has its first coordinate."""

    stiffness: sp.csc_matrix
    mass: sp.csc_matrix
    first: dict[str, int]  # of x y z rx ry rz; of a wheel its angle
    pushes: dict[str, np.ndarray]  # of a mesh: stiffness times its line of action [N/m], [N]


def whole_axle(data: dict[str, Any], case: WholeCase) -> WholeAxle:
    """Return the train of a file's data; its shafts are beams with all their modes."""
    n_case = case.mass.shape[0]
    start = n_case - case.owner.size
    rows = case.owner.tolist()
    first = {f"case.{one.name}": start + rows.index(i) for i, one in enumerate(case.nodes)}
    blocks: list[tuple[Any, Any]] = [(case.stiffness, case.mass)]
    size = n_case
    for name, given in data["bodies"].items():
        if given.get("kind") == "shaft":
            shaft, wrong = read_part(Shaft, name, given, name, {})
            assert shaft, wrong
            stiffness, mass, places = _beams(shaft)
            for node, place in shaft.nodes.items():
                first[f"{name}.{node}"] = size + 6 * int(abs(places - place).argmin())
        elif name.endswith("wheel"):
            stiffness, mass = np.zeros((1, 1)), np.array([[1.1]])  # kg m2
            first[name] = size
        else:
            continue
        blocks.append((stiffness, mass))
        size += len(mass)
    stiffness, mass = (sp.block_diag([one[i] for one in blocks]).tolil() for i in (0, 1))
    pushes: dict[str, np.ndarray] = {}
    springs: list[tuple[float, np.ndarray]] = []
    elements = data["elements"]
    for name, given in elements.items():
        whole = given
        while "like" in whole:
            whole = elements[whole["like"]] | {k: v for k, v in whole.items() if k != "like"}
        if whole["kind"] == "joint":
            for i, key in enumerate(_SPRINGS):
                way = np.zeros(size)
                way[first[whole["first"]] + i] = 1.0
                if whole["second"] != "ground":
                    way[first[whole["second"]] + i] = -1.0
                springs.append((whole.get(key, 0.0) * (1e6 if i < 3 else 1.0), way))
        elif whole["kind"] == "half_shaft":
            way = np.zeros(size)
            way[first[whole["first"]] + 5], way[first[whole["second"]]] = 1.0, -1.0
            springs.append((whole["stiffness_n_m_per_rad"], way))
        elif whole["kind"] == "gear_mesh":
            k, way = 1e6 * whole["stiffness_n_per_um"], _line_of_action(whole, first, size)
            springs.append((k, way))
            pushes[name] = k * way
    for k, way in springs:
        at = np.flatnonzero(way)
        for i, j in itertools.product(at, at):
            stiffness[i, j] += k * way[i] * way[j]
    return WholeAxle(stiffness.tocsc(), mass.tocsc(), first, pushes)


def _beams(shaft: Shaft) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return stiffness, mass and places of a shaft, x y z rx ry rz at each place."""
    nodes = list(shaft.nodes.values())
    beam = shaft_beam(shaft.sections, shaft.discs, nodes, shaft.material, shaft._longest())
    n = 6 * beam.places.size
    matrices = []
    for bending, axial, torsion in (
        (beam.bending.stiffness, beam.axial_stiffness, beam.torsion_stiffness),
        (beam.bending.mass, beam.axial_mass, beam.torsion_inertia),
    ):
        whole = np.zeros((n, n))
        for move, turn, sign in ((0, 4, 1.0), (1, 3, -1.0)):
            order = np.array([6 * i + c for i in range(n // 6) for c in (move, turn)])
            ways = np.where(order % 6 == turn, sign, 1.0)
            whole[np.ix_(order, order)] = bending * np.outer(ways, ways)
        whole[2::6, 2::6], whole[5::6, 5::6] = axial, torsion
        matrices.append(whole)
    return matrices[0], matrices[1], beam.places


def _line_of_action(given: dict[str, Any], first: dict[str, int], size: int) -> np.ndarray:
    """Return what presses the flanks together [m/m], [m/rad]."""
    normal, helix, azimuth = (
        math.radians(one) for one in (20.0, given["helix_angle_deg"], given["azimuth_deg"])
    )
    sense = 1.0 if given.get("drives_forward", True) else -1.0
    hand = 1.0 if given["right_hand"] else -1.0
    c = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    t = np.cross([0.0, 0.0, 1.0], c)
    along = math.cos(helix) * t - hand * math.sin(helix) * np.array([0.0, 0.0, 1.0])
    push = sense * math.cos(normal) * along + math.sin(normal) * c
    way = np.zeros(size)
    for node, teeth, sign in (("first", "teeth_1", 1.0), ("second", "teeth_2", -1.0)):
        radius = 0.5e-3 * given["normal_module_mm"] * given[teeth] / math.cos(helix)
        at = first[given[node]]
        way[at : at + 3] += sign * push
        way[at + 3 : at + 6] += sign * np.cross(sign * radius * c, push)
    return way
