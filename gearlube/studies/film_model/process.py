"""Gaussian processes over the features of contacts, by scikit-learn."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlube_core.arrays import Array
from gearlube_core.extras import extra_package
from gearlube_core.film_model.groups import FilmGroups

# E* of steel over the pressure of Roelands' law; other solids are outside the domain
_MODULUS_OVER_ROELANDS = 588.5
_LENGTHS = (0.3, 300.0)  # limits, in standard deviations of a feature
_ROUGH_LENGTHS = (0.7, 100.0)
_NOISE = (1e-9, 0.1)  # limits of its variance over that of the values
_ROUGH_NOISE = 1e-3  # first guess
_LEARNT = 500  # values, about, of which lengths and noise are learnt; all give the mean
_ROUGHNESS = 2.5  # of Matern: twice differentiable


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
        """Return what each value of the fit misses when it is left out of it, (n,).

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
        Of the fit.
    noise
        First guess of the noise's variance over that of the values.
    smooth
        Any derivative of the values is smooth; else, the second one. Of rough values a process that
        takes them as smooth errs two or three times as much, with lengths that are too short.

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
    """Return inputs (n, 17) in which films vary simply, from groups (n, N_GROUPS).

    In order: thickness, material group as of Moes with u cos(psi), alpha p, tau0/p, ellipticity,
    entrainment angle, slide-roll ratio, sliding angle, heating number of the oil, Z, S0, Peclet
    number of the solids, conductivity and heat capacity ratio, viscosity, ln(eta(p)/eta0),
    ln[eta0 slip/(h tau0)] up to a function of the ellipticity.
    """
    g = FilmGroups(*groups.T)
    alpha = g.exponent + np.log(g.viscosity)  # ln(alpha over that of Roelands' pressure)
    speed = g.rate + g.viscosity + np.log(np.cos(g.psi))  # ln(eta0 u cos(psi)/(E* R_x))
    pressure = np.exp(g.pressure) * _MODULUS_OVER_ROELANDS
    growth = g.viscosity * np.expm1(np.exp(g.exponent) * np.log1p(pressure))
    slip = g.viscosity + g.rate + g.slide_roll - g.stress
    shear = slip - 2.0 * (np.log(g.thickness) + g.pressure)
    return np.stack(
        [
            g.thickness,
            alpha + 0.25 * speed,
            alpha + g.pressure,
            g.stress - g.pressure,
            g.ellipse,
            g.psi,
            g.slide_roll,
            g.delta,
            g.heat,
            g.exponent,
            g.cooling,
            g.peclet,
            g.conductivity,
            g.capacity,
            g.viscosity,
            growth,
            shear,
        ],
        axis=1,
    )
