"""The solutions of a resonance study: all models, motions and flank contacts, in stages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np

from gearlube.studies.resonance.flank_cycle import (
    FlankCycle,
    TractionCurve,
    flank_cycle,
    traction_curve,
)
from gearlube.studies.resonance.response import (
    ORBIT_STEPS,
    Motion,
    PoincareSection,
    Response,
    follow_response,
    motion_near,
    motions_at,
    poincare_section,
    richest_frequency,
)
from gearlube.studies.resonance.settings import HOT, MODELS, SWEPT, ResonanceSettings
from gearlube_core.dynamics.hypoid_torsional.period_problem import PeriodProblem
from gearlube_core.dynamics.hypoid_torsional.time_sweep import Direction, TimeSweep, time_sweep
from gearlube_core.progress import Progress, no_progress

SWEEP_STEPS = 256
DIRECTIONS: tuple[Direction, Direction] = ("up", "down")


# running time of the lubricated response over that of a dry one
_LUBRICATED_COST = 8.0


@dataclass(slots=True, kw_only=True)
class ResonanceStudy:
    """Results of a study; parts that a stopped study did not reach are empty.

    Parameters
    ----------
    settings : ResonanceSettings
    responses : dict of str to Response
        By model, see `MODELS`.
    sweeps : dict of (str, str) to TimeSweep
        By model and direction.
    motions : list of Motion
        At the frequencies of `settings.orbits_at`.
    section : PoincareSection, optional
        Of the dry 2-DOF model.
    cycles : list of FlankCycle
    curves : list of TractionCurve
        One per cycle.
    interrupted : bool
        Whether it was stopped by KeyboardInterrupt.
    """

    settings: ResonanceSettings
    responses: dict[str, Response] = field(default_factory=dict)
    sweeps: dict[tuple[str, Direction], TimeSweep] = field(default_factory=dict)
    motions: list[Motion] = field(default_factory=list)
    section: PoincareSection | None = None
    cycles: list[FlankCycle] = field(default_factory=list)
    curves: list[TractionCurve] = field(default_factory=list)
    interrupted: bool = False


class _Stopped(Exception):  # noqa: N818
    """A branch was cut short by the user."""


def study_resonance(
    settings: ResonanceSettings, progress: Progress = no_progress
) -> ResonanceStudy:
    """Run a study; on KeyboardInterrupt return the results so far.

    Parameters
    ----------
    settings : ResonanceSettings
    progress : callable, optional
        Called with the share that is done [-] and what runs.

    Raises
    ------
    ConvergenceError
        No periodic motion was found at an end of the range.
    StepError
        A time sweep was no longer finite.
    """
    study = ResonanceStudy(settings=settings)
    stages = _stages(study)
    total, before = sum(stage.cost for stage in stages), 0.0
    try:
        for stage in stages:

            def observe(share: float, stage: _Stage = stage, before: float = before) -> None:
                progress((before + share * stage.cost) / total, stage.name)

            observe(0.0)
            stage.run(observe)
            before += stage.cost
        progress(1.0, "done")
    except (KeyboardInterrupt, _Stopped):
        study.interrupted = True
    return study


class _Stage(NamedTuple):
    name: str
    cost: float  # running time over that of a dry response
    run: Callable[[Callable[[float], None]], None]


def _stages(study: ResonanceStudy) -> list[_Stage]:
    settings = study.settings
    stages = []
    for model in settings.models:
        cost = _LUBRICATED_COST if model == "two_dof_lubricated" else 1.0
        stages.append(_Stage(f"{MODELS[model]}: branches", cost, partial(_respond, study, model)))
        if model in SWEPT and settings.sweep_frequencies > 0:
            stages.append(
                _Stage(f"{MODELS[model]}: time sweeps", 1.0, partial(_sweep, study, model))
            )
    stages.append(_Stage("motions", 1.0, partial(_keep_motions, study)))
    if settings.section_starts > 0:
        stages.append(_Stage("Poincare section", 0.5, partial(_cut, study)))
    if settings.friction != "off":
        stages.append(_Stage("flank contacts", 1.0, partial(_flanks, study)))
    return stages


def _respond(study: ResonanceStudy, model: str, observe: Callable[[float], None]) -> None:
    response = Response(model=model)
    try:
        # with friction a doubling lies where it does without: followed once, without
        doubled = model != "two_dof_lubricated"
        follow_response(response, study.settings, doubled=doubled, progress=observe)
    finally:
        if response.segments:
            study.responses[model] = response
    if response.interrupted:
        raise _Stopped


def _sweep(study: ResonanceStudy, model: str, observe: Callable[[float], None]) -> None:
    settings = study.settings
    frequencies = study.responses[model].natural_frequency * np.linspace(
        settings.first, settings.last, settings.sweep_frequencies
    )
    for done, direction in enumerate(DIRECTIONS):
        observe(0.5 * done)
        study.sweeps[model, direction] = time_sweep(
            settings.parameters(model),
            frequencies,
            direction,
            steps_per_mesh_period=SWEEP_STEPS,
        )


def _keep_motions(study: ResonanceStudy, observe: Callable[[float], None]) -> None:
    for response in study.responses.values():
        for relative in study.settings.orbits_at:
            study.motions += motions_at(response, study.settings, relative)
        observe(0.5)


def _cut(study: ResonanceStudy, observe: Callable[[float], None]) -> None:
    response = study.responses["two_dof"]
    relative = richest_frequency(response, study.settings)
    section = poincare_section(response, study.settings, relative)
    if section.x.size and section.motions:
        study.section = section
    observe(1.0)


def _flanks(study: ResonanceStudy, observe: Callable[[float], None]) -> None:
    settings = study.settings
    wanted = [(relative, settings.oil_temperature) for relative in (0.3, 1.0)]
    wanted.append((0.3, HOT))
    for done, (relative, temperature) in enumerate(wanted):
        observe(done / len(wanted))
        motion = _running(study, relative)
        if motion is None:
            continue
        parameters = settings.parameters("two_dof_lubricated", temperature)
        if temperature != settings.oil_temperature:
            problem = PeriodProblem(parameters, steps_per_mesh_period=ORBIT_STEPS)
            motion = motion_near(motion.model, problem, motion.unknowns, relative)
        if motion is not None:
            cycle = flank_cycle(motion, parameters)
            study.cycles.append(cycle)
            study.curves.append(traction_curve(cycle))


def _running(study: ResonanceStudy, relative: float) -> Motion | None:
    """Return the largest stable lubricated motion of one mesh period at a frequency."""
    found = [
        motion
        for motion in study.motions
        if motion.model == "two_dof_lubricated"
        and motion.relative == relative
        and motion.stable
        and motion.problem.periods == 1
    ]
    return max(found, key=lambda motion: motion.peak_to_peak, default=None)
