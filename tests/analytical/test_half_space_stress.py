"""Stress below the surface against Hertz's closed forms and the laws of elasticity."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlube_core.contact.half_space_stress import (
    HalfSpaceStress,
    greatest_shear,
    hydrostatic_stress,
    mises_stress,
    principal_stresses,
)
from gearlube_core.errors import ParameterError
from tests.helpers.each import each

N = 129
X = np.linspace(-2.0, 2.0, N)  # half-widths
STEP = 4.0 / (N - 1)
LINE = np.sqrt(np.maximum(1.0 - X**2, 0.0))[:, None] + np.zeros(4)
# The pressure begins with an infinite slope: nodes of 1/32 half-width miss (1/32)^1.5 there.
NEAR = 5e-3


def line(**loads) -> HalfSpaceStress:
    given = {"pressure": LINE} | loads
    return HalfSpaceStress(spacing=(STEP, 1.0), poisson_ratio=0.3, periodic=(False, True), **given)


def circle() -> HalfSpaceStress:
    r = np.hypot(X[:, None], X)
    pressure = np.sqrt(np.maximum(1.0 - r**2, 0.0))
    return HalfSpaceStress(pressure=pressure, spacing=(STEP, STEP), poisson_ratio=0.3)


def mcewen(x: np.ndarray, z: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return sigma_xx, sigma_zz, sigma_xz below a line contact [johnson_1985 (4.49)]."""
    part = 1.0 - x**2 + z**2
    root = np.sqrt(part**2 + 4.0 * x**2 * z**2)
    m, n = np.sqrt(0.5 * (root + part)), np.sqrt(0.5 * (root - part)) * np.sign(x)
    share = (z**2 + n**2) / (m**2 + n**2)
    xz = -n * (m**2 - z**2) / (m**2 + n**2)
    return -(m * (1.0 + share) - 2.0 * z), -m * (1.0 - share), xz


@each("z", [0.25, 0.786, 2.0])
def test_line_contact_has_the_field_of_mcewen(z: float):
    stress = line()(z)[:, :, 2]
    xx, zz, xz = mcewen(X, z)
    assert stress[0] == pytest.approx(xx, abs=NEAR)
    assert stress[2] == pytest.approx(zz, abs=NEAR)
    assert stress[5] == pytest.approx(xz, abs=NEAR)
    assert stress[1] == pytest.approx(0.3 * (xx + zz), abs=NEAR)  # plane strain
    assert np.abs(stress[3:5]).max() < 1e-12


def test_greatest_shear_lies_where_hertz_has_it():
    # a line: 0.300 p0 at 0.786 of the half-width
    z = np.linspace(0.7, 0.87, 18)
    shear = [float(greatest_shear(line()(one))[N // 2, 0]) for one in z]
    assert max(shear) == pytest.approx(0.300, abs=0.0015)
    assert z[int(np.argmax(shear))] == pytest.approx(0.786, abs=0.01)
    # a circle, nu 0.3: 0.310 p0 at 0.48 of the radius
    z = np.linspace(0.44, 0.52, 9)
    round_one = circle()
    shear = [float(greatest_shear(round_one(one))[N // 2, N // 2]) for one in z]
    assert max(shear) == pytest.approx(0.310, abs=0.0015)
    assert z[int(np.argmax(shear))] == pytest.approx(0.48, abs=0.01)


@each("z", [0.0, 0.3, 1.0, 2.5])
def test_axis_of_a_round_contact_has_its_closed_form(z: float):
    # [johnson_1985 (3.45)]
    stress = circle()(z)[:, N // 2, N // 2]
    turn = z * math.atan2(1.0, z)
    radial = -1.3 * (1.0 - turn) + 0.5 / (1.0 + z * z)
    # images at four widths of four radii leave 1e-3
    assert stress[:3] == pytest.approx([radial, radial, -1.0 / (1.0 + z * z)], abs=2e-3)
    assert stress[3:] == pytest.approx(np.zeros(3), abs=1e-12)


def test_sliding_line_is_pulled_behind_and_pressed_ahead():
    # under q = q0 sqrt(1 - x^2), acting on the solid along x, sigma_xx = -2 q0 x at the surface
    inside = np.abs(X) < 0.9
    stress = line(pressure=0.0 * LINE, traction_x=0.1 * LINE)(0.0)
    assert stress[0][inside, 0] == pytest.approx(-0.2 * X[inside], abs=3e-3)
    assert stress[5] == pytest.approx(-0.1 * LINE, abs=1e-12)


def test_line_loads_along_the_line_turn_no_plane():
    # mode III: sigma_yz = -q at the surface, and far below a line load of Q: -Q z/(pi r^2)
    stress = line(pressure=0.0 * LINE, traction_y=LINE)
    assert stress(0.0)[4] == pytest.approx(-LINE, abs=1e-12)
    z, load = 20.0, float(LINE[:, 0].sum()) * STEP
    far = stress(z)[:, :, 0]
    square = X**2 + z * z
    # a quarter of the half-width over z, squared
    assert far[4] == pytest.approx(-load * z / (math.pi * square), rel=2e-3)
    assert far[3] == pytest.approx(-load * X / (math.pi * square), rel=2e-3, abs=1e-8)


def test_any_load_is_in_equilibrium_fits_together_and_meets_the_surface():
    # These three determine the stress: div = 0, (1 + nu) lap(s_ij) + d_ij tr s = 0, s_iz = -loads
    n, nu = 32, 0.27
    random = np.random.default_rng(2)
    k = np.fft.fftfreq(n) * n
    low = (np.abs(k)[:, None] < 5) & (np.abs(k) < 5)
    loads = [np.fft.ifft2(np.fft.fft2(random.standard_normal((n, n))) * low).real for _ in range(3)]
    side = 2.0 * math.pi
    field = HalfSpaceStress(
        pressure=loads[0],
        traction_x=loads[1],
        traction_y=loads[2],
        spacing=(side / n, side / n),
        poisson_ratio=nu,
        periodic=(True, True),
    )
    surface = field(0.0)
    for component, load in ((2, loads[0]), (5, loads[1]), (4, loads[2])):
        assert surface[component] == pytest.approx(-load, abs=1e-12)

    z, dz = 0.3, 1e-3
    below, at, above = (field(z + one) for one in (dz, 0.0, -dz))

    def along(values: np.ndarray, axis: int) -> np.ndarray:
        if axis == 2:
            raise AssertionError
        turn = 1j * (k[:, None] if axis == 0 else k[None, :])
        return np.fft.ifft2(np.fft.fft2(values) * turn).real

    down = (below - above) / (2.0 * dz)
    down_twice = (below - 2.0 * at + above) / dz**2
    scale = np.abs(down).max()
    rows = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    for i in range(3):
        divergence = along(at[rows[i][0]], 0) + along(at[rows[i][1]], 1) + down[rows[i][2]]
        # central differences: (k dz)^2/6 with k to 6
        assert np.abs(divergence).max() < 1e-5 * scale

    def second(values: np.ndarray, i: int, j: int) -> np.ndarray:
        parts = {"at": values[1], "down": values[2], "twice": values[3]}
        if i == j == 2:
            return parts["twice"]
        if 2 in (i, j):
            return along(parts["down"], min(i, j))
        return along(along(parts["at"], i), j)

    def stacked(component: int | None) -> np.ndarray:
        fields = (below, at, down, down_twice)
        return np.array([f[:3].sum(axis=0) if component is None else f[component] for f in fields])

    trace = stacked(None)
    size = np.abs(down_twice).max()
    for i in range(3):
        for j in range(i, 3):
            one = stacked(rows[i][j])
            laplacian = sum(second(one, m, m) for m in range(3))
            misfit = (1.0 + nu) * laplacian + second(trace, i, j)
            assert np.abs(misfit).max() < 1e-4 * size


@pytest.mark.slow
def test_line_of_repeated_loads_is_that_of_many_single_ones():
    # bumps that repeat along y: 25 of them on a wide half-space that is open all around
    y = np.arange(16) / 8.0
    bump = np.exp(-4.0 * X[::4, None] ** 2 - 4.0 * (y - 1.0) ** 2)
    many = np.pad(np.tile(bump, 25), ((66, 66), (0, 0)))
    for share in (0.0, 0.3):
        given = {"spacing": (4.0 * STEP, 1.0 / 8.0), "poisson_ratio": 0.3}
        repeated = HalfSpaceStress(
            pressure=bump, traction_x=share * bump, periodic=(False, True), **given
        )
        single = HalfSpaceStress(pressure=many, traction_x=share * many, **given)
        # bumps beyond the last and images at four widths: 3e-3 of the largest pressure
        middle = single(0.4)[:, 66:-66, 12 * 16 : 13 * 16]
        assert repeated(0.4) == pytest.approx(middle, abs=3e-3)


def test_mean_pressure_that_repeats_everywhere_is_held_sideways():
    field = HalfSpaceStress(
        pressure=np.full((8, 8), 3.0), spacing=(1.0, 1.0), poisson_ratio=0.25, periodic=(True, True)
    )
    for z in (0.0, 5.0):
        assert field(z)[:, 1, 1] == pytest.approx([-1.0, -1.0, -3.0, 0.0, 0.0, 0.0], abs=1e-12)


def test_invariants_are_those_of_the_eigenvalues():
    random = np.random.default_rng(7)
    stress = random.standard_normal((6, 50))
    stress[:, 0] = [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]
    stress[:, 1] = [1.0, 1.0, -2.0, 0.0, 0.0, 0.0]
    a, b, c, ab, bc, ac = stress
    tensors = np.array([[a, ab, ac], [ab, b, bc], [ac, bc, c]]).transpose(2, 0, 1)
    values = np.linalg.eigvalsh(tensors)[:, ::-1].T
    # equal ones lose half of the digits
    assert principal_stresses(stress) == pytest.approx(values, abs=1e-7)
    assert greatest_shear(stress) == pytest.approx(0.5 * (values[0] - values[2]), abs=1e-7)
    assert hydrostatic_stress(stress) == pytest.approx(values.mean(axis=0), abs=1e-12)
    squares = sum((values[i] - values[j]) ** 2 for i, j in ((0, 1), (1, 2), (2, 0)))
    assert mises_stress(stress) == pytest.approx(np.sqrt(0.5 * squares), abs=1e-12)


@each(
    ("wrong", "words"),
    [
        ({"periodic": (True, False)}, "Turn the axes"),
        ({"traction_x": np.zeros((3, 3))}, r"traction_x must be finite .* got \(3, 3\)"),
        ({"pressure": np.full((4, 4), np.nan)}, "pressure must be finite"),
        ({"poisson_ratio": 0.7}, "poisson_ratio must be within"),
        ({"spacing": (1.0, 0.0)}, "spacing along y"),
    ],
)
def test_loads_that_cannot_be_are_refused(wrong, words: str):
    given = {"pressure": np.zeros((4, 4)), "spacing": (1.0, 1.0), "poisson_ratio": 0.3} | wrong
    with pytest.raises(ParameterError, match=words):
        HalfSpaceStress(**given)
