"""Motions, Poincare section and flank contacts of a study as a Dataset."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from gearlube.studies.resonance.datasets import study_attributes
from gearlube.studies.resonance.flank_cycle import CURVES, SHEAR_RATES, FlankCycle, TractionCurve
from gearlube.studies.resonance.response import ORBIT_STEPS, Motion
from gearlube.studies.resonance.study import ResonanceStudy
from gearlube_core.arrays import Array
from gearlube_core.units import labelled

Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, str]]]

SHOWN_PERIODS = 2
SPECTRUM_ORDERS = 16  # mesh orders kept, in steps of one half

# name: unit, long name
_PAIR = {
    "load": ("N", "normal load of a tooth pair"),
    "R_sliding": ("m", "relative radius along sliding, R_zx"),
    "entrainment_speed": ("m s-1", "mean speed of the surfaces"),
    "sliding_speed": ("m s-1", "speed of the pinion's surface over the gear's"),
    "film_thickness": ("m", "film thickness"),
    "film_ratio": ("1", "film thickness over composite roughness"),
    "mean_pressure": ("Pa", "mean Hertz pressure"),
    "inlet_viscosity": ("Pa s", "viscosity at the inlet"),
    "effective_viscosity": ("Pa s", "effective viscosity of the heated film"),
    "rise_centre": ("K", "temperature rise in the middle of the film"),
    "rise_effective": ("K", "temperature rise that gives the effective viscosity"),
    "shear_rate": ("s-1", "sliding speed over film thickness"),
    "shear_stress": ("Pa", "shear stress of the film"),
    "newtonian_stress": ("Pa", "shear stress of the heated film without Eyring stress"),
    "area": ("m2", "contact area"),
    "asperity_area": ("m2", "contact area of asperities"),
    "viscous_friction": ("N", "viscous friction"),
    "boundary_friction": ("N", "boundary friction"),
    "friction_coefficient": ("1", "friction coefficient"),
    "torque_pinion": ("N m", "friction torque on the pinion"),
    "torque_gear": ("N m", "friction torque on the gear"),
    "pressure_number": ("1", "ln of viscosity at pressure over viscosity at the inlet"),
    "film_number": ("1", "ln of 2 K eta0 over beta (tau0 h)^2"),
    "slip_number": ("1", "viscosity times shear rate over Eyring stress"),
    "largest_stress_ratio": ("1", "largest shear stress of the film over Eyring stress"),
    "state": ("1", "0 Newtonian, 1 Eyring, 2 elastic-plastic"),
}


def cycle_dataset(study: ResonanceStudy) -> xr.Dataset:
    """Return motions, Poincare section, flank contacts and traction curves.

    Dimensions `motion` and `sample` (two mesh periods), `order` (mesh orders in halves), `start`
    and `strobe`, `case`, `pair` and `phase` (pair k of phase s is k + s pitches into its three),
    `curve` and `shear_rate_index`. What a stopped study has not reached is left out.
    """
    variables: Variables = {}
    if study.motions:
        variables |= _motions(study.motions)
    if study.section is not None:
        words = "at mesh phase 0, once a mesh period"
        for name, values, unit, what in (
            ("section_x", study.section.x, "m", "dynamic transmission error"),
            ("section_rate", study.section.rate, "m s-1", "its rate"),
        ):
            attributes = {"units": unit, "long_name": f"{what} {words}"}
            variables[name] = (("start", "strobe"), values, attributes)
        for name, function, unit, what in (
            ("x", lambda m: m.orbit.x[0], "m", "transmission error"),
            ("rate", lambda m: m.rate[0], "m s-1", "its rate"),
            ("stable", lambda m: float(m.stable), "1", "1 stable, 0 unstable"),
        ):
            variables[f"section_motion_{name}"] = (
                ("section_motion",),
                np.array([function(motion) for motion in study.section.motions]),
                {"units": unit, "long_name": f"{what}, of periodic motions there"},
            )
    if study.cycles:
        variables |= _contacts(study.cycles) | _curves(study.curves)
    dataset = xr.Dataset(variables, attrs=study_attributes(study))
    if study.section is not None:
        dataset.attrs["section_relative_frequency"] = study.section.relative
        dataset.attrs["section_model"] = "two_dof"
    if study.cycles:
        oil = study.cycles[0].motion.problem.model.kernel_parameters.thermal_oil
        dataset.attrs["eyring_stress"] = oil.tau0
    return dataset


def _motions(motions: list[Motion]) -> Variables:
    def each(function: Any) -> Array:
        return np.array([function(motion) for motion in motions])

    def shown(values: Array, motion: Motion) -> Array:
        return np.resize(values, SHOWN_PERIODS * ORBIT_STEPS)

    series = ("motion", "sample")
    variables: Variables = {
        "motion_model": (
            ("motion",),
            np.array([motion.model for motion in motions], dtype="U32"),
            {"long_name": "model", "units": ""},
        ),
        "sample": (
            ("sample",),
            np.arange(SHOWN_PERIODS * ORBIT_STEPS) / ORBIT_STEPS,
            {"units": "1", "long_name": "pinion rotation in mesh periods"},
        ),
        "order": labelled(("order",), 0.5 * np.arange(2 * SPECTRUM_ORDERS + 1), "1", "mesh order"),
        "x": (
            series,
            each(lambda m: shown(m.orbit.x, m)),
            {
                "units": "m",
                "long_name": "dynamic transmission error from first contact of the drive flanks",
            },
        ),
        "rate": (
            series,
            each(lambda m: shown(m.rate, m)),
            {"units": "m s-1", "long_name": "rate of the dynamic transmission error"},
        ),
        "force": labelled(series, each(lambda m: shown(m.orbit.force, m)), "N", "mesh force"),
        "spectrum": (
            ("motion", "order"),
            each(_spectrum),
            {"units": "m", "long_name": "amplitude of the transmission error, order 0 its mean"},
        ),
    }
    for name, function, unit, words in (
        ("motion_relative_frequency", lambda m: m.relative, "1", "mesh over natural frequency"),
        ("motion_stable", lambda m: float(m.stable), "1", "1 stable, 0 unstable"),
        ("motion_multiplier", lambda m: m.multiplier, "1", "largest Floquet multiplier's modulus"),
        ("motion_periods", lambda m: float(m.problem.periods), "1", "mesh periods of the motion"),
        (
            "motion_separation_share",
            lambda m: m.orbit.separation_share,
            "1",
            "share of the period without contact",
        ),
    ):
        variables[name] = (("motion",), each(function), {"units": unit, "long_name": words})
    return variables


def _spectrum(motion: Motion) -> Array:
    """Return amplitudes at mesh orders in halves [m], shape (2 SPECTRUM_ORDERS + 1,)."""
    x = np.resize(motion.orbit.x, SHOWN_PERIODS * ORBIT_STEPS)
    amplitude = np.abs(np.fft.rfft(x))[: 2 * SPECTRUM_ORDERS + 1] / x.size
    amplitude[1:] *= 2.0
    return np.asarray(amplitude)


def _contacts(cycles: list[FlankCycle]) -> Variables:
    variables: Variables = {
        name: (
            ("case", "pair", "phase"),
            np.array([cycle.values[name] for cycle in cycles]),
            {"units": unit, "long_name": words},
        )
        for name, (unit, words) in _PAIR.items()
    }
    samples = cycles[0].values["load"].shape[1]
    variables["phase"] = labelled(
        ("phase",), np.arange(samples) / samples, "1", "pinion rotation in mesh periods"
    )
    variables["case_relative_frequency"] = (
        ("case",),
        np.array([cycle.motion.relative for cycle in cycles]),
        {"units": "1", "long_name": "mesh over natural frequency"},
    )
    variables["case_oil_temperature"] = (
        ("case",),
        np.array([cycle.oil_temperature for cycle in cycles]),
        {"units": "K", "long_name": "oil temperature at the inlet"},
    )
    return variables


def _curves(curves: list[TractionCurve]) -> Variables:
    variables: Variables = {
        "curve": (("curve",), np.array(CURVES, dtype="U32"), {"long_name": "film model"}),
        "curve_shear_rate": labelled(
            ("curve_shear_rate",), SHEAR_RATES, "s-1", "sliding speed over film thickness"
        ),
        "curve_stress": (
            ("case", "curve", "curve_shear_rate"),
            np.array([[curve.stress[name] for name in CURVES] for curve in curves]),
            {"units": "Pa", "long_name": "shear stress of the hardest loaded contact's film"},
        ),
        "curve_effective_viscosity": (
            ("case", "curve_shear_rate"),
            np.array([curve.effective_viscosity for curve in curves]),
            {"units": "Pa s", "long_name": "effective viscosity of that heated film"},
        ),
    }
    for name, unit, words in (
        ("pressure", "Pa", "mean pressure of the hardest loaded contact"),
        ("film_thickness", "m", "film thickness of the hardest loaded contact"),
        ("viscosity", "Pa s", "viscosity at that pressure and oil temperature"),
    ):
        values = np.array([getattr(curve, name) for curve in curves])
        variables[f"curve_{name}"] = (("case",), values, {"units": unit, "long_name": words})
    return variables
