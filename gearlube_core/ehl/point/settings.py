"""Settings of the point-contact solver."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.checks import check_option, check_within
from gearlube_core.errors import ParameterError

# weights of rho h at a face: upstream node, second node upstream, node downstream
WEDGE_WEIGHTS = {
    "upwind-1": (1.0, 0.0, 0.0),
    "upwind-2": (1.5, -0.5, 0.0),
    "central": (0.5, 0.0, 0.5),
    "quick": (0.75, -0.125, 0.375),
}


DISCRETISATIONS = ("differences", "elements")
CAVITATION = ("reynolds", "mass_conserving")


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
