"""Timoshenko beams: matrices of elements, and of a shaft along z.

Sources: [nelson_1980], and [friswell_2010] for the matrices with shear.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.shafts.section import ShaftDisc, ShaftMaterial, ShaftSection

_AT_NODE = 1e-9  # m: closer than this is the same place


class Bending(NamedTuple):
    """Matrices of bending in one plane, two coordinates at each place: deflection and slope."""

    stiffness: Array
    mass: Array
    tilting: Array  # part of `mass` that resists slopes; twice it turns about the axis


@dataclass(frozen=True)
class Beam:
    """A shaft cut into elements, free at both ends.

    Parameters
    ----------
    places : ndarray of shape (n,)
        Rising, along z [m].
    bending : Bending
        Of one plane, (2 n, 2 n); that of the other plane is the same.
    axial_stiffness, axial_mass : ndarray of shape (n, n)
        [N/m], [kg]
    torsion_stiffness, torsion_inertia : ndarray of shape (n, n)
        [N.m/rad], [kg m2]
    """

    places: Array
    bending: Bending
    axial_stiffness: Array
    axial_mass: Array
    torsion_stiffness: Array
    torsion_inertia: Array


def shear_coefficient(section: ShaftSection, poisson: float) -> float:
    """Return the shear coefficient of a hollow circle [-], [cowper_1966].

    Examples
    --------
    >>> solid = ShaftSection(start=0.0, end=1.0, outer_diameter=0.05)
    >>> round(shear_coefficient(solid, 0.3), 6)
    0.886364
    """
    square = (1.0 + (section.inner_diameter / section.outer_diameter) ** 2) ** 2
    m2 = (section.inner_diameter / section.outer_diameter) ** 2
    below = (7.0 + 6.0 * poisson) * square + (20.0 + 12.0 * poisson) * m2
    return 6.0 * (1.0 + poisson) * square / below


def bending_element(section: ShaftSection, length: float, material: ShaftMaterial) -> Bending:
    """Return the matrices of an element [nelson_1980], shapes (4, 4).

    Parameters
    ----------
    section : ShaftSection
    length : float
        Of the element [m].
    material : ShaftMaterial

    Examples
    --------
    >>> solid = ShaftSection(start=0.0, end=1.0, outer_diameter=0.05)
    >>> element = bending_element(solid, 1.0, ShaftMaterial())
    >>> bool(np.allclose(element.stiffness @ [1.0, 0.0, 1.0, 0.0], 0.0))  # it moves as a whole
    True
    """
    area, second = section.area, section.second_moment
    E, G, rho, L = material.E, material.G, material.density, length
    kappa = shear_coefficient(section, material.poisson)
    phi = 12.0 * E * second / (kappa * G * area * L * L)
    stiffness = _symmetric(
        [12.0, 6.0 * L, -12.0, 6.0 * L],
        [(4.0 + phi) * L * L, -6.0 * L, (2.0 - phi) * L * L],
        [12.0, -6.0 * L],
        [(4.0 + phi) * L * L],
    ) * (E * second / ((1.0 + phi) * L**3))
    m1 = 13.0 / 35.0 + 7.0 * phi / 10.0 + phi * phi / 3.0
    m2 = (11.0 / 210.0 + 11.0 * phi / 120.0 + phi * phi / 24.0) * L
    m3 = 9.0 / 70.0 + 3.0 * phi / 10.0 + phi * phi / 6.0
    m4 = (13.0 / 420.0 + 3.0 * phi / 40.0 + phi * phi / 24.0) * L
    m5 = (1.0 / 105.0 + phi / 60.0 + phi * phi / 120.0) * L * L
    m6 = (1.0 / 140.0 + phi / 60.0 + phi * phi / 120.0) * L * L
    moving = _symmetric([m1, m2, m3, -m4], [m5, m4, -m6], [m1, -m2], [m5])
    moving *= rho * area * L / (1.0 + phi) ** 2
    m8 = (1.0 / 10.0 - phi / 2.0) * L
    m9 = (2.0 / 15.0 + phi / 6.0 + phi * phi / 3.0) * L * L
    m10 = (-1.0 / 30.0 - phi / 6.0 + phi * phi / 6.0) * L * L
    tilting = _symmetric([1.2, m8, -1.2, m8], [m9, -m8, m10], [1.2, -m8], [m9])
    tilting *= rho * second / (L * (1.0 + phi) ** 2)
    return Bending(stiffness, moving + tilting, tilting)


def _symmetric(*rows: Sequence[float]) -> Array:
    """Return a symmetric matrix from the rows of its upper triangle."""
    n = len(rows)
    made = np.zeros((n, n))
    for i, row in enumerate(rows):
        made[i, i:] = row
        made[i:, i] = row
    return made


def shaft_beam(
    sections: Sequence[ShaftSection],
    discs: Sequence[ShaftDisc],
    places: Sequence[float],
    material: ShaftMaterial,
    longest: float,
) -> Beam:
    """Return a shaft as a beam.

    Parameters
    ----------
    sections : sequence of ShaftSection
        Pieces from end to end; overlapping ones, such as a gear blank on its shaft, add up.
    discs : sequence of ShaftDisc
        Rigid masses on it.
    places : sequence of float
        Along z [m], where nodes of the beam must be, beside the ends of sections and the discs.
    material : ShaftMaterial
    longest : float
        Length of no element is above this [m].

    Examples
    --------
    >>> shaft = [ShaftSection(start=0.0, end=1.0, outer_diameter=0.05)]
    >>> beam = shaft_beam(shaft, [], [0.5], ShaftMaterial(), 0.1)
    >>> beam.places.size, round(float(beam.axial_mass.sum()), 3)  # kg
    (11, 15.413)
    """
    marks = sorted(
        [
            *(end for one in sections for end in (one.start, one.end)),
            *(one.position for one in discs),
            *places,
        ]
    )
    kept = [marks[0]]
    for mark in marks[1:]:
        if mark - kept[-1] > _AT_NODE:
            kept.append(mark)
    cut = [kept[0]]
    for a, b in itertools.pairwise(kept):
        n = max(1, math.ceil((b - a) / longest - _AT_NODE))
        cut += [a + (b - a) * (i + 1) / n for i in range(n)]
    z = np.array(cut)
    n = z.size
    bending = Bending(*(np.zeros((2 * n, 2 * n)) for _ in Bending._fields))
    axial_k, axial_m, torsion_k, torsion_j = (np.zeros((n, n)) for _ in range(4))
    stretch = np.array([[1.0, -1.0], [-1.0, 1.0]])
    spread = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0
    for i in range(n - 1):
        L, middle = z[i + 1] - z[i], 0.5 * (z[i] + z[i + 1])
        here = [one for one in sections if one.start < middle < one.end]
        ends, both = slice(2 * i, 2 * i + 4), slice(i, i + 2)
        for one in here:
            of_element = bending_element(one, L, material)
            for whole, own in zip(bending, of_element, strict=True):
                whole[ends, ends] += own
            axial_k[both, both] += material.E * one.area / L * stretch
            axial_m[both, both] += material.density * one.area * L * spread
            polar = 2.0 * one.second_moment
            torsion_k[both, both] += material.G * polar / L * stretch
            torsion_j[both, both] += material.density * polar * L * spread
    for disc in discs:
        i = int(np.argmin(abs(z - disc.position)))
        bending.mass[2 * i, 2 * i] += disc.mass
        bending.mass[2 * i + 1, 2 * i + 1] += disc.inertia
        # `tilting` counts half of what turns about the axis
        bending.tilting[2 * i + 1, 2 * i + 1] += 0.5 * disc.polar_inertia
        axial_m[i, i] += disc.mass
        torsion_j[i, i] += disc.polar_inertia
    return Beam(z, bending, axial_k, axial_m, torsion_k, torsion_j)
