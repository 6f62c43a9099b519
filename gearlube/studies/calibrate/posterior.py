"""Uncertain inputs after measurements: the best fit, draws, and what the data do not see."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import least_squares
from scipy.special import logsumexp
from scipy.stats import genpareto, multivariate_t

from gearlube_core.arrays import Array, Flags

UNSEEN = 0.3  # contraction, below which the data do not see an input
ALIKE = 10.0  # collinearity of two inputs, [brun_2001]
_CORRELATED = 0.9
_STARTS, _DRAWS, _LEAST_DRAWS = 10, 20_000, 1000.0
_WORST_TAIL = 0.7  # Pareto k of the weights, [vehtari_2024]
_FREEDOM = 5.0  # of the Student distribution that is drawn from
_STEP = 1e-3  # standard deviations, for the Jacobian
_FARTHEST = 6.0  # standard deviations of the prior, that a start may reach


@dataclass(frozen=True, kw_only=True)
class Problem:
    """Measured values and what predicts them from k inputs that are standard normal before."""

    names: tuple[str, ...]
    predict: Callable[[Array], Array]  # of inputs (n, k), returns (n, m)
    measured: Array  # (m,)
    covariance: Callable[[Array], Array]  # (m, m) of measured less predicted, for a prediction (m,)

    def part(self, points: Flags) -> Problem:
        """Return the problem with some of the points."""

        def covariance(predicted: Array) -> Array:
            whole = np.ones(points.size)  # the others do not count
            whole[points] = predicted
            return self.covariance(whole)[np.ix_(points, points)]

        return replace(
            self,
            predict=lambda inputs: self.predict(inputs)[:, points],
            measured=self.measured[points],
            covariance=covariance,
        )


@dataclass(frozen=True, kw_only=True)
class Posterior:
    """Inputs after the measurements, in standard deviations of before."""

    names: tuple[str, ...]
    mode: Array  # (k,)
    optima: Array  # half the sum of squares that each start found
    draws: Array  # (n, k), of equal weight
    mean: Array  # (k,)
    covariance: Array  # (k, k)
    jacobian: Array  # (m, k) of the predictions over their errors, at the mode
    effective: float  # number of draws that the weighted ones count as
    tail: float  # Pareto's k of the weights; 0.7 and more is unreliable

    @property
    def sd(self) -> Array:
        """Standard deviations (k,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def correlation(self) -> Array:
        """Correlations (k, k)."""
        return self.covariance / np.outer(self.sd, self.sd)

    @property
    def contraction(self) -> Array:
        """1 - (sd after/sd before)^2: 0 for an input that the data do not see."""
        return 1.0 - self.sd**2

    @property
    def unseen(self) -> Flags:
        """Inputs that the data do not see."""
        return np.asarray(self.contraction < UNSEEN)

    @property
    def reliable(self) -> bool:
        """Whether the draws are those of the posterior, not of a few large weights."""
        return self.effective > _LEAST_DRAWS and self.tail < _WORST_TAIL

    def confounded(self) -> list[tuple[str, str, float, float]]:
        """Return pairs of inputs that act alike: names, correlation, collinearity.

        The collinearity is 1/sqrt(smallest eigenvalue) of the scaled J^T J of the pair,
        [brun_2001].
        """
        found = []
        sizes = np.linalg.norm(self.jacobian, axis=0)
        for i, j in itertools.combinations(range(len(self.names)), 2):
            if min(sizes[i], sizes[j]) ** 2 < UNSEEN / (1.0 - UNSEEN):
                continue  # not seen even by itself
            unit = self.jacobian[:, [i, j]] / sizes[[i, j]]
            least = max(float(np.linalg.eigvalsh(unit.T @ unit)[0]), 1e-8)
            correlation = float(self.correlation[i, j])
            if least**-0.5 > ALIKE or abs(correlation) > _CORRELATED:
                found.append((self.names[i], self.names[j], correlation, least**-0.5))
        return found

    def seen_mean(self) -> Array:
        """Return the mean with the unseen inputs at their prior's, 0."""
        kept = self.unseen
        mean = np.where(kept, 0.0, self.mean)
        if kept.any() and not kept.all():
            cross = self.covariance[np.ix_(~kept, kept)]
            mean[~kept] -= cross @ np.linalg.solve(
                self.covariance[np.ix_(kept, kept)], self.mean[kept]
            )
        return mean


def fitted(problem: Problem, seed: int = 1) -> Posterior:
    """Return the inputs after the measurements.

    The mode is by least squares from ten starts, with the prior as rows. The errors are first those
    of the measured values, then those of what is predicted: errors in percent of scattered values
    would pull the fit down. Draws are of Student distributions about the optima, with weights.

    Examples
    --------
    Four values with mean 0.30 and standard deviation 0.1:

    >>> problem = Problem(names=("a",), predict=lambda z: np.repeat(z, 4, axis=1),
    ...     measured=np.array([0.1, 0.3, 0.3, 0.5]), covariance=lambda _: 0.01 * np.eye(4))
    >>> found = fitted(problem)
    >>> found.mode.round(5).tolist(), round(1.0 - float(found.contraction[0]), 3)
    ([0.29925], 0.002)
    """
    rng = np.random.default_rng(seed)
    count = len(problem.names)
    starts = np.vstack([np.zeros(count), rng.standard_normal((_STARTS - 1, count))])
    error = problem.covariance(problem.measured)
    for _ in range(2):
        optima = [_optimum(problem, error, start) for start in starts]
        mode = min(optima, key=lambda one: one[0])[1]
        error = problem.covariance(problem.predict(mode[None])[0])
    optima = sorted((_optimum(problem, error, start) for start in starts), key=lambda one: one[0])
    lower = cholesky(error, lower=True)
    distinct: list[Array] = []
    for cost, place in optima:
        near = (np.linalg.norm(place - other) < 0.5 for other in distinct)
        if cost < optima[0][0] + 8.0 and not any(near):
            distinct.append(place)
    mixture = [(one, _laplace(_jacobian(problem, lower, one))) for one in distinct]
    for _ in range(3):
        draws, weights, tail = _weighed(problem, lower, mixture, rng)
        effective = effective_number(weights)
        mean = weights @ draws
        covariance = (draws - mean).T @ (weights[:, None] * (draws - mean))
        if effective > _LEAST_DRAWS and tail < _WORST_TAIL:
            break
        mixture = [(mean, 1.5 * covariance + 1e-9 * np.eye(count))]
    return Posterior(
        names=problem.names,
        mode=optima[0][1],
        optima=np.array([cost for cost, _ in optima]),
        draws=draws[rng.choice(len(draws), 2000, p=weights)],
        mean=mean,
        covariance=covariance,
        jacobian=_jacobian(problem, lower, optima[0][1]),
        effective=effective,
        tail=tail,
    )


def predicted_again(
    problem: Problem, held: Flags, found: Posterior, rng: np.random.Generator
) -> Array:
    """Return draws (n, held) of what would be measured at held points, after the others.

    Errors that points have in common, such as the gain of the sensor, follow from the others.
    """
    values = problem.predict(found.draws)
    error = problem.covariance(values.mean(axis=0))
    cross = np.linalg.solve(error[np.ix_(~held, ~held)], error[np.ix_(~held, held)])
    left = error[np.ix_(held, held)] - error[np.ix_(held, ~held)] @ cross
    centre = values[:, held] + (problem.measured[~held] - values[:, ~held]) @ cross
    noise = rng.standard_normal((len(values), int(held.sum())))
    return np.asarray(centre + noise @ cholesky(left + 1e-12 * np.eye(len(left)), lower=True).T)


def effective_number(weights: Array) -> float:
    """Return how many draws of equal weight say as much as these.

    >>> round(effective_number(np.array([0.5, 0.25, 0.25])), 3)
    2.667
    """
    return float(weights.sum() ** 2 / np.sum(weights**2))


def pareto_tail(weights: Array) -> float:
    """Return Pareto's k of the largest weights: above 0.7 a few of them decide, [vehtari_2024]."""
    count = int(min(0.2 * weights.size, 3.0 * weights.size**0.5))
    ordered = np.sort(weights)
    excess = ordered[-count:] - ordered[-count - 1]
    if excess[-1] <= 1e-12 * ordered[-1]:
        return 0.0  # all weights are equal
    return float(genpareto.fit(excess[excess > 0.0] / excess[-1], floc=0.0)[0])


def _optimum(problem: Problem, error: Array, start: Array) -> tuple[float, Array]:
    lower = cholesky(error, lower=True)

    def rows(inputs: Array) -> Array:
        missed = problem.predict(inputs[None])[0] - problem.measured
        return np.concatenate([solve_triangular(lower, missed, lower=True), inputs])

    def slopes(inputs: Array) -> Array:
        return np.vstack([_jacobian(problem, lower, inputs), np.eye(inputs.size)])

    found = least_squares(
        rows, start, jac=slopes, bounds=(-_FARTHEST, _FARTHEST), xtol=1e-10, ftol=1e-12
    )
    return float(found.cost), found.x


def _jacobian(problem: Problem, lower: Array, place: Array) -> Array:
    step = _STEP * np.eye(place.size)
    up, down = problem.predict(place + step), problem.predict(place - step)
    return np.asarray(solve_triangular(lower, (up - down).T / (2.0 * _STEP), lower=True))


def _laplace(jacobian: Array) -> Array:
    return np.asarray(np.linalg.inv(jacobian.T @ jacobian + np.eye(jacobian.shape[1])))


def _weighed(
    problem: Problem, lower: Array, mixture: list[tuple[Array, Array]], rng: np.random.Generator
) -> tuple[Array, Array, float]:
    """Return draws (n, k), their weights of sum 1, and Pareto's k."""
    parts = [multivariate_t(mean, shape, df=_FREEDOM) for mean, shape in mixture]
    share = _DRAWS // len(parts)
    count = mixture[0][0].size
    draws = np.vstack([one.rvs(share, random_state=rng).reshape(-1, count) for one in parts])
    missed = (problem.predict(draws) - problem.measured).T
    rows = solve_triangular(lower, missed, lower=True)
    target = -0.5 * (np.sum(rows**2, axis=0) + np.sum(draws**2, axis=1))
    log = target - logsumexp([np.atleast_1d(one.logpdf(draws)) for one in parts], axis=0)
    weights = np.exp(log - log.max())
    return draws, weights / weights.sum(), pareto_tail(weights)
