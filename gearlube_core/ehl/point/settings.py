"""Settings of the point-contact solver, and the sides of its domain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError

SIDES = ("ambient", "cyclic", "no_flow")
FEWEST_ROWS, MOST_ROWS = 16, 2048  # of a grid with closed sides
# weights of rho h at a face: upstream node, second node upstream, node downstream
WEDGE_WEIGHTS = {
    "upwind-1": (1.0, 0.0, 0.0),
    "upwind-2": (1.5, -0.5, 0.0),
    "central": (0.5, 0.0, 0.5),
    "quick": (0.75, -0.125, 0.375),
}


DISCRETISATIONS = ("differences", "elements")
CAVITATION = ("reynolds", "mass_conserving")


@dataclass(frozen=True, slots=True)
class Sides:
    """Side conditions of a film along y.

    Parameters
    ----------
    name : {"ambient", "cyclic", "no_flow"}
        "ambient": ambient pressure on the first and the last row. "cyclic": film and solids
        repeat beyond the domain ([jamali_2015] section 7.6). "no_flow": the solids repeat, and
        no oil passes the sides, dp/dy = 0 there ([jamali_2015] section 7.10).

    Notes
    -----
    Rows of a closed film ("cyclic" and "no_flow") lie in the middle of their cells, which fill the
    length. Its arrays, (rows + 2, nx), have a copied row before the first and one behind the last:
    of the row at the other end where the film repeats, of the row beside it where no oil passes.
    The faces of the finite volumes at both sides then see what they have to see, and the oil that
    leaves a cyclic film on one side is to the bit what enters on the other.
    """

    name: str = "ambient"

    def __post_init__(self) -> None:
        check_option("sides", self.name, SIDES)

    @property
    def closed(self) -> bool:
        """Tell whether both sides are closed by copied rows."""
        return self.name != "ambient"

    @property
    def copied(self) -> int:
        """Return the number of copied rows on each side."""
        return 1 if self.closed else 0

    def check_goes_with(
        self,
        rows: int,
        entrainment: float,
        sliding: tuple[float, float] | None,
        beyond: bool = False,
    ) -> None:
        """Refuse what does not go with closed sides.

        Parameters
        ----------
        rows
            Number of grid rows across the flow.
        entrainment
            Along y [m/s].
        sliding
            Along x and y [m/s].
        beyond
            A problem says what oil there is beyond its border or at its inlet.

        Raises
        ------
        ParameterError
        """
        if not FEWEST_ROWS <= rows <= MOST_ROWS or rows % 2:
            raise ParameterError(
                f"nodes along y must be even, within {FEWEST_ROWS} to {MOST_ROWS}, with sides "
                f"{self.name}, got {rows}. Take {max(FEWEST_ROWS, rows + rows % 2)}."
            )
        if beyond:
            raise ParameterError(
                f"oil_beyond and inlet_layer cannot be combined with sides {self.name}. Leave them "
                "out."
            )
        if entrainment != 0.0:
            raise ParameterError(
                f"entrainment along y must be 0 m/s with sides {self.name}, got {entrainment:g} "
                "m/s. Turn the axes along the entrainment."
            )
        if self.name == "no_flow" and sliding is not None and sliding[1] != 0.0:
            raise ParameterError(
                f"sliding along y must be 0 m/s where no oil may pass the sides, got "
                f"{sliding[1]:g} m/s, which drives oil through them. Take sides cyclic."
            )

    def rows(self, limits: tuple[float, float], count: int) -> Array:
        """Return the places of the rows between both limits, shape (count,), in their unit."""
        if not self.closed:
            return np.linspace(*limits, count)
        step = (limits[1] - limits[0]) / count
        return np.asarray(limits[0] + step * (np.arange(count) + 0.5))

    def intervals(self, count: int) -> int:
        """Return the number of spacings that make up the length."""
        return count if self.closed else count - 1

    def halved(self, count: int) -> int:
        """Return the number of rows of about twice the spacing."""
        return (count + 1) // 2 if self.closed else (count - 1) // 2 + 1

    def period(self, rows: int) -> int:
        """Return the rows after which a film of `rows` rows, copies included, repeats; 0: never."""
        return rows - 2 if self.name == "cyclic" else 0

    def whole(self, rows: int) -> int:
        """Return the number of rows of an array for so many rows of the film."""
        return rows + 2 * self.copied

    def own_rows(self, count: int) -> np.ndarray:
        """Return for every row of an array the row whose values it holds, shape (count,)."""
        rows = np.arange(count)
        if self.name == "cyclic":
            rows[[0, -1]] = count - 2, 1
        elif self.closed:
            rows[[0, -1]] = 1, count - 2
        return rows

    def reach(self, count: int) -> np.ndarray:
        """Return `own_rows` with one row more on each side, shape (count + 2,).

        Rows beyond a border of ambient pressure, which nothing depends on, are those of the border.
        """
        own = self.own_rows(count)
        if not self.closed:
            return np.concatenate(([0], own, [count - 1]))
        beyond = (count - 3, 2) if self.name == "cyclic" else (2, count - 3)
        return np.concatenate((beyond[:1], own, beyond[1:]))

    def inner(self, values: Array) -> Array:
        """Return an array without its copied rows, a view."""
        return values[1:-1] if self.closed else values

    def extended(self, values: Array) -> Array:
        """Return rows with copied ones on both sides; rows along the first axis."""
        if not self.closed:
            return values
        count = values.shape[0] + 2
        return np.ascontiguousarray(values[self.own_rows(count) - 1])

    def fill(self, values: Array) -> None:
        """Write the copied rows of an array."""
        if self.closed:
            first, last = (-2, 1) if self.name == "cyclic" else (1, -2)
            values[0], values[-1] = values[first], values[last]

    def fill_rises(self, slopes: Array) -> None:
        """Write the copied rows of slopes over a difference along y: turned where mirrored."""
        self.fill(slopes)
        if self.name == "no_flow":
            slopes[[0, -1]] *= -1.0

    def filled(self, values: Array) -> Array:
        """Return an array whose copied rows hold what they copy; itself where there are none."""
        if not self.closed:
            return values
        values = np.array(values)
        self.fill(values)
        return values


AMBIENT = Sides()


@dataclass(frozen=True, slots=True, kw_only=True)
class PointSolverSettings:
    """How `solve_point_contact` solves a point contact, and when it accepts the solution.

    Parameters
    ----------
    wedge
        Difference formula of d(rho h): `upwind-1`, `upwind-2`, `central` or `quick`. Elements are
        Galerkin's, with upwinding where pressure hardly moves the oil, or of first order for
        `upwind-1`.
    discretisation
        `differences` (finite volumes) or bilinear finite `elements`.
    cavitation
        `reynolds`: pressure and its gradient are zero where the film breaks, and the gap behind
        counts as full. `mass_conserving`: the oil in the broken film is computed too, after
        [jakobsson_floberg_1957] and [olsson_1965].
    tolerance
        Limit of the flow residual: the sum over all nodes of the flow that enters but does not
        leave, divided by the flow through the width of the dry contact at the central film [-].
    load_tolerance
        Limit of the relative error of the load [-].
    fall_back
        If the difference formula has no solution with a film above zero on the grid, use
        `upwind-1`; the outcome says so.
    newton_steps
        Largest number of Newton steps on one grid.
    krylov_steps
        Largest number of iterations of one linear solution.
    estimate_error
        Also solve two coarser grids, to estimate the error by the grid.

    Examples
    --------
    >>> PointSolverSettings(cavitation="mass_conserving").wedge
    'upwind-2'
    """

    wedge: str = "upwind-2"
    discretisation: str = "differences"
    cavitation: str = "reynolds"
    tolerance: float = 1e-6
    load_tolerance: float = 1e-6
    fall_back: bool = True
    newton_steps: int = 60
    krylov_steps: int = 40
    estimate_error: bool = True

    def __post_init__(self) -> None:
        check_option("wedge", self.wedge, WEDGE_WEIGHTS)
        check_option("discretisation", self.discretisation, DISCRETISATIONS)
        check_option("cavitation", self.cavitation, CAVITATION)
        if self.discretisation == "elements" and self.cavitation == "mass_conserving":
            raise ParameterError(
                "elements cannot be combined with mass-conserving cavitation, which needs fluxes "
                "between nodes. Take differences."
            )
        check_within("tolerance", self.tolerance, 1e-11, 1e-2)
        check_within("load_tolerance", self.load_tolerance, 1e-11, 1e-2)
        for name in ("newton_steps", "krylov_steps"):
            count = getattr(self, name)
            if not 1 <= count <= 1000:
                raise ParameterError(f"{name} must be within 1 to 1000, got {count}.")
