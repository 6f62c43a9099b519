"""Drag of the rollers in the oil, Liebrecht's law as Wingertszahn et al. 2023 give it."""

from __future__ import annotations

from gearlube_core.kernels.jit import kernel


@kernel
def liebrecht_drag(
    density: float, nu: float, length: float, diameter: float, pitch: float, cage_speed: float
) -> float:
    """Return the torque that the oil bath exerts on the rollers of a bearing.

    T = 0.86 rho l D^0.164 nu^0.836 d_m^2.164 n_c^1.164

    Parameters
    ----------
    density, nu
        Of the oil [kg/m3], [m2/s].
    length, diameter
        l and D of a roller [m].
    pitch
        d_m [m].
    cage_speed
        n_c in turns per second [1/s], not negative.

    Returns
    -------
    float
        T [N m].

    Notes
    -----
    Right in dimension. The authors say that it is far too low for flooded bearings: at 4000 rpm it
    is below a thousandth of the torque of the measured one.
    Source: [wingertszahn_2023]
    """
    return 0.86 * density * length * diameter**0.164 * nu**0.836 * pitch**2.164 * cage_speed**1.164
