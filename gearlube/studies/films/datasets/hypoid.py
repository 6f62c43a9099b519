"""Films of a hypoid flank through its engagement as a dataset, formulas beside them."""

from __future__ import annotations

import hashlib
import math
from typing import NamedTuple

import numpy as np
import xarray as xr

from gearlube.studies.films.datasets.variables import Variable, noted_curves
from gearlube.studies.films.hypoid.flank import HypoidFlank
from gearlube_core.contact.greenwood_tripp_1971 import gear_flanks
from gearlube_core.contact.solid import solid_parameters
from gearlube_core.ehl.gears.hypoid_film import FlankInstant
from gearlube_core.ehl.transient.curves import FilmCurves
from gearlube_core.ehl.transient.solution import FilmSolution
from gearlube_core.film.grubin_1949 import grubin_convention, grubin_film_thickness, grubin_geometry
from gearlube_core.film.point_film import (
    central_film_thickness,
    film_geometry,
    minimum_film_geometry,
    minimum_film_thickness,
)
from gearlube_core.friction.evans_johnson_1986 import (
    solid_resistance,
    surface_heating_number,
    viscous_friction_coefficient,
)
from gearlube_core.friction.flank import flank_friction
from gearlube_core.friction.flank_data import CONSISTENT, contact_geometry
from gearlube_core.friction.traction_regime import traction_regime
from gearlube_core.oil.film_oil import viscosity
from gearlube_core.oil.roelands_1966 import ROELANDS_LOG_VISCOSITY
from gearlube_core.units import labelled

_FILM_NOTES = {
    "load": ("N", "load that the pressure carries"),
    "central_film": ("m", "film in the centre of the dry contact"),
    "minimum_film": ("m", "smallest film"),
    "minimum_film_x": ("m", "its place along the minor axis"),
    "minimum_film_y": ("m", "its place along the major axis"),
    "pressure_max": ("Pa", "largest pressure"),
    "traction_newtonian": ("1", "friction along sliding, Newtonian, isothermal"),
    "traction_eyring": ("1", "friction along sliding, Eyring, isothermal"),
    "traction_heated": ("1", "friction along sliding, Eyring, heated across the film"),
    "load_error": ("1", "missing share of the load"),
    "residual": ("1", "unbalanced flow over flow"),
    "converged": ("1", "1 where the film converged"),
    "newton_steps": ("1", "Newton steps"),
    "seconds": ("s", "time that the solution took"),
    "grid_error": ("1", "estimated error of the films by the grid, at rest"),
    "time_error": ("1", "estimated error of the smallest film by the time steps"),
    "time_error_pressure": ("1", "estimated error of the largest pressure by the time steps"),
}
_FORMULA_NOTES = {
    "hertz_pressure": ("Pa", "largest dry pressure, Hertz"),
    "chittenden_central": ("m", "central film, Chittenden et al. 1985 at the entrainment's angle"),
    "chittenden_minimum": ("m", "minimum film, Chittenden et al. 1985 at the entrainment's angle"),
    "component_central": ("m", "central film, Chittenden et al. 1985, minor-axis component"),
    "component_minimum": ("m", "minimum film, Chittenden et al. 1985, minor-axis component"),
    "grubin": ("m", "film, Grubin 1949"),
    "evans_johnson": ("1", "film friction, Evans and Johnson 1986, Chittenden's film"),
    "evans_johnson_solved": ("1", "film friction, Evans and Johnson 1986, solved film"),
    "evans_johnson_roelands": ("1", "the same, with the viscosity of the solution"),
    "axle_friction": ("1", "friction of film and asperities in the axle model"),
    "asperity_share": ("1", "share of asperities in it"),
    "regime": ("1", "traction: 0 Newtonian, 1 Eyring, 2 elastic-plastic"),
}
_THERMAL_NOTES = {
    "central_film": ("m", "film in the centre of the dry contact, thermal"),
    "minimum_film": ("m", "smallest film, thermal"),
    "cold_central_film": ("m", "central film on the same grid, isothermal"),
    "cold_minimum_film": ("m", "smallest film on the same grid, isothermal"),
    "pressure_max": ("Pa", "largest pressure, thermal"),
    "traction": ("1", "friction along sliding, thermal"),
    "rise_max": ("K", "highest temperature in the film above the inlet"),
    "rise_surface": ("K", "highest temperature of a surface above the inlet"),
    "heat_balance": ("1", "heat that is not balanced over that of shear"),
    "turns": ("1", "turns of film and energy"),
    "converged": ("1", "1 where the thermal film converged"),
    "seconds": ("s", "time that the solution took"),
}
_CONTACT_NOTES = {
    "phase": ("1", "mesh periods from the middle of the pair's window"),
    "given_load": ("N", "load on the pair"),
    "R_x": ("m", "relative radius along the minor axis"),
    "R_y": ("m", "relative radius along the major axis"),
    "entrainment": ("m/s", "entrainment speed"),
    "psi": ("rad", "entrainment from the minor axis"),
    "sliding": ("m/s", "sliding speed"),
    "chi": ("rad", "sliding from the minor axis"),
}


class FlankFormulas(NamedTuple):
    """Formulas at one instant, SI."""

    hertz_pressure: float  # largest [Pa]
    chittenden_central: float  # entrainment at its angle to the axes, as the axle takes it [m]
    chittenden_minimum: float
    component_central: float  # Chittenden with the component along the minor axis alone [m]
    component_minimum: float
    grubin: float  # [m]
    evans_johnson: float  # film's friction as the axle has it, with Chittenden's film [-]
    evans_johnson_solved: float  # the same with the solved central film [-]
    evans_johnson_roelands: float  # with the solved film and the solution's viscosity [-]
    axle_friction: float  # film and asperities, with Chittenden's film [-]
    asperity_share: float  # of that friction [-]
    regime: float  # of traction_regime: 0 Newtonian, 1 Eyring, 2 elastic-plastic


def flank_formulas(flank: HypoidFlank, now: FlankInstant, solved_film: float) -> FlankFormulas:
    """Return the formulas at an instant, with the kernels that the axle model calls.

    Parameters
    ----------
    flank
        Pair, oil and roughness.
    now
        Load, radii and motion.
    solved_film
        Central film of the solution [m].

    Notes
    -----
    In a slender contact oil enters across the minor axis; what flows along the major one neither
    adds to the film nor leaves it. `component_*` therefore are Chittenden's with psi = 0 and the
    speed u cos(psi). Evans and Johnson take exp(alpha p) for the viscosity; with that of the
    solution alpha p becomes ln(eta/eta0) of Roelands' law at the mean pressure.
    """
    oil, parameters = flank.oil, flank.parameters
    solid = solid_parameters(parameters.solid, parameters.solid)
    modulus = 2.0 * solid.contact_modulus
    R_x, R_y, psi, speed = now.R_x, now.R_y, now.psi, now.speed
    geometry = contact_geometry(R_x, R_y, psi, solid.contact_modulus)
    axle = flank_friction(
        now.load,
        speed,
        now.slip,
        geometry,
        oil,
        gear_flanks(parameters.roughness_rms),
        solid,
        CONSISTENT,
    )
    operation = (oil.eta0, oil.alpha, speed, now.load, modulus)
    across = (oil.eta0, oil.alpha, now.entrainment[0], now.load, modulus)
    p = axle.mean_pressure
    effusivity = solid.conductivity * solid.density * solid.heat_capacity
    resistance = solid_resistance(geometry.R_e, p, speed, modulus, effusivity)

    def friction(film: float, alpha: float) -> float:
        zeta = surface_heating_number(film, oil.conductivity, resistance)
        return float(
            viscous_friction_coefficient(
                film, p, now.slip, oil.eta0, alpha, oil.beta, oil.tau0, oil.conductivity, zeta
            )
        )

    film = axle.film_thickness
    secant = math.log(viscosity(flank.film.lubricant, p) / oil.eta0) / p
    total = axle.viscous_friction + axle.boundary_friction
    return FlankFormulas(
        hertz_pressure=1.5 * p,
        chittenden_central=film,
        chittenden_minimum=minimum_film_thickness(
            *minimum_film_geometry(R_x, R_y, psi), *operation
        ),
        component_central=central_film_thickness(*film_geometry(R_x, R_y, 0.0), *across),
        component_minimum=minimum_film_thickness(*minimum_film_geometry(R_x, R_y, 0.0), *across),
        grubin=grubin_film_thickness(
            *grubin_geometry(R_x, R_y, psi),
            *operation[:-1],
            grubin_convention("consistent", solid.contact_modulus),
        ),
        evans_johnson=friction(film, oil.alpha),
        evans_johnson_solved=friction(solved_film, oil.alpha),
        evans_johnson_roelands=friction(solved_film, secant),
        axle_friction=axle.friction_coefficient,
        asperity_share=axle.boundary_friction / total if total > 0.0 else 0.0,
        regime=_regime(flank, now, p, solved_film),
    )


def _regime(flank: HypoidFlank, now: FlankInstant, pressure: float, film: float) -> float:
    oil = flank.oil
    log_viscosity = math.log(viscosity(flank.film.lubricant, pressure))
    log_inlet = math.log(oil.eta0)
    reduced = (log_viscosity + ROELANDS_LOG_VISCOSITY) / (log_inlet + ROELANDS_LOG_VISCOSITY)
    # rigid film without a limiting stress: neither is known of these oils
    place = traction_regime(
        log_viscosity,
        log_inlet,
        oil.beta * reduced,
        oil.conductivity,
        oil.tau0,
        film,
        now.slip,
        0.0,
        math.inf,
        math.inf,
        now.speed,
        now.R_x,
    )
    return float(place.state)


def hypoid_dataset(
    flank: HypoidFlank,
    steady: FilmCurves,
    march: FilmCurves | None = None,
    thermal: FilmCurves | None = None,
) -> xr.Dataset:
    """Return films, formulas, load and motion over `position` (steady) and `step` (in time).

    Parameters
    ----------
    flank
        The flank that was solved.
    steady
        Steady films; those kept whole lie along `instant`.
    march
        Films in time; None: left out.
    thermal
        Thermal films of the positions; None: left out.
    """
    variables = _curves(flank, steady, "position", "steady_")
    if march is not None:
        variables |= _curves(flank, march, "step", "")
        variables |= _squeeze(steady, march)
    formulas = [
        flank_formulas(flank, flank.film.cycle.at(time), film)
        for time, film in zip(steady["time"], steady["central_film"], strict=True)
    ]
    for name, note in _FORMULA_NOTES.items():
        values = np.array([getattr(one, name) for one in formulas])
        variables[name] = labelled("position", values, *note)
    if np.isfinite(flank.drive.axle_film).all():
        for name, values, note in (
            ("axle_film", flank.drive.axle_film, ("m", "film in the running axle model")),
            ("running_friction", flank.drive.axle_friction, ("1", "friction in the running axle")),
        ):
            there = np.interp(steady["time"], flank.film.cycle.time, values)
            variables[name] = labelled("position", there, *note)
    variables |= _whole_films(flank, steady)
    if thermal is not None:
        variables |= noted_curves(_THERMAL_NOTES, thermal, "position", "warm_")
    case = flank.case
    solved = [curves for curves in (steady, march, thermal) if curves is not None]
    failures = sum(curves.failures for curves in solved)
    outcome = f"All {sum(len(curves.table) for curves in solved)} films converged."
    if failures:
        outcome = f"{failures} films did not converge. Take more nodes, or smaller time steps."
    return xr.Dataset(
        variables,
        attrs={
            "contact": "hypoid",
            "name": case.name,
            "source": case.source,
            "mesh_table": flank.parameters.mesh.name,
            "flank": "drive" if case.pinion_torque_n_m > 0.0 else "coast",
            "pinion_torque": case.pinion_torque_n_m,
            "pinion_speed": case.pinion_speed,
            "load_of": case.load,
            "entrainment_of": case.entrainment,
            "oil": case.oil,
            "oil_temperature": case.oil_temperature,
            "roughness_rms": 1e-6 * case.roughness_um,
            "eyring_stress": flank.oil.tau0,
            "flow": case.flow,
            "wedge": case.solver.wedge,
            "nodes_minor": flank.film.nodes[0],
            "nodes_major": flank.film.nodes[1],
            "failures": failures,
            "converged": int(failures == 0),
            "outcome": outcome,
        },
    )


def _curves(
    flank: HypoidFlank, curves: FilmCurves, dimension: str, prefix: str
) -> dict[str, Variable]:
    of = [flank.film.cycle.at(float(time)) for time in curves["time"]]
    contact = np.array(
        [[n.phase, n.load, n.R_x, n.R_y, n.speed, n.psi, n.slip, n.chi] for n in of]
    ).T
    found = {
        prefix + "time": labelled(dimension, curves["time"], "s", "from the first loaded sample")
    }
    found |= noted_curves(_FILM_NOTES, curves, dimension, prefix)
    for (name, note), values in zip(_CONTACT_NOTES.items(), contact, strict=True):
        found[prefix + name] = labelled(dimension, values, *note)
    return found


def _squeeze(steady: FilmCurves, march: FilmCurves) -> dict[str, Variable]:
    """Return ratios of film, pressure and friction in time to those of steady films."""
    found = {}
    for name in ("central_film", "minimum_film", "pressure_max", "traction_heated"):
        there = np.interp(steady["time"], march["time"], march[name])
        found[f"squeeze_{name}"] = labelled(
            "position", there / steady[name], "1", f"{_FILM_NOTES[name][1]}, in time over steady"
        )
    return found


def _whole_films(flank: HypoidFlank, steady: FilmCurves) -> dict[str, Variable]:
    if not steady.kept:
        return {}
    rows = sorted(steady.kept)
    films: list[FilmSolution] = [steady.kept[row] for row in rows]
    dims = ("instant", "x", "y")
    axes = np.array(
        [flank.film.problem(flank.film.cycle.at(one.time)).hertz_contact for one in films]
    )
    return {
        "instant_position": labelled("instant", np.array(rows), "1", "its row of positions"),
        "x": labelled("x", films[0].x, "m", "place along the minor axis"),
        "y": labelled("y", films[0].y, "m", "place along the major axis"),
        "pressure": labelled(dims, np.array([one.pressure for one in films]), "Pa", "pressure"),
        "film": labelled(dims, np.array([one.film for one in films]), "m", "film thickness"),
        "semi_axis_x": labelled("instant", axes[:, 0], "m", "minor semi-axis of the dry contact"),
        "semi_axis_y": labelled("instant", axes[:, 1], "m", "major semi-axis of the dry contact"),
    }


def hypoid_key(flank: HypoidFlank) -> str:
    """Return a short key that is unique for contact, oil, grid and steps."""
    cycle = flank.film.cycle
    digest = hashlib.sha256(
        repr((flank.case.solver, flank.film.lubricant, flank.film.flow)).encode()
    )
    for name in cycle.__dataclass_fields__:
        digest.update(np.ascontiguousarray(getattr(cycle, name)).tobytes())
    return digest.hexdigest()[:12]
