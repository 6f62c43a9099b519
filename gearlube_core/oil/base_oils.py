"""Values of a base oil class that an oil file takes where the data sheet has none.

Limiting coefficients are those of [hoglund_1999] that [arana_2019] quotes.
"""

from __future__ import annotations

from typing import NamedTuple


class ClassValue(NamedTuple):
    """A value of a class of oils.

    Oils of the class lie within `value`/`factor` and `value` * `factor` with 95 % (k = 2).
    """

    value: float
    factor: float
    why: str


class BaseOil(NamedTuple):
    """Values of one class of base oils."""

    words: str
    viscosity_law: tuple[str, str]  # name, and where it is from
    density_slope: ClassValue  # d rho/dT [kg/(m3 K)]
    alpha: ClassValue  # measured over estimated mean slope of ln eta to 200 MPa [-]
    limiting_coefficient: ClassValue  # limiting shear stress of the film over pressure [-]
    conductivity: ClassValue  # [W/(m K)]
    heat_capacity: ClassValue  # [J/(kg K)]


EYRING_FACTOR = 2.0  # of one number: 2 to 5 MPa are in use for mineral gear oils
# of the viscosity at 1 GPa with the same alpha of films: its logarithm is known to 0.4, or to 0.15
# with viscosities under pressure; four laws fitted to one PAO below 0.4 GPa differ by 2 to 6 times
HIGH_PRESSURE_FACTOR, VISCOMETER_FACTOR = 2.2, 1.35
# the same without an alpha, with what alpha itself adds by ln(eta/eta0) of about 9 at 1 GPa
UNKNOWN_ALPHA_SPREAD, GROWTH = 1.0, 9.0
MEASURED_ALPHA_FACTOR = 1.15  # of a given alpha: between methods of measurement, assumed
GIVEN_LIMIT_FACTOR = 1.2  # of a given limiting coefficient: assumed
BOUNDARY_STRESS, BOUNDARY_FRICTION = 2.0e6, 0.17  # Pa and [-], of the library's hypoid oils
REFERENCE_DENSITY_DEGC = 70.0  # density counts as constant; midway between 40 and 100 degC

_USUAL = "usual for the class; no source compared"
_HOGLUND = "[arana_2019] after [hoglund_1999]"
_GOLD = "[gold_2001] against measured oils, see docs/oil_file.md"
_NO_OIL = "no measured oil of the class was at hand"
_SHAPE = "[arana_2019 Table 3], shape of the measured"

BASE_OILS = {
    "mineral": BaseOil(
        "paraffinic mineral oil",
        ("modulus", f"{_SHAPE} paraffinic mineral oil, with this alpha"),
        ClassValue(-0.6, 1.2, "reference oil FVA 3 [wingertszahn_2023]"),
        ClassValue(1.0, 1.3, f"{_GOLD}; a naphthenic oil is 25 % higher"),
        ClassValue(0.047, 1.06, f"{_HOGLUND}, +-0.003; a naphthenic oil has 0.053"),
        ClassValue(0.134, 1.15, "reference oil FVA 3 [wingertszahn_2023]"),
        ClassValue(2000.0, 1.15, _USUAL),
    ),
    "pao": BaseOil(
        "polyalphaolefin",
        ("modulus_pao", f"{_SHAPE} polyalphaolefin, with this alpha"),
        ClassValue(-0.6, 1.2, _USUAL),
        ClassValue(1.0, 1.15, f"{_GOLD}; one PAO is 7 to 11 % lower"),
        ClassValue(0.035, 1.09, f"{_HOGLUND}, +-0.003"),
        ClassValue(0.15, 1.15, _USUAL),
        ClassValue(2100.0, 1.15, _USUAL),
    ),
    "ester": BaseOil(
        "polyol ester or diester",
        ("modulus_pao", f"{_SHAPE} polyalphaolefin, with this alpha; {_NO_OIL}"),
        ClassValue(-0.7, 1.2, _USUAL),
        ClassValue(1.0, 1.3, f"[gold_2001]; {_NO_OIL}"),
        ClassValue(0.035, 1.2, f"that of a polyalphaolefin; {_NO_OIL}"),
        ClassValue(0.14, 1.15, _USUAL),
        ClassValue(2000.0, 1.15, _USUAL),
    ),
    "pag": BaseOil(
        "polyglycol",
        ("modulus_pao", f"{_SHAPE} polyalphaolefin, with this alpha; {_NO_OIL}"),
        ClassValue(-0.75, 1.2, _USUAL),
        ClassValue(1.0, 1.3, f"[gold_2001]; {_NO_OIL}"),
        ClassValue(0.044, 1.07, f"{_HOGLUND}, +-0.003"),
        ClassValue(0.15, 1.2, _USUAL),
        ClassValue(2000.0, 1.15, _USUAL),
    ),
}
