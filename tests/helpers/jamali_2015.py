"""Pairs, cycle and film of Jamali 2015 chapters 4 to 6, as his text varies them."""

from __future__ import annotations

from gearlube_core.checks import check_option
from gearlube_core.ehl.gears.helical_film import HelicalFilm
from gearlube_core.ehl.point.solid_contact import SolidContact
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.gear_file_sections import Member
from gearlube_core.helical_geometry.meshing_steps import MeshingSteps, gear_file_steps
from gearlube_core.helical_geometry.modification import ModifiedPair
from gearlube_core.oil.film_oil_data import jamali_2015_oil
from gearlube_core.units import MILLIMETRE

_MODULUS = 0.5 * 227.5e9  # E*, Pa; E 207 GPa, nu 0.3: from [jamali_2015 ch. 7]
_TORQUE, _SPEED = 1060.0, 235.62  # N m, rad/s: [jamali_2015 ch. 4]
_SOLIDS = SolidContact()


def jamali_2015(
    design: str,
    *,
    k: float = 1.0,
    beta: float | None = None,
    crown_start: float = 0.0,
    facets: int = 0,
) -> ModifiedPair:
    """Return design "a" or "b" of [jamali_2015 Table 4.1] with its relief and crown on all flanks.

    Parameters
    ----------
    design
        "a" (33:34) or "b" (33:99).
    k
        Parabolic share of the tip relief k of [jamali_2015 (5.2)] [-]; 1 is the default there.
    beta
        Given, the relief follows the power law (5.6) instead [-].
    crown_start
        F_o [m]; 0 is the default.
    facets
        n_f of chapter 6 on both flanks [-]; 0 is smooth.

    Returns
    -------
    ModifiedPair
        The crown of 8 um is on both teeth: with one crowned tooth the contact at the largest load
        would be longer than the 0.93 w of sec. 4.3.
    """
    check_option("design", design, ("a", "b"))
    file = HelicalGearFile.named(f"jamali_2015_{design}")
    changes: dict[str, float | str] = {
        "tip_relief_parabola": k,
        "crown_start_mm": crown_start / MILLIMETRE,
        "facets": facets,
    }
    if beta is not None:
        changes |= {"tip_relief_form": "power", "tip_relief_exponent": beta}

    def changed(member: Member) -> Member:
        return member.model_copy(update={"flank": member.flank.model_copy(update=changes)})

    members = {"pinion": changed(file.pinion), "gear": changed(file.gear)}
    return file.model_copy(update=members).modified_pair()


def jamali_2015_steps(design: str) -> MeshingSteps:
    """Return the time steps of Jamali 2015 chapters 4 to 6 for design "a" or "b".

    Notes
    -----
    575 steps of 0.04 mm are printed (sec. 4.4). s_0 = -18.7 mm is completed: the position where
    L = 0.16 w, -18.64 mm in design A.
    """
    check_option("design", design, ("a", "b"))
    return gear_file_steps(HelicalGearFile.named(f"jamali_2015_{design}"))


def jamali_2015_film(
    design: str,
    *,
    k: float = 1.0,
    beta: float | None = None,
    crown_start: float = 0.0,
    facets: int = 0,
    newtonian: bool = False,
    nodes: tuple[int, int] = (97, 257),
    grading: tuple[tuple[float, float], ...] = (),
    convention: str = "thesis",
    solids: SolidContact | None = _SOLIDS,
) -> HelicalFilm:
    """Return the film of design "a" or "b" of Jamali 2015 chapters 4 to 6.

    Parameters
    ----------
    design, k, beta, crown_start, facets
        As in `jamali_2015`.
    newtonian
        Leave the Eyring stress out.
    nodes
        His mesh is (182, 857), uniform.
    grading
        As in `HelicalFilm`.
    convention
        Of the load; his leaves out cos(beta_b).
    solids
        What carries load where the film vanishes: by default a layer of 10 nm, of which his own
        films of 20 nm and more know nothing. Where his solution fails solids touch and say so.
    """
    return HelicalFilm(
        modified=jamali_2015(design, k=k, beta=beta, crown_start=crown_start, facets=facets),
        steps=jamali_2015_steps(design),
        torque=_TORQUE,
        pinion_speed=_SPEED,
        lubricant=jamali_2015_oil(newtonian=newtonian),
        contact_modulus=_MODULUS,
        nodes=nodes,
        grading=grading,
        convention=convention,
        solids=solids,
    )
