"""Fits to solved films: the small net of the film kernel, and Gaussian processes."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from gearlube_core.arrays import Array
from gearlube_core.extras import extra_package
from gearlube_core.film_model.groups import THIN, FilmGroups
from gearlube_core.film_model.net import N_GROUPS, N_OUTPUTS, WIDTH
from gearlube_core.progress import Progress, no_progress

_PULL = 1e-6  # of the squares of the weights, for each point
_LEAST = 1e-6  # of the mean diagonal, that damps weights without effect
_TRIES = 12  # of a step, each damped more
_CHUNK = 2000  # points whose slopes are held at once

_SHAPES = {
    "first": (N_GROUPS, WIDTH),
    "first_offset": (WIDTH,),
    "second": (WIDTH, WIDTH),
    "second_offset": (WIDTH,),
    "straight": (N_OUTPUTS, N_GROUPS),
    "last": (N_OUTPUTS, WIDTH),
    "last_offset": (N_OUTPUTS,),
}
_LENGTHS = (0.3, 300.0)  # limits, in standard deviations of a feature
_ROUGH_LENGTHS = (0.7, 100.0)
_NOISE = (1e-9, 0.1)  # limits of its variance over that of the values
_ROUGH_NOISE = 1e-3  # first guess
_LEARNT = 500  # values, about, of which lengths and noise are learnt; all give the mean
_ROUGHNESS = 2.5  # of Matern: twice differentiable


def net_blocks(x: Array) -> dict[str, Array]:
    """Return weights by name from one flat array."""
    blocks, start = {}, 0
    for name, shape in _SHAPES.items():
        size = int(np.prod(shape))
        blocks[name] = x[start : start + size].reshape(shape)
        start += size
    return blocks


def flat_blocks(blocks: dict[str, Array]) -> Array:
    """Return weights by name as one flat array."""
    return np.concatenate([np.asarray(blocks[name]).ravel() for name in _SHAPES])


def net_values(blocks: dict[str, Array], inputs: Array) -> Array:
    """Return the outputs (n, 2) of inputs (n, N_GROUPS), scaled as the kernel scales them."""
    a = inputs @ blocks["first"] + blocks["first_offset"]
    s = a / np.sqrt(1.0 + a * a)
    b = s @ blocks["second"] + blocks["second_offset"]
    t = b / np.sqrt(1.0 + b * b)
    return inputs @ blocks["straight"].T + t @ blocks["last"].T + blocks["last_offset"]


def fit_net(
    inputs: Array,
    targets: Array,
    weights: Array,
    *,
    seed: int,
    steps: int,
    start: dict[str, Array] | None = None,
    progress: Progress = no_progress,
) -> dict[str, Array]:
    """Return the weights that fit targets with the least weighted square.

    Parameters
    ----------
    inputs : ndarray, shape (n, N_GROUPS)
    targets : ndarray, shape (n, 2)
        Scaled results, of order one.
    weights : ndarray, shape (n, 2)
        Weights of the squared errors.
    seed
        Of the first weights.
    steps
        Steps of Levenberg and Marquardt, each a second of a processor for some thousand points.
    start
        Weights to go on from; None: random ones.
    progress
        Called with the share done and a sentence.

    Notes
    -----
    Gauss-Newton steps on the normal equations, damped as by [marquardt_1963]; a step that makes the
    sum of squares larger is not taken. A weak pull to zero keeps the equations regular.
    """
    if start is None:
        start = _first_weights(seed, targets)
    x, damping = flat_blocks(start), 1e-1
    value = _squares(x, inputs, targets, weights)
    for step in range(steps):
        matrix, pull = _normal_equations(x, inputs, targets, weights)
        diagonal = matrix.diagonal().copy()
        for _ in range(_TRIES):
            damped = matrix + np.diag(damping * (diagonal + _LEAST * diagonal.mean()))
            trial = x + cho_solve(cho_factor(damped, check_finite=False), pull)
            found = _squares(trial, inputs, targets, weights)
            if found < value:
                x, value, damping = trial, found, max(damping / 3.0, 1e-9)
                break
            damping = min(4.0 * damping, 1e6)
        else:
            break
        rms = math.sqrt(value / targets.size)
        progress((step + 1) / steps, f"net, {rms:.2g} of the spread left")
    return net_blocks(x)


def _first_weights(seed: int, targets: Array) -> dict[str, Array]:
    rng = np.random.default_rng(seed)
    start = {
        name: rng.normal(size=shape) / np.sqrt(shape[0] if len(shape) > 1 else 4.0)
        for name, shape in _SHAPES.items()
    }
    start["last"] *= 0.1
    start["straight"] *= 0.0
    start["last_offset"] = targets.mean(axis=0)
    return start


def _squares(x: Array, inputs: Array, targets: Array, weights: Array) -> float:
    miss = net_values(net_blocks(x), inputs) - targets
    return float((weights * miss * miss).sum()) + _PULL * len(inputs) * float(x @ x)


def _normal_equations(
    x: Array, inputs: Array, targets: Array, weights: Array
) -> tuple[Array, Array]:
    """Return the matrix (p, p) and the right-hand side (p,) of a Gauss-Newton step."""
    w = net_blocks(x)
    pull = _PULL * len(inputs)
    matrix, right = pull * np.eye(x.size), -pull * x
    for rows in np.array_split(np.arange(len(inputs)), max(1, len(inputs) // _CHUNK)):
        z = inputs[rows]
        a = z @ w["first"] + w["first_offset"]
        s = a / np.sqrt(1.0 + a * a)
        s_slope = (1.0 + a * a) ** -1.5
        b = s @ w["second"] + w["second_offset"]
        t = b / np.sqrt(1.0 + b * b)
        t_slope = (1.0 + b * b) ** -1.5
        miss = targets[rows] - net_values(w, z)
        for out in range(N_OUTPUTS):
            g_b = w["last"][out] * t_slope
            g_a = (g_b @ w["second"].T) * s_slope
            parts = {name: np.zeros((len(z), *shape)) for name, shape in _SHAPES.items()}
            parts["first"] = z[:, :, None] * g_a[:, None, :]
            parts["first_offset"] = g_a
            parts["second"] = s[:, :, None] * g_b[:, None, :]
            parts["second_offset"] = g_b
            parts["straight"][:, out] = z
            parts["last"][:, out] = t
            parts["last_offset"][:, out] = 1.0
            slopes = np.concatenate([parts[name].reshape(len(z), -1) for name in _SHAPES], axis=1)
            weighed = slopes * weights[rows, out, None]
            matrix += weighed.T @ slopes
            right += weighed.T @ miss[:, out]
    return matrix, right


@dataclass(frozen=True, slots=True, eq=False)
class FilmProcess:
    """A straight part and a Gaussian process for one output."""

    shift: Array
    scale: Array
    varies: Array  # features that do
    straight: Array
    process: Any
    spread: float

    def __call__(self, groups: Array) -> Array:
        """Return the mean (n,) at groups (n, N_GROUPS)."""
        x = ((_film_features(groups) - self.shift) / self.scale)[:, self.varies]
        return np.asarray(_lines(x) @ self.straight + self.spread * self.process.predict(x))

    def left_out(self) -> Array:
        """Return the leave-one-out error of each value of the fit, (n,).

        Lengths and noise stay: a little too good.
        """
        covariance = self.process.kernel_(self.process.X_train_)
        inverse = np.linalg.inv(covariance)
        misses = inverse @ self.process.y_train_ / np.diag(inverse)
        return np.asarray(misses * self.spread)


def fit_process(
    groups: Array, values: Array, *, noise: float = 1e-5, smooth: bool = True
) -> FilmProcess:
    """Return the process through values (n,) at groups (n, N_GROUPS) [rasmussen_williams_2006].

    Parameters
    ----------
    groups, values
        Inputs and results to fit.
    noise
        First guess of the noise's variance over that of the values.
    smooth
        Any derivative of the values is smooth; else, the second one. Of rough values a process that
        takes them as smooth has two or three times the error, with lengths that are too short.

    Raises
    ------
    ParameterError
        scikit-learn is not installed.
    """
    extra_package("sklearn", "film-model", "A film model is fitted")
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, Matern, WhiteKernel

    x = _film_features(groups)
    shift, scale = x.mean(axis=0), x.std(axis=0)
    varies = scale > 1e-9 * np.abs(shift)
    scale = np.where(varies, scale, 1.0)
    x = ((x - shift) / scale)[:, varies]
    straight = np.asarray(np.linalg.lstsq(_lines(x), values, rcond=None)[0], dtype=np.float64)
    rest = values - _lines(x) @ straight
    spread = float(rest.std())
    lengths = np.full(x.shape[1], 5.0)
    if smooth:
        kernel = ConstantKernel(4.0, (1e-2, 1e5)) * RBF(lengths, _LENGTHS)
    else:
        kernel = ConstantKernel(4.0, (1e-2, 1e5)) * Matern(lengths, _ROUGH_LENGTHS, nu=_ROUGHNESS)
        noise = max(noise, _ROUGH_NOISE)
    process = GaussianProcessRegressor(kernel + WhiteKernel(noise, _NOISE))
    some = slice(None, None, max(1, round(len(x) / _LEARNT)))
    with warnings.catch_warnings():
        # lengths at their limit belong to features that do not matter
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(x[some], rest[some] / spread)
    process = GaussianProcessRegressor(process.kernel_, optimizer=None).fit(x, rest / spread)
    return FilmProcess(shift, scale, varies, straight, process, spread)


def _lines(x: Array) -> Array:
    return np.hstack([np.ones((len(x), 1)), x])


def _film_features(groups: Array) -> Array:
    """Return inputs (n, 19) in which films vary simply, from groups (n, N_GROUPS).

    In order: thickness, material group as of Moes with u cos(psi), alpha p, stress/p, ellipticity,
    entrainment angle, slide-roll ratio, sliding angle, heating number of the oil, shape of its law,
    limited stress, cooling, warmth, Peclet number of the solids, conductivity ratio,
    ln(eta(p)/eta0), ln[eta0 slip/(h tau)] up to a function of the ellipticity; heat capacity ratio,
    and the thickness itself.
    """
    g = FilmGroups(*groups.T)
    alpha = g.sharpness + THIN * g.thickness - g.pressure  # ln(alpha E*)
    return np.stack(
        [
            g.thickness,
            alpha + 0.25 * (g.rate + np.log(np.cos(g.psi))),
            alpha + g.pressure,
            g.stress - g.pressure,
            g.ellipse,
            g.psi,
            g.slide_roll,
            g.delta,
            g.heat,
            g.shape,
            g.limited,
            g.cooling,
            g.warmth,
            g.peclet,
            g.conductivity,
            np.exp(alpha + g.pressure + g.shape),
            g.rate + g.slide_roll - g.stress - 2.0 * (g.thickness + g.pressure),
            g.capacity,
            np.exp(g.thickness),
        ],
        axis=1,
    )
