"""Dry elastic contact on the grid of a film: start of a film and check of its largest pressure."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_positive
from gearlube_core.contact.half_space import HalfSpaceConvolution, love_coefficients
from gearlube_core.contact.half_space_periodic import PeriodicDeflection, periodic_modes
from gearlube_core.contact.unilateral import solve_torque
from gearlube_core.contact.unilateral_problem import Outcome, UnilateralProblem
from gearlube_core.errors import ParameterError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DryContact:
    """Two solids pressed together without a film, on a grid of nodes.

    Parameters
    ----------
    pressure, separation : ndarray, shape (nx, ny)
        Nodal pressure [Pa], and the gap left [m]: zero where the solids touch.
    approach
        How far the solids came together from first touch of the nodes [m]: minus h_0 of a film
        that vanishes, for a gap whose least nodal value is zero.
    touches_border
        Whether the loaded area reaches the border of the grid, where a film has no pressure.
    outcome
        How the iteration ended.
    """

    pressure: Array
    separation: Array
    approach: float
    touches_border: bool
    outcome: Outcome


def _displacement(
    dx: float, dy: float, nx: int, ny: int, contact_modulus: float, repeated: bool
) -> Callable[[Array], Array]:
    """Return the displacement [m] under cell forces [N], shape (nx, ny), as a function."""
    if not repeated:
        return HalfSpaceConvolution(love_coefficients(dx, dy, nx, ny, contact_modulus))
    # a distance beyond the domain keeps the logarithm of all pairs of cells above zero
    modes = periodic_modes(dx, dy, nx, ny, contact_modulus, 2.0 * nx * dx)
    periodic = PeriodicDeflection(modes, ny)
    return lambda forces: periodic(forces / (dx * dy))


def dry_contact_of_gap(
    gap: Array,
    dx: float,
    dy: float,
    contact_modulus: float,
    load: float,
    *,
    tolerance: float = 1e-6,
    start: Array | None = None,
    repeated: bool = False,
    throw: bool = True,
) -> DryContact:
    """Return the dry contact of a gap given at the nodes of a uniform grid.

    h_0 + h_u + u >= 0,  p >= 0,  p (h_0 + h_u + u) = 0,  sum of p dx dy = load

    Parameters
    ----------
    gap : ndarray, shape (nx, ny)
        h_u [m] up to a constant; infinite where there is no solid.
    dx, dy
        Node spacing [m]; pressure is constant over a cell around each node.
    contact_modulus
        E* [Pa].
    load
        [N], above zero.
    tolerance
        Of complementarity, relative [-], 1e-12 to 1e-2.
    start : ndarray, shape (nx, ny), optional
        Pressure [Pa] of a similar contact.
    repeated
        Solids and pressure repeat along y, beyond the cells of the last row; the load is that of
        one period.
    throw
        Raise when the iteration does not converge; else see `outcome`.

    Raises
    ------
    ParameterError
        An input is out of range or of the wrong shape.
    ConvergenceError
        The iteration did not converge.

    Notes
    -----
    Half-spaces without friction. Conjugate gradients of `contact.unilateral` with Love's
    displacement at cell centres by FFT: the same discrete elasticity as that of the films.
    """
    gap = np.asarray(gap, dtype=np.float64)
    if gap.ndim != 2 or gap.size == 0:
        raise ParameterError(f"gap must have shape (nx, ny), got {gap.shape}. Give it at nodes.")
    check_positive("load", load, "N")
    area = check_positive("dx", dx, "m") * check_positive("dy", dy, "m")
    nx, ny = gap.shape
    grid = _displacement(dx, dy, nx, ny, contact_modulus, repeated)
    if start is not None and np.shape(start) != gap.shape:
        raise ParameterError(
            f"start must have the shape of gap, {gap.shape}, got {np.shape(start)}. Leave it out."
        )
    lowest = float(gap.min())
    problem = UnilateralProblem(
        compliance=lambda forces: grid(forces.reshape(gap.shape)).ravel(),
        gap=(gap - lowest if np.isfinite(lowest) else gap).ravel(),
        arm=np.ones(gap.size),
        cell_area=np.full(gap.size, area),
    )
    solution = solve_torque(
        problem,
        load,
        tolerance=tolerance,
        max_iterations=20_000,
        start=None if start is None else np.asarray(start).ravel() * area,
        throw=throw,
    )
    pressure = solution.pressure.reshape(gap.shape)
    border = np.ones(gap.shape, dtype=bool)
    border[1:-1, slice(None) if repeated else slice(1, -1)] = False
    return DryContact(
        pressure=pressure,
        separation=solution.separation.reshape(gap.shape),
        approach=solution.rotation,
        touches_border=bool((pressure[border] > 0.0).any()),
        outcome=solution.outcome,
    )
