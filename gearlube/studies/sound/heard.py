"""The sound of one run or of two: what the study returns."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import xarray as xr

from gearlube.studies.sound.pressure import Pressure
from gearlube.studies.sound.transfer_path import TransferPath


@dataclass(frozen=True, slots=True, kw_only=True)
class HeardRun:
    """The sound of one run.

    Parameters
    ----------
    dataset : xarray.Dataset
        Levels, metrics and orders over time.
    pressure : Pressure
        At the listener.
    path : TransferPath
    wav : str
        Name of its WAV; says the full scale.
    """

    dataset: xr.Dataset
    pressure: Pressure
    path: TransferPath
    wav: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sound:
    """The sound of a run, and of another beside it.

    Parameters
    ----------
    runs : tuple of HeardRun
        One or two.
    full_scale : float
        Pressure at the full scale of every WAV [Pa].
    findings : tuple of str
        What is heard of the first run; with two, first the difference.
    limits : tuple of str
        What the results hold for.
    missing : tuple of str
        Metrics that were asked for and cannot be computed here, and why.
    files : mapping
        Written files by name.
    """

    runs: tuple[HeardRun, ...]
    full_scale: float
    findings: tuple[str, ...]
    limits: tuple[str, ...]
    missing: tuple[str, ...] = ()
    files: Mapping[str, Path] = field(default_factory=dict)

    @property
    def dataset(self) -> xr.Dataset:
        """Levels, metrics and orders of the first run."""
        return self.runs[0].dataset
