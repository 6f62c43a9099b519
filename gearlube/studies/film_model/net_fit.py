"""Fit of the small net of the film kernel to given outputs, by L-BFGS with exact gradients."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize

from gearlube_core.arrays import Array
from gearlube_core.film_model.net import N_GROUPS, N_OUTPUTS, WIDTH

_SHAPES = {
    "first": (N_GROUPS, WIDTH),
    "first_offset": (WIDTH,),
    "second": (WIDTH, WIDTH),
    "second_offset": (WIDTH,),
    "straight": (N_OUTPUTS, N_GROUPS),
    "last": (N_OUTPUTS, WIDTH),
    "last_offset": (N_OUTPUTS,),
}


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


def _loss(
    x: Array, inputs: Array, targets: Array, weights: Array, decay: float
) -> tuple[float, Array]:
    w = net_blocks(x)
    a = inputs @ w["first"] + w["first_offset"]
    root_a = 1.0 / np.sqrt(1.0 + a * a)
    s = a * root_a
    b = s @ w["second"] + w["second_offset"]
    root_b = 1.0 / np.sqrt(1.0 + b * b)
    t = b * root_b
    miss = inputs @ w["straight"].T + t @ w["last"].T + w["last_offset"] - targets
    pull = 2.0 * weights * miss / miss.size
    g_b = (pull @ w["last"]) * root_b**3
    g_a = (g_b @ w["second"].T) * root_a**3
    slopes = {
        "first": inputs.T @ g_a,
        "first_offset": g_a.sum(axis=0),
        "second": s.T @ g_b,
        "second_offset": g_b.sum(axis=0),
        "straight": pull.T @ inputs,
        "last": pull.T @ t,
        "last_offset": pull.sum(axis=0),
    }
    value = float((weights * miss * miss).sum()) / miss.size + decay * float(x @ x)
    return value, flat_blocks(slopes) + 2.0 * decay * x


def fit_net(
    inputs: Array,
    targets: Array,
    weights: Array,
    *,
    seed: int,
    steps: int,
    decay: float = 0.0,
    start: dict[str, Array] | None = None,
) -> dict[str, Array]:
    """Return the weights that fit targets with the least weighted square.

    Parameters
    ----------
    inputs : ndarray, shape (n, N_GROUPS)
    targets : ndarray, shape (n, 2)
    weights : ndarray, shape (n, 2)
        Of the squares.
    seed
        Of the first weights.
    steps
        Most iterations.
    decay
        Weight of the squares of the net's own weights.
    start
        Weights to go on from.
    """
    if start is None:
        rng = np.random.default_rng(seed)
        start = {
            name: rng.normal(size=shape) / np.sqrt(shape[0] if len(shape) > 1 else 4.0)
            for name, shape in _SHAPES.items()
        }
        start["last"] = 0.1 * start["last"]
        start["straight"] = 0.0 * start["straight"]
        start["last_offset"] = targets.mean(axis=0)
    found = minimize(
        _loss,
        flat_blocks(start),
        args=(inputs, targets, weights, decay),
        jac=True,
        method="L-BFGS-B",
        options={"maxiter": steps, "maxfun": 2 * steps, "maxcor": 30, "ftol": 1e-15, "gtol": 1e-12},
    )
    return net_blocks(found.x)
