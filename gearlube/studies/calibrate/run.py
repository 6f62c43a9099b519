"""Calibration of an axle: runs of its model, an emulator of them, the posterior of its inputs."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import qmc

from gearlube.studies.calibrate.posterior import Posterior, Problem, fitted, predicted_again
from gearlube_core import __version__
from gearlube_core.arrays import Array
from gearlube_core.checks import check_within
from gearlube_core.dynamics.hypoid_axle.losses import FAILURES, LOSS_SOURCES, axle_losses
from gearlube_core.dynamics.hypoid_axle.uncertain import Uncertain, changed_axle, uncertain_of
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.errors import ParameterError
from gearlube_core.input_file.measurements import Measurements
from gearlube_core.progress import Progress, no_progress
from gearlube_core.storage.resumable import ARRAYS, ResultStore
from gearlube_core.units import celsius_to_kelvin, rpm_to_rads

FEWEST = 6  # points
HELD = 4  # one point of so many is held out for the check
_ANGLES = 8  # of a mesh period, as for the error bars of a loss map
_EDGE = 2.5  # standard deviations of the prior, to which the model is run
_EXACT = 1e-4  # of the largest loss, to which no point is known better
_LEAST = 1e-6  # share of the loss, below which a group of losses counts as this
_CHECKED = 12  # draws of the posterior that the model itself repeats
_ROUNDS = 3
BIAS = 1.0 / 3.0  # of the posterior's spread, that the emulator may be off


@dataclass(frozen=True, kw_only=True)
class CalibrationSettings:
    """Axle, measured losses, and how far both may be wrong.

    Parameters
    ----------
    axle : HypoidAxleParameters
    measured : Measurements
        Of the kind "axle_loss".
    inputs : tuple of str
        Names of `uncertain_of` the axle.
    gain, offset, model_error : float
        Standard deviations of errors that points have in common: of the gain of the torque
        sensor [-], of its zero [N.m], and of the model [-], the same at near torques.
    runs : int, optional
        Of the model, 1 to 4096. Default: twice the coefficients of the emulator, 16 at least.
    seed : int
    """

    axle: HypoidAxleParameters
    measured: Measurements
    inputs: tuple[str, ...]
    gain: float = 0.03
    offset: float = 0.2
    model_error: float = 0.05
    runs: int | None = None
    seed: int = 1

    def __post_init__(self) -> None:
        known = [one.name for one in uncertain_of(self.axle)]
        unknown = [name for name in self.inputs if name not in known]
        if unknown or not self.inputs or len(set(self.inputs)) < len(self.inputs):
            raise ParameterError(
                f"--input must name uncertain inputs of this axle, each once: {', '.join(known)}; "
                f"got {', '.join(self.inputs) or 'none'}."
            )
        if self.measured.kind != "axle_loss":
            raise ParameterError(
                f"{self.measured.path} must have loss torques of an axle, torque_loss_n_m or "
                "efficiency_percent, got others. `gearlube compare` takes those."
            )
        needed = max(FEWEST, -(-HELD * (len(self.inputs) + 1) // (HELD - 1)))
        if self.measured.value.size < needed:
            raise ParameterError(
                f"{self.measured.path} must have at least {needed} points for "
                f"{len(self.inputs)} inputs, got {self.measured.value.size}: a quarter is held "
                "out, and the others must be more than the inputs. Give fewer --input, or measure "
                "more."
            )
        check_within("--gain", 100.0 * self.gain, 0.0, 50.0, "%", "3 % is usual.")
        check_within("--offset", self.offset, 0.0, 1e3, "N.m", "0.1 to 1 N.m is usual.")
        check_within("--model-error", 100.0 * self.model_error, 0.0, 50.0, "%", "5 % is usual.")
        if self.runs is not None:
            check_within("--runs", self.runs, 1, 4096, "", "Leave it out for a usual number.")

    @property
    def uncertain(self) -> tuple[Uncertain, ...]:
        """The inputs, with the factors that are their priors."""
        known = {one.name: one for one in uncertain_of(self.axle)}
        return tuple(known[name] for name in self.inputs)


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """An axle's inputs after measurements; arrays over the points, loss torques in N.m."""

    settings: CalibrationSettings
    emulator_error: Array  # relative, of what stands for the axle in the fit
    posterior: Posterior  # of all points
    before: Array  # loss torque of the model with the inputs before
    after: Array  # at their mean after
    low: Array  # 95 % of the draws are between these
    high: Array
    bias: float  # of the emulator at draws, over their spread; largest of the points
    inside: float  # share of the held-out points within the band of 90 % that the others predict
    held: int  # number of held-out points


def run_calibration(
    settings: CalibrationSettings, *, folder: Path | None = None, progress: Progress = no_progress
) -> Calibration:
    """Return the inputs of an axle after measured losses.

    Parameters
    ----------
    settings
    folder
        Keeps each run of the model, so that a run that was stopped goes on; None: none is kept.
    progress
        Called with the share that is done and a sentence.

    Raises
    ------
    ParameterError
        A point is outside the range of the axle, or has no solution; an input leaves its limits.
    """
    uncertain, store = settings.uncertain, ResultStore(folder and folder / "runs", ARRAYS)
    moving = np.array([k for k, one in enumerate(uncertain) if one.changed is not None], dtype=int)
    _check_ends(settings)
    places = _design(settings, moving.size)

    conditions = [one.tobytes() for one in settings.measured.conditions.values()]

    def run(place: Array) -> Array:
        inputs = np.zeros(len(uncertain))
        inputs[moving] = place
        axle = axle_at(settings, inputs)[0]
        key = hashlib.sha256(pickle.dumps((__version__, axle, conditions))).hexdigest()
        found = store.read(key)
        if found is None:
            found = {"torque": loss_torques(axle, settings.measured)}
            store.keep(key, found)
        return found["torque"]

    def runs(places: Array) -> Array:
        found = []
        for k, place in enumerate(places):
            progress(0.9 * k / len(places), f"run {k + 1} of {len(places)} of the axle")
            found.append(run(place))
        return np.array(found)

    losses, rng = runs(places), np.random.default_rng(settings.seed)
    for _ in range(_ROUNDS):
        predict, error = _emulator(uncertain, moving, places, losses)
        problem = _problem(settings, predict, error)
        posterior = fitted(problem, settings.seed)
        values = predict(posterior.draws)
        bias = 0.0
        if moving.size == 0:
            break
        chosen = rng.choice(posterior.draws, _CHECKED, replace=False).clip(-_EDGE, _EDGE)
        solved = runs(chosen[:, moving])
        groups, scales = _of_groups(uncertain, solved)
        exact = np.einsum("ngm,ng->nm", groups, np.exp(chosen @ scales))
        off = np.abs(np.mean(predict(chosen) - exact, axis=0))
        bias = float(np.max(off / np.maximum(values.std(axis=0), _LEAST * values.mean(axis=0))))
        if bias < BIAS:
            break
        places = np.vstack([places, chosen[:, moving]])
        losses = np.concatenate([losses, solved])
    progress(0.95, "check with the points held out")
    held = rng.permutation(settings.measured.value.size) % HELD == 0
    check = fitted(problem.part(~held), settings.seed)
    drawn = predicted_again(problem, held, check, rng)
    low, high = np.percentile(drawn, (5.0, 95.0), axis=0)
    truth = settings.measured.value[held]
    band = np.percentile(values, (2.5, 97.5), axis=0)
    progress(1.0, "fitted")
    return Calibration(
        settings=settings,
        emulator_error=error,
        posterior=posterior,
        before=predict(np.zeros((1, len(uncertain))))[0],
        after=predict(posterior.seen_mean()[None])[0],
        low=band[0],
        high=band[1],
        bias=bias,
        inside=float(np.mean((low <= truth) & (truth <= high))),
        held=int(held.sum()),
    )


def axle_at(settings: CalibrationSettings, inputs: Array) -> tuple[HypoidAxleParameters, Array]:
    """Return the axle with its inputs at standard normals (k,), and the factors of its losses."""
    axle, scale = settings.axle, np.ones(len(LOSS_SOURCES))
    for one, normal in zip(settings.uncertain, inputs, strict=True):
        axle = changed_axle(one, axle, float(normal), scale)
    return axle, scale


def loss_torques(axle: HypoidAxleParameters, measured: Measurements) -> Array:
    """Return the losses of an axle at measured points (sources, m) [N.m] at the pinion."""
    at = [measured.conditions[name] for name in ("temperature_degc", "speed_rpm", "torque_n_m")]
    found = np.empty((len(LOSS_SOURCES), measured.value.size))
    steady, group = np.unique(np.stack(at[:2]), axis=1, return_inverse=True)
    for k, (degc, rpm) in enumerate(steady.T):
        here = np.flatnonzero(np.ravel(group) == k)
        torques, place = np.unique(at[2][here], return_inverse=True)
        try:
            losses = axle_losses(
                axle,
                torques=torques,
                speeds=np.array([rpm_to_rads(rpm)]),
                temperatures=np.array([celsius_to_kelvin(degc)]),
                angles=_ANGLES,
                extremes=False,
            )
        except ParameterError as error:
            where = f"{measured.path}, {measured.named(np.isin(np.arange(found.shape[1]), here))}"
            raise ParameterError(f"{where}: {error}") from error
        for status in losses.status[0, 0][losses.status[0, 0] != 0]:
            raise ParameterError(
                f"The axle must have a loss at each measured point, got none near "
                f"{measured.where(int(here[0]))}: {FAILURES[int(status)]} Or leave the point out."
            )
        found[:, here] = losses.power[0, 0, place].T / rpm_to_rads(rpm)
    return found


def _check_ends(settings: CalibrationSettings) -> None:
    """Refuse inputs that leave their limits where the model is to be run."""
    for k, one in enumerate(settings.uncertain):
        for end in (_EDGE, -_EDGE):
            try:
                axle_at(settings, end * np.eye(len(settings.uncertain))[k])
            except ParameterError as error:
                raise ParameterError(
                    f"The {one.words} at {one.multiplier(end):.3g} times its value must be within "
                    f"its limits: {error.__cause__ or error} Take a value farther from its limit, "
                    f"or do not calibrate {one.name}."
                ) from error


def _design(settings: CalibrationSettings, moving: int) -> Array:
    """Return where the model is run, (runs, moving) in standard deviations."""
    if moving == 0:
        return np.empty((1, 0))
    features = (moving + 1) * (moving + 2) // 2
    count = settings.runs or max(16, 2 * features)
    if count < features + 1:
        raise ParameterError(
            f"--runs must be at least {features + 1} for {moving} inputs that change the axle, got "
            f"{count}. Leave it out for a usual number."
        )
    sobol = qmc.Sobol(moving, rng=settings.seed).random_base2(int(np.ceil(np.log2(count))))
    return np.vstack([np.zeros((1, moving)), _EDGE * (2.0 * sobol[: count - 1] - 1.0)])


def _features(inputs: Array) -> Array:
    """Return 1, inputs and their products (n, features)."""
    rows, columns = np.triu_indices(inputs.shape[1])
    return np.column_stack([np.ones(len(inputs)), inputs, inputs[:, rows] * inputs[:, columns]])


def _of_groups(uncertain: tuple[Uncertain, ...], losses: Array) -> tuple[Array, Array]:
    """Return losses (n, groups, m) of sources that the same inputs scale, and their scales."""
    scales = np.array(
        [
            [np.log(one.multiplier(1.0)) * (source in one.sources) for source in LOSS_SOURCES]
            for one in uncertain
        ]
    )
    scales, group = np.unique(scales, axis=1, return_inverse=True)
    summed = [losses[:, np.ravel(group) == k].sum(axis=1) for k in range(scales.shape[1])]
    return np.stack(summed, axis=1), scales


def _emulator(
    uncertain: tuple[Uncertain, ...], moving: Array, places: Array, losses: Array
) -> tuple[Callable[[Array], Array], Array]:
    """Return a function of loss torques (n, m) [N.m] of inputs (n, k), and its error (m,).

    The logarithm of each group of losses is quadratic in the inputs that change the axle. The error
    is relative, the rms of runs that are left out one by one.
    """
    groups, scales = _of_groups(uncertain, losses)
    total = groups.sum(axis=1, keepdims=True)
    present = (groups > _LEAST * total).any(axis=0)
    logs = np.log(np.maximum(groups, _LEAST * np.maximum(total, _LEAST)))
    features = _features(places)
    pseudo = np.linalg.pinv(features)
    coefficients = np.einsum("fn,ngm->gfm", pseudo, logs)
    missed = logs - np.einsum("nf,gfm->ngm", features, coefficients)
    freedom = 1.0 - np.sum(features * pseudo.T, axis=1)  # 0 for a single run, which fits itself
    left_out = logs - missed / np.where(freedom > 1e-9, freedom, np.inf)[:, None, None]
    repeated, truth = (np.where(present, np.exp(one), 0.0).sum(axis=1) for one in (left_out, logs))

    def predict(inputs: Array) -> Array:
        features, found = _features(inputs[:, moving]), np.zeros((len(inputs), truth.shape[1]))
        for scale, one, there in zip(scales.T, coefficients, present, strict=True):
            found += np.where(there, np.exp(features @ one + (inputs @ scale)[:, None]), 0.0)
        return found

    return predict, np.sqrt(np.mean((repeated / truth - 1.0) ** 2, axis=0))


def _problem(
    settings: CalibrationSettings, predict: Callable[[Array], Array], error: Array
) -> Problem:
    measured = settings.measured
    torque = measured.conditions["torque_n_m"]
    near = 0.25 * float(np.ptp(torque)) or 1.0
    alike = np.exp(-0.5 * ((torque[:, None] - torque) / near) ** 2)
    own = 0.25 * measured.uncertainty**2 + (_EXACT * np.abs(measured.value).max()) ** 2

    def covariance(predicted: Array) -> Array:
        common = settings.gain**2 + settings.model_error**2 * alike + np.diag(error**2)
        return np.diag(own) + settings.offset**2 + common * np.outer(predicted, predicted)

    return Problem(
        names=settings.inputs,
        predict=predict,
        measured=measured.value,
        covariance=covariance,
    )
