"""What solved films cost the axle: `python -m benchmarks.bench_solved_film [--fmu [--rollers]]
[--pair]`.

Processor time of communication steps by formula and by the film model, turn by turn in one process.
Each turn starts from the same state: with less friction an axle speeds up and takes more steps.
The bare axle does so within a turn, by one per cent in 20 ms, so that nodes are evaluated more
often than in a car. With `--fmu` the same through HypoidAxle.fmu and FMPy, over the same time. With
`--pair` it is the helical pair of He et al. at 1000 rpm, whose load holds its speed. FMUs are timed
in Python and native. With `--rollers` the FMU of the axle has solved films in its bearings as well,
against formulas with Biboulet and Houpert's law, which goes from roller to roller too.
"""

from __future__ import annotations

import argparse
import logging
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from fmpy import extract, fmi2, read_model_description

from fmu_src.build import build_helical_pair, build_hypoid_axle, build_models
from fmu_src.native.build import NativeOptions
from fmu_src.native.platforms import platform_of_this_machine
from gearlube_core.dynamics.helical_model.model import HelicalPairModel
from gearlube_core.dynamics.helical_pair.march.gear_file_march import helical_march_parameters
from gearlube_core.dynamics.hypoid_axle import HypoidAxle, mohammadpour_2015_axle
from gearlube_core.dynamics.hypoid_mesh.parameters import Film
from gearlube_core.helical_geometry.gear_file import HelicalGearFile

_LOGGER = logging.getLogger("bench_solved_film")
_OIL = 368.15  # K
_POINT = 240.4, 66.2, 176.0  # rad/s, N.m, N.m: 100 km/h
_PAIR_OIL = 353.15  # K
_PAIR_POINT = 104.71975511965977, 225.97, 280.2028  # rad/s, N.m, N.m: 1000 rpm, 2000 lbf in
_PAIR_GAIN = 1.0  # N.m s/rad
_SIMULATED = 0.05  # s
_TURNS = 25


def running(film: Film) -> HypoidAxle:
    """Return an axle at 100 km/h that has run in."""
    axle = HypoidAxle(replace(mohammadpour_2015_axle(), film=film))
    speed, torque, load = _POINT
    axle.initialise(
        pinion_speed=speed, pinion_torque=torque, wheel_torque=load, oil_temperature=_OIL
    )
    for _ in range(20):
        axle.step(1e-3, torque, load, _OIL)
    return axle


def cpu_time(axle: HypoidAxle, h: float) -> float:
    """Return what steps of `h` [s] over the simulated time took [s]."""
    state = axle.get_state()
    begin = time.process_time()
    for _ in range(round(_SIMULATED / h)):
        axle.step(h, *_POINT[1:], _OIL)
    taken = time.process_time() - begin
    axle.set_state(state)
    return taken


def begun_fmu(
    folder: Path, options: dict[str, str], starts: dict[str, float]
) -> tuple[Any, dict[str, int]]:
    """Return an instance that is past its initialisation, and references by name of variable."""
    description = read_model_description(str(folder))
    place = {v.name: v.valueReference for v in description.modelVariables}
    fmu = fmi2.FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="timed",
    )
    fmu.instantiate()
    for option in description.modelVariables:
        for item in option.declaredType.items if option.name in options else ():
            if item.name == options[option.name]:
                fmu.setInteger([option.valueReference], [int(item.value)])
    fmu.setReal([place[name] for name in starts], list(starts.values()))
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    return fmu, place


def running_fmu(folder: Path, options: dict[str, str]) -> Callable[[float], float]:
    """Return `cpu_time` of an instance of the FMU that has run in."""
    speed, *torques = _POINT
    starts = {"pinion.speed_start": speed, "oil.temperature": _OIL}
    starts |= {"pinion.torque": torques[0], "wheel.torque": torques[1]}
    fmu, place = begun_fmu(folder, options, starts)
    inputs = [place["pinion.torque"], place["wheel.torque"]]
    outputs = [place[name] for name in ("mesh.dte", "pinion.speed", "wheel.speed", "pinion.angle")]
    now = 0.0

    def taken(h: float) -> float:
        nonlocal now
        state, start = fmu.getFMUstate(), now
        begin = time.process_time()
        for _ in range(round(_SIMULATED / h)):
            fmu.setReal(inputs, torques)
            fmu.doStep(now, h)
            fmu.getReal(outputs)
            now += h
        spent = time.process_time() - begin
        fmu.setFMUstate(state)
        fmu.freeFMUstate(state)
        now = start
        return spent

    for _ in range(20):
        fmu.doStep(now, 1e-3)
        now += 1e-3
    return taken


def compare(formula: Callable[[float], float], solved: Callable[[float], float]) -> None:
    """Log how both do, by what each takes for steps of a size."""
    for h in (1e-4, 1e-3):
        turns = [(formula(h), solved(h)) for _ in range(_TURNS)]
        least = [min(one[k] for one in turns) for k in (0, 1)]
        ratio = statistics.median(one[0] / one[1] for one in turns)
        _LOGGER.info(
            "%g s: %.1f simulated seconds a second by formula, %.1f solved; ratio %.3f of the "
            "least times, %.3f of the median turn",
            h, _SIMULATED / least[0], _SIMULATED / least[1], least[0] / least[1], ratio,
        )  # fmt: skip


def compare_pair() -> None:
    """Compare both in the helical pair as a Python model."""
    models = []
    for film in ("formula", "solved"):
        parameters = helical_march_parameters(HelicalGearFile.named("he_2007"))
        model = HelicalPairModel(replace(parameters, film=film))
        speed, torque, load = _PAIR_POINT
        model.initialise(
            pinion_speed=speed, pinion_torque=torque, wheel_torque=load, oil_temperature=_PAIR_OIL
        )
        models.append(model)

    def held(model: HelicalPairModel, h: float) -> float:
        state = model.get_state()
        begin = time.process_time()
        for _ in range(round(_SIMULATED / h)):
            speed, loss = model.output("pinion.speed"), model.output("friction.power_loss")
            model.step(h, _PAIR_POINT[1], holding_load(speed, loss), _PAIR_OIL)
        taken = time.process_time() - begin
        model.set_state(state)
        return taken

    for model in models:
        for _ in range(100):
            speed, loss = model.output("pinion.speed"), model.output("friction.power_loss")
            model.step(1e-3, _PAIR_POINT[1], holding_load(speed, loss), _PAIR_OIL)
    formula, solved = models
    compare(lambda h: held(formula, h), lambda h: held(solved, h))


def holding_load(speed: float, loss: float) -> float:
    """Return the wheel torque that holds the speed of the pair [N.m]."""
    _, torque, load = _PAIR_POINT
    return load - load / torque * loss / speed + _PAIR_GAIN * (speed - _PAIR_POINT[0])


def running_pair_fmu(folder: Path, film: str) -> Callable[[float], float]:
    """Return what steps of an instance of HelicalPair.fmu that has run in take [s]."""
    fmu, place = begun_fmu(folder, {"film.model": film}, {"oil.temperature": _PAIR_OIL})
    inputs = [place["pinion.torque"], place["wheel.torque"]]
    outputs = [place[name] for name in ("pinion.speed", "friction.power_loss", "mesh.dte")]
    outputs.append(place["mesh.film_thickness_min"])
    now, found = 0.0, [_PAIR_POINT[0], 0.0]

    def run(h: float, steps: int) -> float:
        nonlocal now, found
        begin = time.process_time()
        for _ in range(steps):
            fmu.setReal(inputs, [_PAIR_POINT[1], holding_load(found[0], found[1])])
            fmu.doStep(now, h)
            found = fmu.getReal(outputs)
            now += h
        return time.process_time() - begin

    run(1e-3, 200)
    return lambda h: run(h, round(_SIMULATED / h))


def compare_fmus(pair: bool, rollers: bool) -> None:
    """Compare both in FMUs of the axle or the pair, in Python and native."""
    kinds = [{"film.model": film} for film in ("formula", "solved")]
    if rollers:
        for kind, law in zip(kinds, ("biboulet_houpert_2010", "solved_films"), strict=True):
            kind["bearing.torque_loss"] = law
    native = NativeOptions(platforms=[platform_of_this_machine()], fmi=["2"])
    with tempfile.TemporaryDirectory() as name:
        (made,) = build_models(
            Path(name) / "native", "helical-pair" if pair else "hypoid-axle", native=native
        )
        in_python = build_helical_pair(name) if pair else build_hypoid_axle(Path(name))
        for words, path in (("Python", in_python), ("native", made)):
            folder = Path(extract(str(path), str(Path(name) / words)))
            _LOGGER.info(words)
            if pair:
                compare(*(running_pair_fmu(folder, kind["film.model"]) for kind in kinds))
            else:
                compare(*(running_fmu(folder, kind) for kind in kinds))


def main() -> None:
    """Compare both at two communication steps."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--fmu", action="store_true")
    options.add_argument("--rollers", action="store_true")
    options.add_argument("--pair", action="store_true")
    chosen = options.parse_args()
    if chosen.rollers and (chosen.pair or not chosen.fmu):
        options.error("--rollers is for the FMU of the axle: give --fmu, without --pair.")
    if chosen.fmu:
        compare_fmus(chosen.pair, chosen.rollers)
        return
    if chosen.pair:
        compare_pair()
        return
    formula, solved = running("formula"), running("solved")
    compare(lambda h: cpu_time(formula, h), lambda h: cpu_time(solved, h))


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    main()
