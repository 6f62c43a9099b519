"""The axle of Mohammadpour et al. 2015."""

from __future__ import annotations

from typing import get_args

from gearlube_core.bearings.tapered_roller_bearing import PRELOAD, Approach, TaperedRollerBearing
from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015
from gearlube_core.dynamics.hypoid_mesh.parameters import HypoidAxleParameters
from gearlube_core.mesh_table.netcdf import shipped_mesh_table
from gearlube_core.mesh_table.table import MeshTable
from gearlube_core.oil.lubricant import Lubricant


def mohammadpour_2015_axle(
    *,
    bearing_preload: float = 2500.0,
    roughness_rms: float = 0.5e-6,
    backlash: float = 150e-6,
    mesh: MeshTable | None = None,
    oil: str = "mohammadpour_2015",
    bearing_approach: Approach = "full",
) -> HypoidAxleParameters:
    """Return the axle of Mohammadpour et al. 2015 (Tables 1 and A1-A4), to start from.

    Options of the model have the defaults of `HypoidAxleParameters`; change them with `replace`.

    Parameters
    ----------
    bearing_preload : float
        Axial preload of every bearing at assembly [N].
    roughness_rms : float
        Composite roughness of the flanks [m]. The paper gives "Ra 0.5 um" for each solid. Its
        formulas need the composite root mean square, and Karagiannis et al. 2012 give 0.5 um for
        this pair.
    backlash : float
        Total backlash [m], from Karagiannis et al. 2012.
    mesh : MeshTable, optional
        Mesh table of another gear pair, e.g. one written by `gearlube contact`; inertias, masses
        and bearings stay those of the paper. Default: the table that ships.
    oil : str
        Name in the lubricant library.
    bearing_approach : {"full", "as_printed"}
        Equation (26) of the paper with the full approach of the rollers, or with half of it, as
        printed there.

    Raises
    ------
    ParameterError
        A value is out of range, or an option or oil does not exist.

    Examples
    --------
    >>> from dataclasses import replace
    >>> axle = mohammadpour_2015_axle(bearing_preload=6000.0)
    >>> replace(axle, friction="off", equations="as_printed").gear_mass  # kg
    49.9
    """
    check_option("bearing_approach", bearing_approach, get_args(Approach))
    low, high = PRELOAD.low, PRELOAD.high
    check_within("bearing_preload", bearing_preload, low, high, "N", PRELOAD.cure)
    return HypoidAxleParameters(
        mesh=mesh or shipped_mesh_table("mohammadpour_2015"),
        bearing=TaperedRollerBearing.mohammadpour_2015(approach=bearing_approach).with_preload(
            bearing_preload
        ),
        oil=Lubricant.named(oil),
        solid=STEEL_MOHAMMADPOUR_2015,
        pinion_inertia=1734e-6,
        gear_inertia=5.81e-2,
        pinion_mass=12.0,
        gear_mass=49.9,
        roughness_rms=roughness_rms,
        backlash=backlash,
    )
