"""Inputs and results of a rating of gears, shared by all standards."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple

from gearlube_core.checks import check_option, check_positive, check_within
from gearlube_core.errors import ParameterError
from gearlube_core.number import Checked, Number
from gearlube_core.rating.life import BENDING, PITTING, SOME_PITTING, TREATMENTS, Line, strength
from gearlube_core.rating.pairs import UM, Factors, Pair, both

_DEVIATION = Number("m", 0.0, 2e-3, "13 um is 1.3e-5 m.")
_ARITHMETIC = Number("m", 1e-8, 3e-5, "0.6 um is 6e-7 m.")
_FACTOR = Number("1", 0.5, 20.0, "None: by the formulas of the standard.")


@dataclass(frozen=True, kw_only=True)
class RatedGear(Checked):
    """Material and quality of one gear of a rated pair.

    Parameters
    ----------
    treatment
        One of `TREATMENTS`. Roughness and notch of nitrided steel are not checked against the
        source.
    contact_limit, bending_limit
        sigma_H lim and nominal sigma_F lim: [iso_6336_5] or tests; 1500 and 430 MPa are an example
        of case-hardened steel of medium quality.
    brinell
        Of a through-hardened gear that a hard one work-hardens.
    pitch_deviation, profile_deviation
        f_pb, of bevel gears f_pt, and profile form f_f alpha.
    flank_roughness, root_roughness, arithmetic_roughness
        Mean peak to valley R_z, and R_a of the flank; None: a sixth of its R_z.
    bore, protuberance
        Of cylindrical gears: inner diameter of the body; s_pr of the tool less the grinding stock.
    rim_ratio
        Thickness of the rim over tooth depth; infinite: solid.
    mean_stress
        Y_M: 1 for load on one flank, about 0.7 where both flanks bear load, as of an idler.
    slip_layer
        rho' of the notch factor; None: 3 um, nitrided 0.1 mm, through-hardened as of 1000 MPa.
    some_pitting, endurance
        Whether some pitting is allowed; whether best material and oil keep the life factors at 1 up
        to 1e10 cycles, which is not checked against the source.

    Examples
    --------
    >>> gear = RatedGear(treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8)
    >>> gear.contact_life[0]  # cycles, and factor on the limit
    (100000.0, 1.6)
    """

    treatment: str
    contact_limit: Annotated[float, Number("Pa", 1e8, 3e9, "1500 MPa is 1.5e9 Pa.")]
    bending_limit: Annotated[float, Number("Pa", 2e7, 1e9, "430 MPa is 4.3e8 Pa.")]
    brinell: Annotated[float | None, Number("1", 50.0, 800.0, "130 to 470 is usual.")] = None
    pitch_deviation: Annotated[float, _DEVIATION] = 10e-6
    profile_deviation: Annotated[float, _DEVIATION] = 12e-6
    flank_roughness: Annotated[float, Number("m", 1e-7, 2e-4, "6 um is 6e-6 m.")] = 5e-6
    root_roughness: Annotated[float, Number("m", 1e-7, 4e-4, "20 um is 2e-5 m.")] = 20e-6
    arithmetic_roughness: Annotated[float | None, _ARITHMETIC] = None
    bore: Annotated[float, Number("m", 0.0, 10.0, "Give metres, not millimetres.")] = 0.0
    rim_ratio: float = math.inf
    protuberance: Annotated[float, Number("m", 0.0, 5e-3, "Give metres, not millimetres.")] = 0.0
    mean_stress: Annotated[float, Number("1", 0.3, 1.0, "0.7 of an idler.")] = 1.0
    slip_layer: Annotated[float | None, Number("m", 0.0, 1e-3, "3 um is 3e-6 m.")] = None
    some_pitting: bool = False
    endurance: bool = False
    modulus: Annotated[float, Number("Pa", 1e9, 1e12, "Steel has 2.06e11 Pa.")] = 206e9
    poisson_ratio: Annotated[float, Number("1", 0.0, 0.5)] = 0.3
    density: Annotated[float, Number("kg/m3", 500.0, 25000.0)] = 7830.0

    def __post_init__(self) -> None:
        Checked.__post_init__(self)
        check_option("treatment", self.treatment, TREATMENTS)
        if self.some_pitting and self.steel == "nitrided":
            raise ParameterError(
                f"some_pitting must be False with {self.treatment} steel: its thin layer does not "
                "bear pits."
            )
        if not self.rim_ratio > 0.5:
            raise ParameterError(
                f"rim_ratio must be above 0.5, got {self.rim_ratio:g}. The standard ends there: "
                "calculate a thinner rim by finite elements."
            )

    @property
    def steel(self) -> str:
        """The treatment, where nitrocarburised counts as nitrided."""
        return "nitrided" if self.treatment.startswith("nitr") else self.treatment

    @property
    def R_a(self) -> float:
        """Of the flank [um]."""
        given = self.arithmetic_roughness
        return UM * (self.flank_roughness / 6.0 if given is None else given)

    @property
    def contact_life(self) -> Line:
        """Z_NT over cycles."""
        return self._kept(SOME_PITTING if self.some_pitting else PITTING[self.treatment])

    @property
    def bending_life(self) -> Line:
        """Y_NT over cycles."""
        return self._kept(BENDING[self.treatment])

    def _kept(self, line: Line) -> Line:
        return (*line[:-1], (line[-1][0], 1.0)) if self.endurance else line


Gears = tuple[RatedGear, RatedGear]


@dataclass(frozen=True, kw_only=True)
class LoadFactors(Checked):
    """Factors on the load; None: by the formulas of the standard.

    Parameters
    ----------
    face
        K_H beta: greatest over mean line load along the face. Where a solved distribution gives it,
        set `transverse` to 1 if that is in it too, and `dynamic` to 1 if the loads are those of
        solved dynamics. See also `face_load_factor` and `bevel_face_factor`.
    application, mesh_load
        K_A; K_gamma: 1 with one path of power, 1.1 of three planets, 1.25 of four.
    dynamic, transverse, transverse_root, face_root
        K_v, K_H alpha, K_F alpha, K_F beta.

    Examples
    --------
    >>> LoadFactors(face=1.2, application=1.25).dynamic is None
    True
    """

    face: Annotated[float, Number("1", 1.0, 10.0, "Greatest over mean line load.")]
    application: Annotated[float, Number("1", 0.1, 10.0, "1 to 2 is usual.")] = 1.0
    mesh_load: Annotated[float, Number("1", 1.0, 2.0, "1 with one path of power.")] = 1.0
    dynamic: Annotated[float | None, _FACTOR] = None
    transverse: Annotated[float | None, _FACTOR] = None
    transverse_root: Annotated[float | None, _FACTOR] = None
    face_root: Annotated[float | None, _FACTOR] = None

    @property
    def shock(self) -> float:
        """K_A K_gamma [-]."""
        return self.application * self.mesh_load


class StrengthRating(NamedTuple):
    """Stresses and strengths of pinion and gear against pitting and tooth breakage.

    Calculated by the formulas of the standard as implemented here; check a design against it.
    """

    contact_stress: Pair  # sigma_H [Pa]
    bending_stress: Pair  # sigma_F [Pa]
    contact_lines: tuple[Line, Line]  # sigma_HG over cycles [Pa], for `miner_sum`
    bending_lines: tuple[Line, Line]  # sigma_FG likewise
    cycles: Pair  # of load on a tooth [-]
    factors: Factors  # all that they follow from, by the standard's symbols; N, mm, MPa, um
    outside: tuple[str, ...]  # limits that the gears exceed, and what is missing, in words
    standard: str  # with edition and letter of the method

    def number(self, name: str) -> float:
        """Return a factor of the mesh, or that of the pinion."""
        value = self.factors[name]
        return value[0] if isinstance(value, tuple) else value

    @property
    def contact_strength(self) -> Pair:
        """sigma_HG at the cycles [Pa]."""
        return both(strength, self.contact_lines, self.cycles)

    @property
    def bending_strength(self) -> Pair:
        """sigma_FG at the cycles [Pa]."""
        return both(strength, self.bending_lines, self.cycles)

    @property
    def contact_safety(self) -> Pair:
        """S_H [-]."""
        return both(lambda a, b: a / b, self.contact_strength, self.contact_stress)

    @property
    def bending_safety(self) -> Pair:
        """S_F [-]."""
        return both(lambda a, b: a / b, self.bending_strength, self.bending_stress)


def check_load(torque: float, speed: float, cycles: Pair, oil_viscosity: float) -> None:
    """Raise ParameterError where a load is none that can be rated."""
    check_positive("pinion_torque", torque, "N.m", "Give its amount for either flank.")
    check_positive("pinion_speed", speed, "rad/s", "1000 rpm is 104.7 rad/s.")
    for name, n in zip(("pinion", "gear"), cycles, strict=True):
        check_positive(f"cycles of the {name}", n, "", "60 times 1/min times hours.")
    check_within("oil_viscosity", oil_viscosity, 1e-6, 5e-3, "m2/s", "220 mm2/s is 2.2e-4 m2/s.")
