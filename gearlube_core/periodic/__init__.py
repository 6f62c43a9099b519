"""Periodic motions of any dynamic model: shooting, continuation, stability."""

from gearlube_core.periodic.branch import Branch, BranchStart, SpecialPoint, switch_branch
from gearlube_core.periodic.continuation import ContinuationSettings, follow
from gearlube_core.periodic.floquet import floquet_multipliers, stability_margin
from gearlube_core.periodic.newton import NewtonSettings
from gearlube_core.periodic.problem import PeriodicProblem, fixed_point_residual
from gearlube_core.periodic.shooting import PeriodicMotion, solve_periodic

__all__ = [
    "Branch",
    "BranchStart",
    "ContinuationSettings",
    "NewtonSettings",
    "PeriodicMotion",
    "PeriodicProblem",
    "SpecialPoint",
    "fixed_point_residual",
    "floquet_multipliers",
    "follow",
    "solve_periodic",
    "stability_margin",
    "switch_branch",
]
