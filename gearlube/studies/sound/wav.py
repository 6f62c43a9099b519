"""WAV files with a stated full scale."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from gearlube.studies.sound.pressure import RATE, resampled
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import atomic_write
from gearlube_core.storage.file_names import file_stem, told_apart

_LARGEST = 32767  # of 16 bits
OWN_WAV = "*_full_scale_*_Pa.wav"  # what a study writes, see `wav_names`
_STEPS = (1.0, 2.0, 5.0)


def full_scale_for(peak: float) -> float:
    """Return the next of ... 0.1, 0.2, 0.5, 1 ... Pa above a peak [Pa].

    Examples
    --------
    >>> full_scale_for(0.31), full_scale_for(0.5), full_scale_for(0.0)
    (0.5, 1.0, 1.0)
    """
    if peak <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(peak))
    for step in (*_STEPS, 10.0):
        if step * power > peak * 1.000001:
            return float(f"{step * power:.6g}")
    return float(f"{20.0 * power:.6g}")


def played(pressure: Array, rate: int) -> Array:
    """Return a pressure at 48 kHz resampled to the rate of the WAV [Pa]."""
    return resampled(pressure, rate / RATE)


def wav_names(runs: Sequence[str], full_scale: float) -> list[str]:
    """Return the names of the WAV files of runs, each of its own: they say the full scale.

    Examples
    --------
    >>> wav_names(["müll", "möll 2"], 0.5)
    ['müll_full_scale_0.5_Pa.wav', 'möll_2_full_scale_0.5_Pa.wav']
    """
    stems = told_apart(file_stem(run, "run") for run in runs)
    return [f"{stem}_full_scale_{full_scale:g}_Pa.wav" for stem in stems]


def write_wav(pressure: Array, file: Path, *, full_scale: float, rate: int = RATE) -> None:
    """Write a pressure as mono WAV of 16 bits.

    Parameters
    ----------
    pressure : array
        At 48 kHz [Pa], shape (n,).
    file : Path
    full_scale : float
        Pressure of the largest sample [Pa].
    rate : int
        Of the file [Hz].

    Raises
    ------
    ParameterError
        The pressure exceeds the full scale; nothing is written.
    """
    from scipy.io import wavfile

    signal = played(pressure, rate)
    peak = float(np.max(np.abs(signal))) if signal.size else 0.0
    if peak > full_scale:
        raise ParameterError(
            f"The peak of the sound must be at most the full scale of the WAV, {full_scale:g} Pa, "
            f"got {peak:.4g} Pa: it would clip. Take a full scale of {full_scale_for(peak):g} Pa "
            "or more for all sounds that are compared, or leave it out."
        )
    samples = np.round(signal * (_LARGEST / full_scale)).astype(np.int16)
    with atomic_write(file) as partial:
        wavfile.write(partial, rate, samples)
