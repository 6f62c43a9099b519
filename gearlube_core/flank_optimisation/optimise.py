"""Better flanks of a pair: search, front of whine against loss, check by the plain analysis."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.flank_optimisation.held_model import CheckSettings, HeldModel, Teeth, plain_check
from gearlube_core.flank_optimisation.held_position import Evaluation
from gearlube_core.flank_optimisation.problem import GearFile, Problem
from gearlube_core.flank_optimisation.problem_file import Limits
from gearlube_core.flank_optimisation.search import (
    KEPT,
    Found,
    Goal,
    Round,
    SearchSettings,
    best_in_box,
    search,
)
from gearlube_core.helical_contact.tooth_body import HelicalBodySettings
from gearlube_core.helical_contact.tooth_body import pair_stiffness as helical_stiffness
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.hypoid_contact.tooth_body import pair_stiffness as hypoid_stiffness
from gearlube_core.progress import Progress, no_progress
from gearlube_core.tooth_compliance.tooth_body import ToothBodySettings

EVALUATIONS, POSITIONS = "evaluations", "positions"  # folders of what is kept
_FRONT_STEPS = 3  # of one point of the front, each as long as the region of a round


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimiseSettings:
    """Scope and resolution of `run_optimise`.

    Parameters
    ----------
    search : SearchSettings
    check : CheckSettings
    checks : int
        Largest number of searches. After each one the full analysis checks the limits; limits that
        are not kept are tightened for the next search.
    front : int
        Number of points on the front of whine against loss; 0: none.
    nominal : bool
        Whether the best pair without errors is searched too, for comparison.
    body : ToothBodySettings
        Elastic teeth of a hypoid pair.
    helical_body : HelicalBodySettings
        Elastic teeth of a helical pair.

    Examples
    --------
    >>> OptimiseSettings(front=5).search.rounds
    6
    """

    search: SearchSettings = field(default_factory=SearchSettings)
    check: CheckSettings = field(default_factory=CheckSettings)
    checks: int = 3
    front: int = 0
    nominal: bool = False
    body: ToothBodySettings = field(default_factory=ToothBodySettings)
    helical_body: HelicalBodySettings = field(default_factory=HelicalBodySettings)


@dataclass(frozen=True, slots=True)
class FrontPoint:
    """One point of the front: whine and loss over those before [-], on held cells."""

    values: Array
    whine: float
    loss: float


@dataclass(frozen=True, slots=True)
class Better:
    """A better pair.

    Parameters
    ----------
    file : HypoidGearFile or HelicalGearFile
    values : ndarray of shape (P,)
        Of the parameters, as the file has them [unit of each].
    checked : Evaluation
        By the plain analysis.
    rounds : tuple of Round
        Of the search.
    """

    file: GearFile
    values: Array
    checked: Evaluation
    rounds: tuple[Round, ...]


@dataclass(frozen=True, slots=True)
class Optimised:
    """Result of an optimisation.

    Parameters
    ----------
    problem : Problem
    before : Evaluation
        The pair as it is, by the plain analysis.
    better : Better
    nominal : Better or None
        Best without errors; judged with them.
    front : tuple of FrontPoint
        By falling whine.
    """

    problem: Problem
    before: Evaluation
    better: Better
    nominal: Better | None
    front: tuple[FrontPoint, ...]


def optimise(
    problem: Problem,
    settings: OptimiseSettings | None = None,
    *,
    folder: Path | None = None,
    cache: Path | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> Optimised:
    """Return a pair with lower mesh orders of the loaded transmission error, and how it compares.

    Parameters
    ----------
    problem : Problem
    settings : OptimiseSettings, optional
    folder : Path, optional
        Keeps evaluations and positions, so that an interrupted call goes on.
    cache : Path, optional
        Folder of tooth compliances; default: the user's cache.
    jobs : int, optional
        Processes of teeth and check; default: all processors.
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.

    Raises
    ------
    ConvergenceError
        The pair as it is, or at the start of the search, finds no equilibrium.

    Examples
    --------
    >>> from gearlube_core.flank_optimisation.problem_file import OptimisationFile
    >>> problem = Problem.of(OptimisationFile.named("helical"))
    >>> optimise(problem).better.values  # doctest: +SKIP
    """
    settings = settings or OptimiseSettings()
    progress(0.0, "elastic teeth (kept for the next run)")
    stiffness = _stiffness(problem, settings, cache, jobs)
    evaluations = None if folder is None else folder / EVALUATIONS

    def checked(file: GearFile, begin: float) -> Evaluation:
        return plain_check(
            problem,
            file,
            stiffness,
            settings.check,
            folder=None if folder is None else folder / POSITIONS,
            jobs=jobs,
            progress=_part(progress, begin, begin + 0.1),
        )

    def better(one: Found, begin: float) -> Better:
        values = problem.rounded(one.values)
        file = problem.changed(values)
        return Better(file, values, checked(file, begin), one.rounds)

    before = checked(problem.file, 0.0)
    limits = problem.given.limits

    def searched(start: Array, begin: float) -> Found:
        part = _part(progress, begin, begin + 0.1)
        return _search(problem, stiffness, settings.search, evaluations, part, start, limits)

    found = last_found = searched(problem.start, 0.1)
    best = last = better(found, 0.2)
    for attempt in range(1, settings.checks):
        tighter = _tightened(problem, before, last, limits)
        if tighter is None:
            break
        limits = tighter
        last_found = searched(last_found.values, 0.1 + 0.1 * attempt)
        last = better(last_found, 0.2 + 0.1 * attempt)
        if _rank(problem, before, last) < _rank(problem, before, best):
            best, found = last, last_found
    nominal = None
    if settings.nominal and len(problem.scenarios) > 1:
        alone = replace(problem, scenarios=problem.scenarios[:1])
        part = _part(progress, 0.6, 0.7)
        only = _search(alone, stiffness, settings.search, evaluations, part, found.values, limits)
        nominal = better(only, 0.7)
    part = _part(progress, 0.8, 1.0)
    front = _front(problem, stiffness, settings, evaluations, found, limits, part)
    return Optimised(problem, before, best, nominal, front)


def _tightened(
    problem: Problem, before: Evaluation, tried: Better, limits: Limits
) -> Limits | None:
    """Return tighter limits where the plain analysis finds some broken; None: all are kept."""
    asked, after = problem.given.limits, tried.checked
    orders = problem.given.orders
    spread = before.spread(orders)
    over = {
        "pressure": after.highest_pressure / before.highest_pressure,
        "loss": after.mean_sliding / before.mean_sliding,
        "edge_share": after.largest_edge_share,
        "other_side_pressure": after.highest_other_pressure / before.highest_other_pressure,
        "other_side_edge_share": after.largest_other_edge_share,
        "force_swing": after.swing(orders)[0] / np.maximum(before.swing(orders)[0], 1e-12),
        "sensitivity": after.spread(orders) / spread if spread.all() else np.zeros(1),
    }
    changed = {}
    for name, reached in over.items():
        most = getattr(asked, name)
        if most is not None and reached.max(initial=0.0) > most * KEPT:
            changed[name] = getattr(limits, name) * most / float(reached.max())
    return limits.model_copy(update=changed) if changed else None


def _rank(problem: Problem, before: Evaluation, one: Better) -> tuple[bool, float]:
    """Return by what pairs are chosen, least is best, by the plain analysis.

    Whether a limit is broken, then the mean square of the mesh orders with a price for that.
    """
    given = problem.given
    goal = _goal(problem, before, given.limits)
    over = float(np.maximum(goal.used(one.checked)[0] - KEPT, 0.0).max(initial=0.0))
    return over > 0.0, goal.highest(one.checked) + 5.0 * over


def _stiffness(
    problem: Problem, settings: OptimiseSettings, cache: Path | None, jobs: int | None
) -> Teeth:
    file = problem.file
    if isinstance(file, HelicalGearFile):
        pair = file.helical_pair()
        both = helical_stiffness(pair, settings.helical_body, cache=cache, jobs=jobs)
        return {"drive": both, "coast": both}
    return hypoid_stiffness(file, settings.body, cache=cache, jobs=jobs)


def _search(
    problem: Problem,
    stiffness: Teeth,
    settings: SearchSettings,
    folder: Path | None,
    progress: Progress,
    start: Array,
    limits: Limits,
) -> Found:
    before = HeldModel(problem, stiffness, None, folder).evaluate(None)
    return search(
        lambda values: HeldModel(problem, stiffness, values, folder),
        _goal(problem, before, limits),
        (problem.low, problem.high),
        start,
        settings,
        lambda number, sentence: progress(
            (number - 1) / settings.rounds, f"search, round {number}, {sentence}"
        ),
    )


def _goal(problem: Problem, before: Evaluation, limits: Limits) -> Goal:
    given = problem.given
    return Goal(before=before, orders=given.orders, worst=given.aim == "worst", limits=limits)


def _front(
    problem: Problem,
    stiffness: Teeth,
    settings: OptimiseSettings,
    folder: Path | None,
    best: Found,
    limits: Limits,
    progress: Progress,
) -> tuple[FrontPoint, ...]:
    """Return the least loss under limits of whine between that before and the least.

    Of all that the searches met on cells held at the best pair: losses often differ by per cents,
    and a pair of less loss needs no cells of its own to be one of the front. Where the way to it
    ends at the region of a round, cells are cut again there and the search goes on.
    """
    if settings.front < 2:
        return ()
    before = HeldModel(problem, stiffness, None, folder).evaluate(None)
    goal = _goal(problem, before, limits)
    least = float(goal.squares(best.evaluation)[0].mean())
    most = np.geomspace(max(least, 1e-4), 1.0, settings.front)
    low, high = problem.low, problem.high
    reach = settings.search.region * (high - low)
    at, seen = best.values, list[tuple[Array, Evaluation]]()
    model = _Recorded(HeldModel(problem, stiffness, at, folder), seen)
    for k, square in enumerate(most[1:].tolist()):
        progress(k / most.size, f"front of whine against loss, {k + 1} of {most.size - 1}")
        asked = replace(goal, loss=True, most_square=square)
        for _ in range(_FRONT_STEPS):
            box = np.maximum(low, at - reach), np.minimum(high, at + reach)
            tried = best_in_box(model, asked, at, box, low, high, settings.search)
            at_low = (box[0] > low) & (tried - box[0] < 1e-3 * reach)
            at_high = (box[1] < high) & (box[1] - tried < 1e-3 * reach)
            if not np.any(at_low | at_high):
                break
            at = tried
            model = _Recorded(HeldModel(problem, stiffness, at, folder), seen)
    kept = [
        _point(goal, at, found)
        for at, found in seen
        if float(goal.used(found)[0].max(initial=0.0)) <= KEPT
    ]
    points = [_point(goal, best.values, best.evaluation)]
    for square in most[1:].tolist():
        points.append(
            min((one for one in (*points, *kept) if one.whine**2 <= square), key=_loss_of)
        )
    front: list[FrontPoint] = []
    for one in reversed(points):
        beaten = any(_no_better(one, other) for other in points)
        known = any(_same(one, other) for other in front)
        if not (beaten or known):
            front.append(one)
    return tuple(front)


@dataclass(frozen=True, slots=True)
class _Recorded:
    """A pair with held cells, and all that was evaluated on them."""

    held: HeldModel
    seen: list[tuple[Array, Evaluation]]

    def evaluate(self, values: Array) -> Evaluation:
        found = self.held.evaluate(values)
        self.seen.append((np.array(values), found))
        return found


def _same(one: FrontPoint, other: FrontPoint) -> bool:
    return max(abs(one.whine - other.whine), abs(one.loss - other.loss)) < 1e-3


def _no_better(one: FrontPoint, other: FrontPoint) -> bool:
    """Return whether another point is as good in both and better in one, by more than 1e-3."""
    gain = one.whine - other.whine, one.loss - other.loss
    return min(gain) > -1e-6 and max(gain) > 1e-3


def _loss_of(one: FrontPoint) -> float:
    return one.loss


def _point(goal: Goal, values: Array, found: Evaluation) -> FrontPoint:
    square = float(goal.squares(found)[0].mean())
    return FrontPoint(values, square**0.5, replace(goal, loss=True).aim(found)[0])


def _part(progress: Progress, begin: float, end: float) -> Progress:
    return lambda share, sentence: progress(begin + (end - begin) * min(share, 1.0), sentence)
