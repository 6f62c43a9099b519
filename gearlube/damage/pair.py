"""The teeth of a helical or spur pair, for a damage run, with what ISO 6336 says of them."""

from __future__ import annotations

import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np

from gearlube.damage.bins import bin_words
from gearlube.damage.teeth import Beside, Row, Teeth, safety_row
from gearlube.plotting.drawn_tooth import ToothWords
from gearlube.report.numbers import number_text
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.stages import analyse_loaded_contact
from gearlube_core.checks import check_option, check_within
from gearlube_core.dynamics.helical_pair.flank_states import STRIPS, helical_flank_states
from gearlube_core.errors import ParameterError
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.helical_contact.contact_dataset import HelicalContact
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.progress import Progress, no_progress
from gearlube_core.rating.flank_load import FlankLoad, FlankOil
from gearlube_core.rating.gears import Gears, LoadFactors, StrengthRating
from gearlube_core.rating.iso_6336 import EDITIONS, cylindrical_rating
from gearlube_core.rating.micropitting import micropitting_rating
from gearlube_core.rating.scuffing import ScuffingRating, flash_rating, integral_rating
from gearlube_core.rating.spectrum import DutyBins, Rate
from gearlube_core.units import ZERO_CELSIUS

STEPS = (0.1, 0.25, 0.5, 0.75, 1.0)  # of the largest torque, at which the contact is solved
_LEAST_STEP = 0.02  # of it; below, the load is divided as there
_RATIOS = 1.0, 4.0  # transverse contact ratio that the formulas of ISO 6336 take
_DRAWN = ToothWords(
    "along the face", "path of contact", "", "", "E", "A",
    "Drawn on the plane of contact, for both members: from A, root of the pinion, to E, its tip.",
)  # fmt: skip
_LIMITS = (
    "Pressure is that of Hertz under the solved load of each strip of the contact lines. At a "
    "sharp edge the true pressure is higher.",
    "The flanks are as warm as the oil: no bulk temperature is solved.",
    "Coast flanks bear as drive flanks do: both sides of a tooth have one form.",
)


def is_pair(name: str) -> bool:
    """Return whether a name or a file is that of a helical or spur pair.

    >>> is_pair("he_2007"), is_pair("mohammadpour_2015")
    (True, False)
    """
    if name in HelicalGearFile.shipped():
        return True
    try:
        return "centre_distance_mm" in tomllib.loads(Path(name).read_text("utf-8")).get("pair", {})
    except (OSError, ValueError):
        return False  # the reader of axle files says what is wrong


def check_options(pair: bool, of_axle: dict[str, object], of_pair: dict[str, object]) -> None:
    """Raise ParameterError where an option is given that the gears do not take."""
    wrong = [name for name, value in (of_axle if pair else of_pair).items() if value is not None]
    if wrong:
        here, there = ("a gear pair", "an axle") if pair else ("an axle", "a gear pair")
        raise ParameterError(
            f"{wrong[0]} works only with {there}, got {here}. Leave it out, or give {there}."
        )


def pair_settings(file: HelicalGearFile, bins: DutyBins, **given: object) -> HelicalSettings:
    """Return the settings of a loaded contact that spans the torques of bins.

    Parameters
    ----------
    file
        Gear file.
    bins
        Of the life; the largest torque is the operating point.
    **given
        Other fields of `HelicalSettings`: oil, roughness, film model.

    Raises
    ------
    ParameterError
        A bin has no torque, or a field is wrong.

    Examples
    --------
    >>> import gearlube as gl
    >>> bins = gl.duty_bins([3600.0], [300.0], [200.0], 353.15, widths=(10.0, 10.0, 10.0))
    >>> pair_settings(HelicalGearFile.named("he_2007"), bins).torques
    (30.0, 75.0, 150.0, 225.0, 300.0)
    """
    torque = np.abs(bins.torque)
    if not (torque > 0.0).all():
        raise ParameterError(
            "The torque of each bin must not be 0 N.m, got 0: without load there is no contact. "
            "Leave the bin out."
        )
    hardest = int(torque.argmax())
    top = float(torque[hardest])
    least = max(float(torque.min()), _LEAST_STEP * top)
    steps = {*(top * step for step in STEPS), min(least, STEPS[0] * top)}
    return HelicalSettings(
        file=file, pinion_torque=top, pinion_speed=float(bins.speed[hardest]),
        torques=tuple(sorted(steps)), parts="contact",
        oil_temperature=float(bins.temperature[hardest]), **given,  # type: ignore[arg-type]
    )  # fmt: skip


def helical_teeth(
    settings: HelicalSettings,
    contact: HelicalContact | None = None,
    *,
    edition: str = "2006",
    load_stage: float | None = None,
    jobs: int | None = None,
    progress: Progress = no_progress,
) -> Teeth:
    """Return the teeth of a pair, for `DamageSettings`.

    Parameters
    ----------
    settings
        Gear file, oil, roughness, friction, film model; torques of the loaded contact, see
        `pair_settings`.
    contact
        Loaded contact of these settings; None: it is solved here.
    edition
        Of ISO 6336-1, -2, -3, see `cylindrical_rating`.
    load_stage
        Failure load stage of the oil in the FZG test A/8.3/90 [-]; None: scuffing by the standard
        is withheld.
    jobs, progress
        Processes of the loaded contact; called with the share that is done and a sentence.

    Raises
    ------
    ParameterError
        A number is out of range, or the contact finds no equilibrium.

    Examples
    --------
    >>> import gearlube as gl
    >>> bins = gl.duty_bins([3600.0], [300.0], [200.0], 353.15, widths=(10.0, 10.0, 10.0))
    >>> settings = pair_settings(gl.HelicalGearFile.named("he_2007"), bins)
    >>> damage = gl.DamageSettings(pair=helical_teeth(settings), bins=bins)  # doctest: +SKIP
    """
    check_option("edition", edition, EDITIONS)
    if load_stage is not None:
        check_within("load_stage", load_stage, 1.0, 20.0, "", "12 is usual.")
    pair, film = settings.file.helical_pair(), settings.film()
    if contact is None:
        contact = analyse_loaded_contact(settings, jobs=jobs, progress=progress)
    mesh = contact.line_mesh
    # without the next line to enter and the last one that left
    highest = contact.dataset["pressure_max"].values[..., 1:-1].swapaxes(0, 1)
    # one level stands for all torques
    top = float(mesh.torque[-1]) if mesh.torque.size > 1 else math.inf
    ratio = pair.transverse_contact_ratio
    nu = float(film.oil.state(ZERO_CELSIUS + 40.0).nu)

    def states(torque: float, speed: float, temperature: float) -> FlankStates:
        return helical_flank_states(
            pair, mesh, film, torque=torque, speed=speed, temperature=temperature, highest=highest
        )

    def rate(gears: Gears, factors: LoadFactors) -> Rate:
        def rated(torque: float, speed: float, temperature: float) -> StrengthRating:
            return cylindrical_rating(
                pair, gears, factors, pinion_torque=abs(torque), pinion_speed=speed,
                cycles=(1.0, 1.0), oil_viscosity=nu, edition=edition,
            )  # fmt: skip

        return rated

    within = _RATIOS[0] <= ratio <= _RATIOS[1]
    teeth = Teeth(
        name=pair.name,
        ratio=pair.ratio,
        oil=film.oil,
        solid=film.solid,
        film=film.film,
        torques=(-top, top),
        cure="The contact is solved up to there: give larger torques to the settings of the pair.",
        solved_torque=top,
        states=states,
        rate=rate if within else None,
        withheld="" if within else (
            f"the transverse contact ratio must be within 1 to 4, got {ratio:.3f}. Use longer teeth"
        ),
        standard=f"ISO 6336-1, -2, -3:{edition}, method B",
        drawn=_DRAWN,
        drawn_size=(pair.face_width, pair.contact_end - pair.contact_start),
        limits=_LIMITS,
    )  # fmt: skip

    def beside(bins: DutyBins, gears: Gears | None, factors: LoadFactors) -> Beside:
        return _beside(settings, teeth, bins, gears, factors, load_stage)

    return replace(teeth, beside=beside)


def _beside(
    settings: HelicalSettings,
    teeth: Teeth,
    bins: DutyBins,
    gears: Gears | None,
    factors: LoadFactors,
    load_stage: float | None,
) -> Beside:
    """Return scuffing and micropitting by the standard, and the load factor of the contact."""
    hardest = int(np.abs(bins.torque).argmax())
    found = teeth.states(*(float(one[hardest]) for one in bins[:3]))
    face, whole = face_load(found)
    note = (
        f"K_Hβ is {factors.face:.2f} in the standard and {face:.2f} in the solved contact.",
        f"Greatest over mean load along the face, in the bin {bin_words(bins, hardest)}. Of all "
        f"places of the contact lines the greatest line load is {whole:.2f} times the mean, which "
        "has the sharing between pairs of teeth in it. Neither is in the standard's stress.",
    )
    modes = ("scuffing: flash temperature", "scuffing: integral temperature",
             "micropitting: specific film of the standard")  # fmt: skip
    if gears is None or teeth.rate is None:
        why = f"withheld: {teeth.withheld or 'the limits of the gears are not given'}"
        return Beside([(mode, "", "", "", "", why, "ISO/TS 6336") for mode in modes], (), (note,))
    rate, pair = teeth.rate(gears, factors), settings.file.helical_pair()
    rows: list[Row] = []
    outside: dict[str, None] = {}
    loads = []
    for torque, speed, temperature in zip(*bins[:3], strict=True):
        oil = FlankOil.of(teeth.oil, temperature=float(temperature), load_stage=load_stage)
        rating = rate(float(torque), float(speed), float(temperature))
        yields = rating.number("F_t") * rating.number("K_A") * rating.number("K_gam")
        relief = yields / (pair.face_width * 1e9 * rating.number("c_ga"))  # N/(mm um) to Pa
        loads.append((FlankLoad.of(rating, pair, gears, oil), relief, torque > 0.0))
    if load_stage is None:
        why = "withheld: the load stage of the oil is not given (--load-stage)"
        rows += [(mode, "", "", "", "", why, "ISO/TS 6336-20, -21") for mode in modes[:2]]
    else:
        flash = [flash_rating(load, friction=load.mean_friction) for load, _, _ in loads]
        integral = [
            integral_rating(load, effective_relief=relief, pinion_drives=drives)
            for load, relief, drives in loads
        ]
        for mode, ratings in zip(modes, (flash, integral), strict=False):
            worst = min(ratings, key=lambda one: one.safety)
            rows.append(_scuffing_row(mode, worst, bins, ratings.index(worst)))
            outside |= dict.fromkeys(worst.outside)
    films = [micropitting_rating(load, permissible=1.0) for load, _, _ in loads]
    least = min(range(len(films)), key=lambda i: films[i].safety)
    by = f"{films[least].standard}, alpha of mineral oil; {bin_words(bins, least)}"
    value = number_text(films[least].safety)
    rows.append((modes[2], value, "", "", "", "no limit given", by))
    outside |= dict.fromkeys(films[least].outside)
    return Beside(rows, tuple(outside), (note,))


def _scuffing_row(mode: str, rating: ScuffingRating, bins: DutyBins, place: int) -> Row:
    value, limit = (f"{one - ZERO_CELSIUS:.0f} °C" for one in (rating.temperature, rating.limit))
    by = f"{rating.standard}, friction of -21, no tip relief; {bin_words(bins, place)}"
    return safety_row(mode, value, limit, rating.safety, "1", "safe", by)


def face_load(states: FlankStates) -> tuple[float, float]:
    """Return greatest over mean line load: along the face over a mesh period, and anywhere [-].

    Along the face the load of a place counts over what even lines carry there at the same phases.

    Examples
    --------
    >>> import gearlube as gl
    >>> from gearlube_core.dynamics.helical_pair.flank_states import helical_flank_states
    >>> settings = gl.HelicalSettings(
    ...     file=gl.HelicalGearFile.named("he_2007"), pinion_torque=200.0, pinion_speed=100.0
    ... )
    >>> found = helical_flank_states(
    ...     settings.file.helical_pair(), settings.constant_mesh(), settings.film(),
    ...     torque=200.0, speed=100.0, temperature=353.15,
    ... )
    >>> [round(one, 2) for one in face_load(found)]
    [1.0, 1.07]
    """
    width = float(states.place[:, 0].max() + states.place[:, 0].min())
    strip = np.minimum((states.place[:, 0] / width * STRIPS).astype(int), STRIPS - 1)
    length = 2.0 * states.semi_major
    at = np.unique(np.mod(states.phase, 1.0).round(9), return_inverse=True)[1]
    even = (np.bincount(at, states.load) / np.bincount(at, length))[at] * length
    along = np.bincount(strip, states.load) / np.bincount(strip, even)
    mean = states.load.sum() / length.sum()
    return float(along.max()), float(states.line_load.max() / mean)
