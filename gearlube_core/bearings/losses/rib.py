"""Mixed friction between the roller ends and the rib of the inner ring."""

from __future__ import annotations

from typing import NamedTuple

from gearlube_core.contact.greenwood_tripp_1971 import asperity_share
from gearlube_core.contact.hertz import hertz_ellipse
from gearlube_core.film.groups import inlet_heating_number
from gearlube_core.film.point_film import central_film_thickness
from gearlube_core.film.zhu_cheng_1989 import zhu_cheng_heating
from gearlube_core.friction.johnson_greenwood_1980 import thermal_eyring_film
from gearlube_core.kernels.jit import kernel
from gearlube_core.oil.formula_laws import bounded_stress, log_viscosity_under
from gearlube_core.oil.lubricant_state import LubricantState, eyring_stress_under

# where a file does not say
RIB_HEIGHT = 0.15  # of the contact above the race, over the roller diameter; assumed
RIB_END_RADIUS = 0.9  # of the sphere of the roller end, over its distance from the apex
RIB_ROUGHNESS = 0.24e-6  # composite rms, [wingertszahn_2023] [m]
RIB_SHARE_B, RIB_SHARE_C = 1.90, 0.99  # likewise
RIB_BOUNDARY_FRICTION = 0.15  # between 0.1 and 0.2 in [zhou_hoeprich_1991]; 0.2 in [aihara_1987]
# known to factors (k = 2): 0.1 to 0.2; run in or superfinished against new. Assumed.
RIB_FRICTION_FACTOR, RIB_ROUGHNESS_FACTOR = 1.4, 2.0


class RibParameters(NamedTuple):
    """Contact of one roller end with the rib; all floats, SI."""

    sliding_ratio: float  # sliding speed over shaft speed [m]
    mean_ratio: float  # mean surface speed over shaft speed [m]
    R_meridian: float  # relative radius in the plane of the bearing's axis [m]
    R_sliding: float  # relative radius along sliding [m]
    R_e: float  # of the film, along entrainment [m]
    side_flow: float  # of the film [-]
    roughness: float  # composite rms [m]
    share_b: float  # B of the asperity share [-]
    share_c: float  # C of the asperity share [-]
    boundary_friction: float  # of the asperities [-]
    reduced_modulus: float  # E' [Pa]


class RibFriction(NamedTuple):
    """Friction of one roller end; all floats, SI."""

    power: float  # [W]
    coefficient: float  # friction over load [-]
    film: float  # central, hot [m]
    film_ratio: float  # film over roughness [-]
    asperity_share: float  # of the load [-]


@kernel
def rib_friction(rib: RibParameters, load: float, speed: float, oil: LubricantState) -> RibFriction:
    """Return the friction of one roller end on the rib.

    mu = s mu_b + (1 - s) tau/p,  s = exp(-B Lambda^C),  P = mu Q v

    Parameters
    ----------
    rib
        Contact of roller end and rib.
    load
        Q of the roller end [N], not negative.
    speed
        Of the shaft [rad/s], not negative.
    oil
        At the temperature of the inlet.

    Returns
    -------
    RibFriction
        All zero without load or speed.

    Notes
    -----
    The film is that of an ellipse entrained along its long axis [chittenden_1985], lowered once by
    inlet heating [zhu_cheng_1989]. tau is the stress of a thermal Eyring film
    [johnson_greenwood_1980] at the mean Hertz pressure and the viscosity of Roelands; the surfaces
    keep the temperature of the oil. Drilling about the normal is left out.
    Source of the share: [zhou_hoeprich_1991 (45)]
    """
    if load <= 0.0 or speed <= 0.0:
        return RibFriction(0.0, 0.0, 0.0, 0.0, 0.0)
    v = rib.sliding_ratio * speed
    u = rib.mean_ratio * speed
    modulus = rib.reduced_modulus
    _, _, p = hertz_ellipse(rib.R_meridian, rib.R_sliding, 0.5 * modulus, load)
    heat = zhu_cheng_heating(
        inlet_heating_number(oil.eta0, oil.beta, u, oil.conductivity), 1.5 * p / modulus, v / u
    )
    cold = central_film_thickness(rib.R_e, rib.side_flow, oil.eta0, oil.alpha, u, load, modulus)
    film = heat * cold
    ratio = film / rib.roughness
    share = asperity_share(ratio, rib.share_b, rib.share_c)
    mu = share * rib.boundary_friction
    if film > 0.0 and share < 1.0:
        log_viscosity = log_viscosity_under(oil.viscosity, oil, p)
        tau0 = eyring_stress_under(oil, p)
        sheared = thermal_eyring_film(log_viscosity, oil.beta, oil.conductivity, tau0, film, v)
        ratio_of_film = bounded_stress(oil.shear, sheared.stress_ratio, tau0, oil, p, v, film)
        mu += (1.0 - share) * ratio_of_film * tau0 / p
    return RibFriction(mu * load * v, mu, film, ratio, share)
