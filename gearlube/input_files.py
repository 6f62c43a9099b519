"""Input files of a command, read and checked before what computes is imported."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import wraps
from pathlib import Path
from typing import Any

from gearlube.cli.exit_codes import exit_on_error

# models of a file by what stands for it in the help, or by the command that takes it
_MODELS = {
    "AXLE": ("AxleFile",),
    "map": ("AxleFile",),
    "sweep": ("AxleFile",),
    "cycle": ("AxleFile",),
    "AXLE|PAIR": ("AxleFile", "HelicalGearFile"),
    "GEAR": ("HypoidGearFile", "HelicalGearFile"),
    "contact": ("HypoidGearFile",),
    "helical": ("HelicalGearFile",),
    "BLANK": ("BlankFile",),
    "BEARING": ("BearingFile",),
    "bearing": ("BearingFile",),
    "resonance": (),  # a mesh table
    "OIL": ("OilFile",),
    "PROBLEM": ("OptimisationFile",),
    "TRAIN": ("TrainFile",),
    "measured": ("MeasuredFile",),
    "line": ("LineCase",),
    "point": ("PointCase",),
    "hypoid": ("HypoidCase",),
    "rough": ("RoughCase",),
}
_OTHER_NAMES = {"OilFile", "MeasuredFile"}  # oils have other names too, measured gears none
_CYCLE = "NAME|FILE"
_BY_COMMAND = ("GEAR", "CASE", "FILE")


def read_files_first(command: Any) -> None:
    """Make a command and its subcommands refuse wrong files before they load what computes."""
    for one in getattr(command, "commands", {}).values():
        read_files_first(one)
    run = command.callback

    def after_reading(**given: Any) -> Any:
        for one in command.params:
            values, word = given.get(one.name), one.metavar or ""
            models = _MODELS.get(word, ())
            if word in _BY_COMMAND and one.param_type_name == "argument":
                models = _MODELS.get(given.get("study", command.name), models)
            for value in values if isinstance(values, list | tuple) else [values]:
                if isinstance(value, str | Path) and one.name not in ("out", "program"):
                    _check_file(str(value), models)
                    if word == _CYCLE and not Path(value).suffix and not os.path.exists(value):
                        _check_cycle(str(value))
        return run(**given)

    if run is not None:
        command.callback = wraps(run)(after_reading)


def _check_file(value: str, models: Sequence[str]) -> None:
    """Exit with the reason where `value` is the path of a file that is missing or wrong.

    Fields of TOML are checked; archives must not claim more than they may. Without `models`, the
    kinds of files that are allowed, a path that is not there passes: it may be a result's.
    """
    path = Path(value)
    with exit_on_error():
        if value.endswith(".toml") and models:
            from gearlube_core.input_file.early_check import check_early

            check_early(value, models)
        elif value and models and not path.suffix and not {*models} & _OTHER_NAMES:
            from gearlube_core.input_file.early_check import check_name

            check_name(value, models)
        elif value.endswith(".toml") and os.path.lexists(value):
            from gearlube_core.input_file.input_file import read_toml

            read_toml(value)
        elif value.endswith(".fmu") and path.is_file():
            from gearlube.studies.sweep.unpack import check_fmu

            check_fmu(path)
        elif value.endswith((".npz", ".x3p")) and path.is_file():
            from gearlube_core.storage.atomic_file import check_unpacked

            check_unpacked(path)


def _check_cycle(name: str) -> None:
    """Exit with the reason where no cycle has this name."""
    from drivetrain.cycle.traces import NAMED, DriveCycle

    with exit_on_error():
        if name.lower() not in NAMED:
            DriveCycle.given(name)
