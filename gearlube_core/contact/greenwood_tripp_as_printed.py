"""Printed polynomials for the Greenwood-Tripp integrals, for comparison only."""

from __future__ import annotations

from gearlube_core.kernels.jit import kernel

LAMBDA_CRITICAL = 3.0  # Mohammadpour et al. 2015, below [mohammadpour_2015 (19)]


@kernel
def f_5_2_as_printed(film_ratio: float) -> float:
    """Return the load integral as printed.

    -0.004 l^5 + 0.057 l^4 - 0.296 l^3 + 0.784 l^2 - 1.078 l + 0.617, zero for l > 3

    Parameters
    ----------
    film_ratio
        l = h/sigma [-].

    Returns
    -------
    float
        [-].

    Notes
    -----
    Three printed decimals are too few: the value at l = 3 is 0.092 (exact 0.00017) and rises
    from about l = 1.8 on. Source: [mohammadpour_2015 (18)]. Use `f_5_2`.
    """
    l = film_ratio  # noqa: E741
    if l > LAMBDA_CRITICAL:
        return 0.0
    return 0.617 + l * (-1.078 + l * (0.784 + l * (-0.296 + l * (0.057 - 0.004 * l))))


@kernel
def f_2_as_printed(film_ratio: float) -> float:
    """Return the area integral as printed.

    -0.002 l^5 + 0.028 l^4 - 0.173 l^3 + 0.526 l^2 - 0.804 l + 0.500, zero for l > 3

    Parameters
    ----------
    film_ratio
        l = h/sigma [-].

    Returns
    -------
    float
        [-], negative from about l = 2 to 3.

    Notes
    -----
    Source: [mohammadpour_2015 (19)]. Use `f_2`.
    """
    l = film_ratio  # noqa: E741
    if l > LAMBDA_CRITICAL:
        return 0.0
    return 0.500 + l * (-0.804 + l * (0.526 + l * (-0.173 + l * (0.028 - 0.002 * l))))
