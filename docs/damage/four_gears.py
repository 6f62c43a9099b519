"""The standard beside the solved contact on four gears: python -m docs.damage.four_gears.

Two hypoid pairs, a helical and a spur pair, each at one load; puts the table into docs/damage.md.
Six minutes of one processor, of which the contact of the face-milled pair takes most.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

import gearlube as gl
from docs.page import ROOT, Page
from docs.published_friction import roughness_ra
from gearlube.damage.flank import flank_damage
from gearlube.damage.pair import helical_teeth, pair_settings
from gearlube_core.dynamics.helical_pair.flank_states import face_load
from gearlube_core.dynamics.hypoid_axle.flank_states import flank_states
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.rating.flank_load import FlankLoad, FlankOil
from gearlube_core.rating.gears import StrengthRating
from gearlube_core.rating.micropitting import micropitting_rating
from gearlube_core.rating.scuffing import flash_rating
from gearlube_core.units import ZERO_CELSIUS, rpm_to_rads

HERE = Path(__file__).parent
_ROUGH = 0.5e-6  # m, composite rms of both flanks, of the solved films
_GEAR = gl.rating.RatedGear(
    treatment="case_hardened", contact_limit=1.5e9, bending_limit=4.3e8,
    flank_roughness=6.0e-6 * roughness_ra(_ROUGH),
)  # fmt: skip
_GEARS = (_GEAR, _GEAR)
_OIL = ZERO_CELSIUS + 90.0
_CYCLES = (5e7, 5e7)


class Load(NamedTuple):
    """Torque on the pinion [N.m] and its speed [rad/s]."""

    torque: float
    speed: float


class Beside(NamedTuple):
    """What the standard and the solved contact say of one load."""

    name: str
    load: Load
    rating: StrengthRating
    states: FlankStates
    solid: object
    face: float  # K_H beta of the standard
    solved_face: float  # nan: not known
    flash: float  # contact temperature of ISO/TS 6336-20 [K]
    film: float  # specific film of ISO/TS 6336-22


def hypoid(
    name: str, gear: gl.HypoidGearFile, mesh: gl.gears.MeshTable | None, load: Load
) -> Beside:
    """Return both for an axle with these gears, in the paper's housing and oil."""
    given = {} if mesh is None else {"mesh": mesh}
    axle = gl.mohammadpour_2015_axle(**given)
    rating = gl.rating.bevel_rating(
        gl.rating.BevelMesh.of_blank(gear.blank()), _GEARS, gl.rating.LoadFactors(face=1.65),
        pinion_torque=load.torque, pinion_speed=load.speed, cycles=_CYCLES,
        oil_viscosity=float(axle.oil.state(ZERO_CELSIUS + 40.0).nu),
    )  # fmt: skip
    states = flank_states(axle, torque=load.torque, speed=load.speed, temperature=_OIL)
    nan = math.nan
    return Beside(name, load, rating, states, axle.solid, 1.65, nan, nan, nan)


def cylindrical(name: str, file: gl.HelicalGearFile, load: Load) -> Beside:
    """Return both for a helical or spur pair, in the oil of the paper's axle."""
    bins = gl.rating.duty_bins([1.0], [load.torque], [load.speed], _OIL, widths=(1e-3, 1e-3, 1e-3))
    settings = pair_settings(file, bins)
    teeth, pair, factors = (
        helical_teeth(settings),
        file.helical_pair(),
        gl.rating.LoadFactors(face=1.2),
    )
    rating = gl.rating.cylindrical_rating(
        pair, _GEARS, factors, pinion_torque=load.torque, pinion_speed=load.speed, cycles=_CYCLES,
        oil_viscosity=float(teeth.oil.state(ZERO_CELSIUS + 40.0).nu),
    )  # fmt: skip
    states = teeth.states(load.torque, load.speed, _OIL)
    of_flank = FlankLoad.of(
        rating, pair, _GEARS, FlankOil.of(teeth.oil, temperature=_OIL, load_stage=12.0)
    )
    flash = flash_rating(of_flank, friction=of_flank.mean_friction).temperature
    film = float(micropitting_rating(of_flank, permissible=1.0).points.specific.min())
    face = face_load(pair, states)[0]
    return Beside(name, load, rating, states, teeth.solid, factors.face, face, flash, film)


def cells(one: Beside) -> list[str]:
    """Return the row of the table."""
    rating, states = one.rating, one.states
    nominal = rating.number("sigma_H0") * max(np.atleast_1d(rating.factors["Z_BD"]))
    stress, solved = 1e-6 * max(rating.contact_stress), 1e-6 * float(states.pressure.max())
    found = flank_damage(states, one.solid, 0.0)
    contact = states.bulk + float(found.flash.max()) - ZERO_CELSIUS
    safety = min(rating.contact_safety)

    def known(value: float, digits: int) -> str:
        return "-" if math.isnan(value) else f"{value:.{digits}f}"

    return [
        one.name,
        f"{one.load.torque:.0f}, {one.load.speed * 30.0 / math.pi:.0f}",
        f"{nominal:.0f}",
        f"{stress:.0f}",
        f"{solved:.0f}",
        f"{solved / nominal:.2f}",
        f"{solved / stress:.2f}",
        f"{one.face:.2f}, {known(one.solved_face, 2)}",
        f"{safety:.2f}",
        known(one.flash - ZERO_CELSIUS, 0),
        f"{contact:.0f}",
        known(one.film, 2),
        f"{float(states.film_ratio.min()):.2f}",
    ]


def milled_mesh(gear: gl.HypoidGearFile, folder: Path) -> gl.gears.MeshTable:
    """Return the mesh table of the face-milled pair, from its loaded contact."""
    loads = ContactSettings(cycle=CycleSettings(torques=(50.0, 100.0, 200.0)))
    return gl.studies.run_contact(gear, loads, folder=folder).mesh_table


def main() -> None:
    """Compute the four pairs and write the table."""
    milled = gl.HypoidGearFile.given(str(ROOT / "examples/gears/face_milled.toml"))
    found = [
        hypoid("hobbed hypoid", gl.HypoidGearFile.named("mohammadpour_2015"), None,
               Load(200.0, rpm_to_rads(1500.0))),
        hypoid("milled hypoid", milled, milled_mesh(milled, ROOT / "build/four_gears"),
               Load(200.0, rpm_to_rads(1500.0))),
        cylindrical("helical, he_2007", gl.HelicalGearFile.named("he_2007"),
                    Load(300.0, rpm_to_rads(2000.0))),
        cylindrical("spur, FZG type C", gl.HelicalGearFile.given(str(HERE / "fzg_c.toml")),
                    Load(265.1, rpm_to_rads(2250.0))),
    ]  # fmt: skip
    page = Page("damage")
    page.rows("Gears", [cells(one) for one in found])
    page.write()


if __name__ == "__main__":
    main()
