"""Statements 15 to 31 of Karagiannis et al. 2012: film, heat and friction of the shipped pair.

The load is that of the periodic motion. A contact counts from a tenth of the static load on, "mid"
is from half of it on.
"""

from __future__ import annotations

import math

import numpy as np

from docs.page import Claims, Verdict, judge
from docs.resonance.contacts import COLD, HOT, Contacts
from docs.resonance.evidence import Both, Evidence
from gearlube.studies.resonance.flank_cycle import SHEAR_RATES, traction_curve
from gearlube_core.arrays import Array
from gearlube_core.dynamics.hypoid_torsional.kernel_parameters import PAIRS_AT, TorsionalParameters
from gearlube_core.dynamics.hypoid_torsional.rates import thermal_pair
from gearlube_core.dynamics.packed_mesh import N_CHANNELS
from gearlube_core.friction.thermal_eyring_data import INLET
from gearlube_core.friction.traction_regime import EYRING

UM = 1e6
MID = 0.5
OPEN = "not reproducible"
_STEP = 1e-3  # of the logarithm of a load
TRIBOLOGY = Claims()


@TRIBOLOGY("15")
def _cold_film(evidence: Evidence) -> Verdict:
    cold, ours = evidence.contacts[0.3, COLD], evidence.consistent[COLD]
    mid = cold.loaded("film_thickness", MID)
    hardest = cold.at_hardest("film_thickness")
    everywhere = cold.loaded("film_thickness")
    spread, wide = np.ptp(mid) / mid.mean(), np.ptp(everywhere) / everywhere.mean()
    inside = 0.35e-6 <= hardest <= 0.6e-6 and bool(np.all((mid > 0.35e-6) & (mid < 0.6e-6)))
    return Verdict(
        f"{_range(UM * mid)} um mid, spread {100 * spread:.0f} %; all {_range(UM * everywhere)} um",
        judge(inside and spread < 0.3 and wide < 0.3, inside),
        f"consistent film {_range(UM * ours.loaded('film_thickness', MID))} um",
    )


@TRIBOLOGY("16")
def _load_course(evidence: Evidence) -> Verdict:
    load = evidence.contacts[0.3, COLD].course("load")
    carried = np.flatnonzero(load > 0.0)
    top = (np.argmax(load) - carried[0]) / (carried[-1] - carried[0])
    inlet, effective = _load_exponents(evidence.contacts[0.3, COLD])
    return Verdict(
        f"highest at {top:.2f} of a pair's mesh; d ln h/d ln W {inlet:.4f}",
        judge(
            bool(abs(inlet + 1.0 / 12.0) < 0.01 and 0.4 < top < 0.6),
            abs(inlet + 1.0 / 12.0) < 0.01,
        ),
        f"exponent at fixed film temperature; {effective:.2f} at the effective one",
    )


@TRIBOLOGY("17")
def _viscosity_rise(evidence: Evidence) -> Verdict:
    ratio = _viscosity_ratio(evidence.contacts[0.3, COLD])
    return Verdict(f"up to {ratio:.0f}", judge(50.0 < ratio < 300.0))


@TRIBOLOGY("18")
def _cold_rise(evidence: Evidence) -> Verdict:
    kelvin = evidence.contacts[0.3, COLD].loaded("rise_effective")
    rise, warmest = 100.0 * kelvin / COLD, COLD - 273.15 + kelvin.max()
    high = 100.0 * _top(evidence.high_stress[COLD], "rise_effective") / COLD
    in_kelvin, as_told = bool(np.all((rise > 0.5) & (rise < 5.0))), warmest < 43.0
    return Verdict(
        f"{_range(rise)} % of the inlet in kelvin, at most {warmest:.0f} degC",
        judge(in_kelvin and as_told, in_kelvin),
        f"the text prints 41 degC, 0.3 % in kelvin; {high:.1f} % with tau0 5 MPa",
    )


@TRIBOLOGY("19")
def _cold_boundary(evidence: Evidence) -> Verdict:
    share = _boundary_share(evidence.contacts[0.3, COLD])
    return Verdict(
        f"F_b/F_v up to {share.max():.2f}",
        judge(bool(share.max() < 0.25)),
        f"film ratio {evidence.contacts[0.3, COLD].at_hardest('film_ratio'):.2f} at the highest "
        "load",
    )


@TRIBOLOGY("20")
def _newtonian_departure(evidence: Evidence) -> Verdict:
    low = _departure(evidence.contacts[0.3, COLD])
    high = _departure(evidence.high_stress[COLD])
    return Verdict(
        f"tau/p {high:.4f} with tau0 5 MPa, {low:.4f} with 2 MPa",
        judge(0.004 < low < 0.015, 0.004 < high < 0.015),
    )


@TRIBOLOGY("21")
def _regime(evidence: Evidence) -> Verdict:
    shares = []
    for c in evidence.contacts.values():
        eyring = c.loaded("state") == EYRING
        tau0 = c.cycle.motion.problem.model.kernel_parameters.thermal_oil.tau0
        stress = c.loaded("newtonian_stress")
        shares.append(float(np.mean(eyring & (stress > tau0))))
    return Verdict(
        f"{100.0 * min(shares):.0f} to {100.0 * max(shares):.0f} % of the states",
        judge(min(shares) == 1.0, min(shares) > 0.9),
    )


@TRIBOLOGY("22")
def _unloaded_share(evidence: Evidence) -> Both:
    ours = float(np.mean(evidence.contacts[1.0, COLD].cycle.motion.orbit.force == 0.0))
    theirs = [c.up(1.0).separation_share for c in evidence.mismatched.values()]
    inside = [0.25 <= s <= 0.45 for s in theirs[1:]]
    return Both(
        f"{100.0 * ours:.0f} %",
        judge(0.25 <= ours <= 0.45),
        " / ".join(f"{100.0 * s:.0f}" for s in theirs) + " %",
        judge(all(inside), any(inside)),
    )


@TRIBOLOGY("23")
def _fast_film(evidence: Evidence) -> Verdict:
    fast = evidence.contacts[1.0, COLD]
    film = fast.loaded("film_thickness")
    peaks = _peaks(fast)
    top = UM * film.max()
    return Verdict(
        f"peak {top:.2f} um, {peaks} peaks of a pair's film",
        judge(0.7 < top < 1.2 and peaks == 2, 0.7 < top < 1.2),
    )


@TRIBOLOGY("24")
def _entrainment(evidence: Evidence) -> Verdict:
    fast, slow = (evidence.contacts[r, COLD] for r in (1.0, 0.3))
    ratio = _top(fast, "entrainment_speed") / _top(slow, "entrainment_speed")
    return Verdict(f"{ratio:.2f}", judge(2.7 < ratio < 3.4))


@TRIBOLOGY("25")
def _fast_heat(evidence: Evidence) -> Verdict:
    fast, slow = (evidence.contacts[r, COLD] for r in (1.0, 0.3))
    rise = 100.0 * _top(fast, "rise_effective") / COLD
    centre = 100.0 * _top(fast, "rise_centre") / COLD
    drop = 100.0 * (1.0 - _top(fast, "effective_viscosity") / _top(slow, "effective_viscosity"))
    heat, thin = 12.0 < rise < 25.0, 20.0 < drop < 60.0
    return Verdict(
        f"rise {rise:.0f} % (effective), {centre:.0f} % (middle); viscosity {drop:.0f} % lower",
        judge(heat and thin, heat or thin),
    )


@TRIBOLOGY("26")
def _hot_film(evidence: Evidence) -> Verdict:
    hot, cold = (evidence.contacts[0.3, T] for T in (HOT, COLD))
    ratio = _top(hot, "film_thickness") / _top(cold, "film_thickness")
    mid = UM * hot.loaded("film_thickness", MID)
    good, inside = 0.2 < ratio < 0.3, 0.09 < mid.max() < 0.16
    return Verdict(
        f"{mid.max():.2f} um mid, {UM * _hardest_film(hot):.2f} um at the highest load; ratio "
        f"{ratio:.2f}",
        judge(good and inside, good or inside),
        f"consistent film {UM * evidence.consistent[HOT].at_hardest('film_thickness'):.2f} um",
    )


@TRIBOLOGY("27")
def _hot_shear(evidence: Evidence) -> Verdict:
    hot, cold = (_top(evidence.contacts[0.3, T], "shear_rate") for T in (HOT, COLD))
    return Verdict(
        f"{hot / cold:.1f} times",
        judge(2.0 < hot / cold < 6.0),
    )


@TRIBOLOGY("28")
def _hot_boundary(evidence: Evidence) -> Verdict:
    low, high = (
        _top(c, "boundary_friction") / _top(c, "viscous_friction")
        for c in (evidence.contacts[0.3, HOT], evidence.high_stress[HOT])
    )
    return Verdict(
        f"{100.0 * low:.0f} % with tau0 2 MPa, {100.0 * high:.0f} % with 5 MPa",
        judge(0.1 < low < 0.4, 0.1 < high < 0.4),
    )


@TRIBOLOGY("29")
def _hot_temperature(evidence: Evidence) -> Verdict:
    hot = evidence.contacts[0.3, HOT]
    centre = HOT - 273.15 + _top(hot, "rise_centre")
    high = HOT - 273.15 + _top(evidence.high_stress[HOT], "rise_centre")
    return Verdict(
        f"{centre:.0f} degC in the middle of the film ({high:.0f} with tau0 5 MPa)",
        OPEN,
    )


@TRIBOLOGY("30")
def _hot_viscosity(evidence: Evidence) -> Verdict:
    contacts = [evidence.contacts[0.3, T] for T in (HOT, COLD)]
    hot, cold = (_top(one, "effective_viscosity") for one in contacts)
    oil = contacts[0].cycle.motion.problem.model.parameters.oil
    inlet = oil.dynamic_viscosity(HOT) / oil.dynamic_viscosity(COLD)
    return Verdict(
        f"{hot / cold:.3f}",
        judge(0.2 < hot / cold < 0.5),
        f"each over the viscosity of its own inlet: {hot / cold / inlet:.2f}",
    )


@TRIBOLOGY("31")
def _hot_friction(evidence: Evidence) -> Verdict:
    def change(hot: Contacts, cold: Contacts) -> float:
        largest = [float(np.max(np.abs(c.total("torque_pinion")))) for c in (hot, cold)]
        return 100.0 * (largest[0] / largest[1] - 1.0)

    texts = [
        f"{change(evidence.contacts[0.3, HOT], evidence.contacts[0.3, COLD]):+.0f} %",
        f"{change(evidence.high_stress[HOT], evidence.high_stress[COLD]):+.0f} % with tau0 5 MPa",
        f"{change(evidence.consistent[HOT], evidence.consistent[COLD]):+.0f} % with the consistent "
        "film",
    ]
    return Verdict(", ".join(texts), OPEN)


def _range(values: Array) -> str:
    return f"{values.min():.3g} to {values.max():.3g}"


def _top(contacts: Contacts, name: str) -> float:
    return float(contacts.loaded(name).max())


def _hardest_film(contacts: Contacts) -> float:
    return contacts.at_hardest("film_thickness")


def _load_exponents(contacts: Contacts) -> tuple[float, float]:
    """Return d ln h/d ln W at the hardest loaded contact: film at inlet and as it is run."""
    p = contacts.cycle.motion.problem.model.kernel_parameters
    inlet = p._replace(thermal=p.thermal._replace(film_temperature=INLET))
    return _exponent(contacts, inlet), _exponent(contacts, p)


def _exponent(contacts: Contacts, p: TorsionalParameters) -> float:
    motion = contacts.cycle.motion
    pair, sample = contacts.cycle.hardest
    rows = motion.problem.model.rows(motion.orbit.x.size)[::2]
    load = contacts.at_hardest("load")
    speeds = float(motion.orbit.pinion_speed[sample]), float(motion.orbit.gear_speed[sample])
    at = PAIRS_AT + pair * N_CHANNELS
    films = [
        thermal_pair(rows, sample, at, float(load * factor), *speeds, p).film_thickness
        for factor in (1.0 - _STEP, 1.0 + _STEP)
    ]
    return math.log(films[1] / films[0]) / math.log((1.0 + _STEP) / (1.0 - _STEP))


def _boundary_share(contacts: Contacts) -> Array:
    return contacts.loaded("boundary_friction") / contacts.loaded("viscous_friction")


def _viscosity_ratio(contacts: Contacts) -> float:
    oil = contacts.cycle.motion.problem.model.parameters.oil
    return _top(contacts, "effective_viscosity") / oil.dynamic_viscosity(COLD)


def _departure(contacts: Contacts) -> float:
    """Return tau/p where the traction curve is a tenth below its line at the origin."""
    curve = traction_curve(contacts.cycle)
    stress = curve.stress["thermal_eyring"]
    below = stress / (curve.viscosity * SHEAR_RATES)
    log = np.interp(-0.9, -below, np.log(stress))
    return float(np.exp(log) / curve.pressure)


def _peaks(contacts: Contacts) -> int:
    """Return the number of local maxima of a pair's film where it carries, ends included."""
    load, film = contacts.course("load"), contacts.course("film_thickness")
    film = np.where(load > 0.1 * contacts.static_load, film, 0.0)
    inner = (film[1:-1] > film[:-2]) & (film[1:-1] >= film[2:])
    return int(np.count_nonzero(inner))
