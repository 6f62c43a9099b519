"""The teeth of a helical or spur pair for a damage run, and their rating by ISO 6336."""

from __future__ import annotations

import hashlib
import math
import pickle
import tomllib
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import numpy as np

from gearlube.damage.bins import bin_words
from gearlube.damage.permissible_film import permissible_line_ratio
from gearlube.damage.teeth import Beside, Row, Teeth, safety_row
from gearlube.plotting.drawn_tooth import ToothWords
from gearlube.report.numbers import number_text
from gearlube.studies.helical.settings import HelicalSettings
from gearlube.studies.helical.stages import analyse_loaded_contact
from gearlube_core.checks import check_option, check_within
from gearlube_core.dynamics.helical_pair.flank_states import face_load, helical_flank_states
from gearlube_core.errors import ParameterError
from gearlube_core.friction.flank_states import FlankStates
from gearlube_core.helical_contact.contact_dataset import HelicalContact
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.pair import HelicalPair
from gearlube_core.progress import Progress, no_progress
from gearlube_core.rating.flank_load import FlankLoad, FlankOil
from gearlube_core.rating.gears import Gears, LoadFactors
from gearlube_core.rating.iso_6336 import EDITIONS, cylindrical_rating
from gearlube_core.rating.micropitting import micropitting_rating
from gearlube_core.rating.scuffing import flash_rating, integral_rating
from gearlube_core.rating.spectrum import DutyBins
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


def check_options(pair: bool, of_axle: Mapping[str, object], of_pair: Mapping[str, object]) -> None:
    """Raise ParameterError where an option is given that the gears do not take."""
    wrong = [name for name, value in (of_axle if pair else of_pair).items() if value is not None]
    if wrong:
        here, there = ("a gear pair", "an axle") if pair else ("an axle", "a gear pair")
        raise ParameterError(
            f"{wrong[0]} works only with {there}, got {here}. Leave it out, or give {there}."
        )


def pair_settings(file: HelicalGearFile, bins: DutyBins, **given: object) -> HelicalSettings:
    """Return the settings of a loaded contact that spans the torques of bins.

    Other fields of `HelicalSettings` may be given: oil, roughness, film model. Raises
    ParameterError where a bin has no torque, or a field is wrong.

    Examples
    --------
    >>> import gearlube as gl
    >>> bins = gl.rating.duty_bins([3600.0], [300.0], [200.0], 353.15, widths=(10.0, 10.0, 10.0))
    >>> pair_settings(HelicalGearFile.named("he_2007"), bins).torques  # N.m
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
    settings: HelicalSettings, contact: HelicalContact | None = None, *, edition: str = "2006",
    load_stage: float | None = None, test_torque: float | None = None, store: Path | None = None,
    jobs: int | None = None, progress: Progress = no_progress,
) -> Teeth:  # fmt: skip
    """Return the teeth of a pair, for `DamageSettings`.

    Parameters
    ----------
    settings, contact
        See `pair_settings`; loaded contact of these settings, None: it is solved here.
    edition
        Of ISO 6336-1, -2, -3, see `cylindrical_rating`.
    load_stage, test_torque
        Failure load stage of the oil in the FZG test A/8.3/90 [-], None: scuffing by the standard
        is withheld; its pinion torque [N.m], None: a formula not checked against the source.
    store, jobs, progress
        Folder that keeps finished positions of the loaded contact; its processes; called with the
        share that is done and a sentence.

    Raises
    ------
    ParameterError
        A number is out of range, or the contact finds no equilibrium.

    Examples
    --------
    >>> import gearlube as gl
    >>> bins = gl.rating.duty_bins([3600.0], [300.0], [200.0], 353.15, widths=(10.0, 10.0, 10.0))
    >>> settings = pair_settings(gl.HelicalGearFile.named("he_2007"), bins)
    >>> teeth = helical_teeth(settings)  # doctest: +SKIP
    >>> damage = gl.studies.DamageSettings(pair=teeth, bins=bins)  # doctest: +SKIP
    """
    check_option("edition", edition, EDITIONS)
    if load_stage is not None:
        check_within("load_stage", load_stage, 1.0, 20.0, "", "12 is usual.")
    pair, film = settings.file.helical_pair(), settings.film()
    if contact is None:
        contact = analyse_loaded_contact(settings, store=store, jobs=jobs, progress=progress)
    mesh = contact.line_mesh
    # without the next line to enter and the last one that left
    highest = contact.dataset["pressure_max"].values[..., 1:-1].swapaxes(0, 1)
    # one level stands for all torques
    top = float(mesh.torque[-1]) if mesh.torque.size > 1 else math.inf
    ratio = pair.transverse_contact_ratio
    rated = _RATIOS[0] <= ratio <= _RATIOS[1]
    why = f"the transverse contact ratio must be within 1 to 4, got {ratio:.3f}. Use longer teeth"

    def states(torque: float, speed: float, temperature: float) -> FlankStates:
        return helical_flank_states(
            pair, mesh, film, torque=torque, speed=speed, temperature=temperature, highest=highest
        )

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
        rating=(lambda torque: partial(cylindrical_rating, pair, edition=edition))
        if rated
        else None,
        standard=f"ISO 6336-1, -2, -3:{edition}, method B",
        drawn=_DRAWN,
        drawn_size=(pair.face_width, pair.contact_end - pair.contact_start),
        limits=_LIMITS,
        permissible=partial(permissible_line_ratio, film),
        face=partial(solved_face, pair, states),
        key=hashlib.sha256(pickle.dumps((settings, edition, mesh))).hexdigest(),
        withheld="" if rated else why,
    )
    return teeth._replace(beside=partial(_beside, pair, teeth, load_stage, test_torque))


def _hardest(bins: DutyBins) -> int:
    return int(np.abs(bins.torque).argmax())


def solved_face(
    pair: HelicalPair, states: Callable[[float, float, float], FlankStates], bins: DutyBins
) -> float:
    """Return K_H beta of the solved contact in the bin with the largest torque."""
    return max(face_load(pair, states(*(one[_hardest(bins)] for one in bins[:3])))[0], 1.0)


def _beside(
    pair: HelicalPair, teeth: Teeth, load_stage: float | None, test_torque: float | None,
    bins: DutyBins, gears: Gears | None, factors: LoadFactors,
) -> Beside:  # fmt: skip
    """Return scuffing and micropitting by the standard, and the load factor of the contact."""
    hardest = _hardest(bins)
    face, whole = face_load(pair, teeth.states(*(one[hardest] for one in bins[:3])))
    note = (
        f"K_Hβ is {factors.face:.2f} in the standard and {face:.2f} in the solved contact.",
        f"Greatest over mean load along the face, in the bin {bin_words(bins, hardest)}. Of all "
        f"places of the contact lines the greatest line load is {whole:.2f} times the mean, which "
        "has the sharing between pairs of teeth in it. Neither is in the standard's stress.",
    )
    modes = ("scuffing: flash temperature", "scuffing: integral temperature",
             "micropitting: specific film of the standard")  # fmt: skip
    rate = None if gears is None else teeth.rate(gears, factors)
    if gears is None or rate is None:
        why = f"withheld: {teeth.withheld or 'the limits of the gears are not given'}"
        return Beside([(mode, "", "", "", "", why, "ISO/TS 6336") for mode in modes], (), (note,))
    rows: list[Row] = []
    outside: dict[str, None] = {}
    loads, scuffs = [], []
    for torque, speed, temperature in zip(*bins[:3], strict=True):
        oil = FlankOil.of(
            teeth.oil, temperature=temperature, load_stage=load_stage, test_torque=test_torque
        )
        rating = rate(float(torque), float(speed), float(temperature))
        load = FlankLoad.of(rating, pair, gears, oil)
        loads.append(load)
        if load_stage is not None:
            force = rating.number("F_t") * rating.number("K_A") * rating.number("K_gam")
            relief = force / (pair.face_width * 1e9 * rating.number("c_ga"))  # N/(mm um) to Pa
            flash = flash_rating(load, friction=load.mean_friction)
            driven = {"effective_relief": relief, "pinion_drives": torque > 0.0}
            scuffs.append((flash, integral_rating(load, **driven)))
    for mode, ratings in zip(modes, zip(*scuffs, strict=True), strict=False):
        worst = min(ratings, key=lambda one: one.safety)
        value, limit = (f"{one - ZERO_CELSIUS:.0f} °C" for one in (worst.temperature, worst.limit))
        by = f"{worst.standard}, friction of -21, no tip relief; "
        by += bin_words(bins, ratings.index(worst))
        rows.append(safety_row(mode, value, limit, worst.safety, "1", "safe", by))
        outside |= dict.fromkeys(worst.outside)
    if load_stage is None:
        why = "withheld: the load stage of the oil is not given (--load-stage)"
        rows += [(mode, "", "", "", "", why, "ISO/TS 6336-20, -21") for mode in modes[:2]]
    films = [micropitting_rating(load, permissible=1.0) for load in loads]
    place = min(range(len(films)), key=lambda i: films[i].safety)
    least, where = films[place], bin_words(bins, place)
    by = f"{least.standard}, alpha of mineral oil; {where}"
    rows.append((modes[2], number_text(least.safety), "", "", "", "no limit given", by))
    return Beside(rows, tuple(outside | dict.fromkeys(least.outside)), (note,))
