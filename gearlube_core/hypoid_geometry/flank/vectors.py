"""Vectors of three floats inside compiled kernels."""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlube_core.kernels.jit import kernel


class Vector(NamedTuple):
    """Three Cartesian components."""

    x: float
    y: float
    z: float


@kernel
def dot(a: Vector, b: Vector) -> float:
    """Return a . b."""
    return a.x * b.x + a.y * b.y + a.z * b.z


@kernel
def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b."""
    return Vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


@kernel
def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return Vector(a.x + b.x, a.y + b.y, a.z + b.z)


@kernel
def subtract(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return Vector(a.x - b.x, a.y - b.y, a.z - b.z)


@kernel
def combine(p: float, a: Vector, q: float, b: Vector) -> Vector:
    """Return p a + q b."""
    return Vector(p * a.x + q * b.x, p * a.y + q * b.y, p * a.z + q * b.z)


@kernel
def norm(a: Vector) -> float:
    """Return the length of a."""
    return math.sqrt(a.x * a.x + a.y * a.y + a.z * a.z)


@kernel
def rotate(a: Vector, axis: Vector, cosine: float, sine: float) -> Vector:
    """Return a turned about the unit vector `axis` by the angle of the given cosine and sine."""
    along = (1.0 - cosine) * dot(axis, a)
    turned = cross(axis, a)
    return Vector(
        cosine * a.x + sine * turned.x + along * axis.x,
        cosine * a.y + sine * turned.y + along * axis.y,
        cosine * a.z + sine * turned.z + along * axis.z,
    )
