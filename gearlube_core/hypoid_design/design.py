"""From a blank file to machine settings: gear, pinion, and what the contact analysis says."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_contact.pair import FlankPair
from gearlube_core.hypoid_contact.refusal import check_pair
from gearlube_core.hypoid_design.blank_file import BlankFile
from gearlube_core.hypoid_design.blank_limits import check_blank
from gearlube_core.hypoid_design.chosen_relief import (
    ROLES,
    ChosenRelief,
    chosen_relief,
    relief_fields,
)
from gearlube_core.hypoid_design.designed_blank import DesignedBlank
from gearlube_core.hypoid_design.flank_target import (
    FlankTarget,
    MeanContact,
    MeasuredContact,
    measured_contact,
)
from gearlube_core.hypoid_design.pinion_fit import SIDES, Fit, fit_pinion
from gearlube_core.hypoid_design.start_settings import start_pair
from gearlube_core.hypoid_geometry.flank.flank import Side
from gearlube_core.hypoid_geometry.gear_file import HypoidGearFile
from gearlube_core.progress import Progress, no_progress, part_of
from gearlube_core.storage.process_pool import on_one_thread
from gearlube_core.units import DEGREE, MILLIMETRE

# of a path that the file leaves open, from across the lines of contact: the next where one fails
CHOSEN_TURNS = tuple(math.tan(angle * DEGREE) for angle in (44.0, 30.0, 15.0))
ROUNDS = 6  # fits, each with targets corrected by what the analysis found
_NEAR = 0.1  # sum of squares of what a side misses, in parts of what a design may miss
_FAILED = 1.0
_FITTED, _RELIEVED = 0.1, 0.9  # shares of the time before relief and after it
MICRORADIAN = 1e-6

Measured = MeasuredContact | str


@dataclass(frozen=True, slots=True, kw_only=True)
class Design:
    """A designed pair.

    Parameters
    ----------
    designed : DesignedBlank
    file : HypoidGearFile
        As `gearlube contact` takes it.
    targets : dict of str to FlankTarget
        What was asked of both sides.
    measured : dict of str to MeasuredContact or str
        What the contact analysis finds of the flanks as cut; a sentence where a side has no
        parabolic error.
    relieved : dict of str to MeasuredContact or str
        The same with relief.
    relief : ChosenRelief
    fit : Fit
    warnings : tuple of str
        Warnings about the gear blank.
    """

    designed: DesignedBlank
    file: HypoidGearFile
    targets: dict[Side, FlankTarget]
    measured: dict[Side, Measured]
    relieved: dict[Side, Measured]
    relief: ChosenRelief
    fit: Fit
    warnings: tuple[str, ...]

    @property
    def as_cut(self) -> HypoidGearFile:
        """The gear file without relief: the flanks of which the targets are asked."""
        flanks = [f"{role}.{side}_flank" for role in ("pinion", "gear") for side in SIDES]
        kept = tuple(one for one in self.file.completed if not one.startswith(tuple(flanks)))
        return self.file.varied(dict.fromkeys(flanks, None) | {"completed": kept})


@on_one_thread
def design_pair(file: BlankFile, progress: Progress = no_progress, jobs: int | None = 1) -> Design:
    """Return the machine settings of a pair whose contact comes nearest to what the file asks.

    The gear is cut on the blank. The pinion starts as the image of a form-cut gear, which is
    conjugate to it,
    and its settings are fitted so that both flanks stand off as asked. The unloaded contact
    analysis then judges; what it finds too much or too little is taken off the targets, and the
    fit goes on from there. Relief comes last, as `chosen_relief` says.

    Parameters
    ----------
    file : BlankFile
    progress : callable, optional
        Called with the share that is done [-] and a sentence on what runs.
    jobs : int, optional
        Processes for the elastic teeth, which the relief needs; None: all processors.

    Raises
    ------
    ParameterError
        When the blank cannot exist, the contact lies outside of the mesh, or no settings were
        found with which both flanks touch; the sentence says how near it came.
    """
    progress(0.0, "pitch cones and blank")
    designed = DesignedBlank.from_file(file)
    warnings = check_blank(designed)
    start = start_pair(designed)
    free = {
        "drive": file.contact.drive_path_angle_deg is None,
        "coast": file.contact.coast_path_angle_deg is None,
    }
    turns: dict[Side, int] = dict.fromkeys(SIDES, 0)
    attempts: list[Attempt] = []
    for number in range(len(CHOSEN_TURNS)):
        targets = wanted_targets(designed, start, turns)
        shares = (_FITTED * (number + one) / len(CHOSEN_TURNS) for one in (0, 1))
        attempt = nearest_fit(designed, start, targets, part_of(progress, *shares))
        attempts.append(attempt)
        failed = [side for side in SIDES if attempt.far[side] > _FAILED and free[side]]
        if not failed:
            break
        for side in failed:
            turns[side] += 1
    best = min(attempts, key=_missed)
    _check(best.fit, file.machine.denied)
    fitted = rounded_file(best.fit.file)
    relief = chosen_relief(designed, fitted, part_of(progress, _FITTED, _RELIEVED), jobs)
    found = named_file(designed, fitted, relief)
    progress(_RELIEVED, "checking teeth and contact")
    return Design(
        designed=designed,
        file=found,
        targets=best.targets,
        measured=best.measured,
        relieved={side: measured_contact(found, side) for side in SIDES},
        relief=relief,
        fit=best.fit,
        warnings=tuple(warnings),
    )


@dataclass(frozen=True, slots=True)
class Attempt:
    """Nearest design to one choice of targets.

    Parameters
    ----------
    targets : dict of str to FlankTarget
    fit : Fit
    measured : dict of str to MeasuredContact or str
    far : dict of str to float
        What each side misses, squares in parts of what a design may miss [-]; 100 without a
        parabolic error.
    """

    targets: dict[Side, FlankTarget]
    fit: Fit
    measured: dict[Side, Measured]
    far: dict[Side, float]


def nearest_fit(
    designed: DesignedBlank,
    start: HypoidGearFile,
    targets: dict[Side, FlankTarget],
    progress: Progress = no_progress,
) -> Attempt:
    """Return the best of several fits, each with targets corrected by what the last one missed.

    Parameters
    ----------
    designed : DesignedBlank
    start : HypoidGearFile
        From `start_pair`.
    targets : dict of str to FlankTarget
        Of both sides; each may have its own place and ellipse.
    progress : callable, optional
    """
    asked, first = targets, None
    rounds: list[Attempt] = []
    for number in range(ROUNDS):
        progress((number + 0.1) / ROUNDS, f"pinion settings, round {number + 1}")
        try:
            fit = fit_pinion(start, asked, freedoms=designed.file.machine, first=first)
        except ParameterError:
            if not rounds:
                raise
            break  # corrections went beyond what a path can be; the nearest round stands
        progress((number + 0.7) / ROUNDS, "unloaded contact")
        measured = {side: measured_contact(fit.file, side) for side in SIDES}
        far = {side: _far(targets[side], measured[side], designed) for side in SIDES}
        rounds.append(Attempt(targets, fit, measured, far))
        if max(far.values()) < _NEAR:
            break
        asked = {side: corrected(targets[side], asked[side], measured[side]) for side in SIDES}
        first = fit.moves
    return min(rounds, key=_missed)


def _missed(attempt: Attempt) -> float:
    return sum(attempt.far.values())


def wanted_targets(
    designed: DesignedBlank, start: HypoidGearFile, turns: dict[Side, int]
) -> dict[Side, FlankTarget]:
    """Return what the blank file asks of both sides, with what it leaves open chosen.

    `turns` says which of `CHOSEN_TURNS` a side gets whose path is left open.
    """
    wanted, blank = designed.file.contact, designed.blank
    length = wanted.ellipse_length_mm
    middle = (blank.root_clearance + 0.5 * blank.working_depth) / blank.whole_depth
    s = middle if wanted.profile_position is None else wanted.profile_position
    targets: dict[Side, FlankTarget] = {}
    for side, error, angle in (
        ("drive", wanted.drive_error_urad, wanted.drive_path_angle_deg),
        ("coast", wanted.coast_error_urad, wanted.coast_path_angle_deg),
    ):
        mean = MeanContact.at(FlankPair.from_file(start, side), s, wanted.face_position)  # type: ignore[arg-type]
        targets[side] = FlankTarget(  # type: ignore[index]
            s=s,
            t=wanted.face_position,
            error=error * MICRORADIAN,
            length=designed.gear_face.total / 3.0 if length is None else length * MILLIMETRE,
            path_angle=mean.path_angle(CHOSEN_TURNS[turns[side]])  # type: ignore[index]
            if angle is None
            else angle * DEGREE,
        )
    return targets


def corrected(wanted: FlankTarget, asked: FlankTarget, found: Measured) -> FlankTarget:
    """Return the target to ask for next: moved by what the contact missed of the wanted one."""
    if isinstance(found, str):
        # no extreme on the teeth: a larger error brings it there
        return replace(asked, error=1.3 * asked.error)
    turned = _between(wanted.path_angle, found.path_angle)
    return replace(
        asked,
        s=_held(asked.s + wanted.s - found.s, wanted.s),
        t=_held(asked.t + wanted.t - found.t, wanted.t),
        error=asked.error * float(np.clip(wanted.error / found.error, 0.5, 2.0)),
        path_angle=asked.path_angle + float(np.clip(turned, -0.15, 0.15)),
    )


def _held(value: float, near: float) -> float:
    return min(max(value, near - 0.12), near + 0.12)


def _between(wanted: float, found: float) -> float:
    """Return the turn [rad] from one direction of a line to another, -pi/2 to pi/2."""
    return (wanted - found + 0.5 * math.pi) % math.pi - 0.5 * math.pi


def misses(target: FlankTarget, found: MeasuredContact, designed: DesignedBlank) -> Array:
    """Return the misses of the contact: error [-], path direction [rad], centre [m], length [-]."""
    depth, width = designed.blank.whole_depth, designed.gear_face.total
    centre = math.hypot((found.s - target.s) * depth, (found.t - target.t) * width)
    return np.array(
        [
            found.error / target.error - 1.0,
            _between(found.path_angle, target.path_angle),
            centre,
            found.length / target.length - 1.0,
        ]
    )


def _far(target: FlankTarget, found: Measured, designed: DesignedBlank) -> float:
    if isinstance(found, str):
        return 100.0
    sizes = np.array([0.1, 2.0 * DEGREE, 0.5 * MILLIMETRE])
    return float(np.sum((misses(target, found, designed)[:3] / sizes) ** 2))


def named_file(
    designed: DesignedBlank, file: HypoidGearFile, relief: ChosenRelief
) -> HypoidGearFile:
    """Return the gear file with the origin of every number: the blank implied, the rest chosen."""
    data = file.model_dump(exclude_defaults=True)
    data["pair"]["pinion_hand"] = designed.file.pair.pinion_hand
    for role in ROLES:
        for side in SIDES:
            fields = relief_fields(designed, role, relief.amounts[side])
            data[role] |= {f"{side}_flank": fields} if fields else {}
    implied, chosen = [], []
    for role in ROLES:
        for key, value in data[role].items():
            if isinstance(value, dict):
                chosen += [f"{role}.{key}.{name}" for name in value]
            elif key != "teeth":
                implied.append(f"{role}.{key}")
    given = {"pinion.cutter.blade_groups", "gear.cutter.blade_groups"}
    data["inferred"] = ["pair.clearance_mm", *implied]
    data["completed"] = [name for name in chosen if name not in given]
    return HypoidGearFile.from_data(_rounded(data), f"The design of {designed.file.name}")


def rounded_file(file: HypoidGearFile) -> HypoidGearFile:
    """Return a gear file with the numbers that a written one shows."""
    return HypoidGearFile.from_data(_rounded(file.model_dump(exclude_defaults=True)), file.name)


def _rounded(value: Any) -> Any:
    """Return numbers as a file shows them: a tenth of a nanometre, a millionth of a degree."""
    if isinstance(value, dict):
        return {key: _rounded(one) for key, one in value.items()}
    return round(value, 7) if isinstance(value, float) else value


def _check(fit: Fit, denied: str) -> None:
    try:
        check_pair(fit.file)
    except ParameterError as reason:
        near = ", ".join(f"{side} {1e6 * fit.rms[side]:.1f} um" for side in SIDES)
        raise ParameterError(
            f"No machine settings were found with which both flanks touch as asked; the gaps came "
            f"within {near} (rms) of the wanted ones. {reason} Ask for a larger "
            "contact.drive_error_urad or coast_error_urad, or a path nearer to that across the "
            "lines of contact (drive_path_angle_deg, coast_path_angle_deg)"
            f"{f', or allow {denied}' if denied else ''}."
        ) from None
