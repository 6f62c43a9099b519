"""Sound pressure from bearing forces by the response of each path; A-weighting."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from gearlube.studies.sound.force_record import ForceRecord
from gearlube.studies.sound.transfer_path import TransferPath
from gearlube_core.arrays import Array
from gearlube_core.errors import ParameterError

REFERENCE = 20e-6  # Pa
_F1, _F2, _F3, _F4 = 20.60, 107.7, 737.9, 12194.0  # Hz
_AT_1_KHZ = 10.0 ** (2.000 / 20.0)
_DENOMINATOR = 2000  # rates are ratios of smaller numbers; 32768 Hz is 256/375 of 48 kHz
RATE = 48000  # Hz, as ISO 532-1 and ECMA-418-2 want it
_LOWEST = 20.0  # Hz, below nobody hears
_HIGHEST = 0.45  # of the rate of the record
_LEAST_SIZE = 1 << 14  # of an impulse response
_EARLY_SHARE = 1 / 4  # of an impulse response that may lie before the force
LARGEST_OUTSIDE = 0.01  # of the A-weighted energy of the forces, 0.04 dB
LARGEST_EARLY = 0.1  # of the energy of a response before the force
_EDGE = 2.0 ** (1.0 / 12.0)  # width of the fade at the upper end of the band
_FADE = 0.02  # s at the ends of the record


def a_weighting(frequency: Array) -> Array:
    """Return the factor on pressure of the A-weighting [-], 1 at 1 kHz: [iec_61672_1].

    Examples
    --------
    >>> (20.0 * np.log10(a_weighting(np.array([100.0, 1000.0, 10000.0])))).round(1)
    array([-19.1,   0. ,  -2.5])
    """
    square = np.asarray(frequency, dtype=np.float64) ** 2
    rest = (square + _F1**2) * (square + _F4**2)
    rest = rest * np.sqrt((square + _F2**2) * (square + _F3**2))
    return np.asarray(_AT_1_KHZ * _F4**2 * square**2 / rest)


def a_weighted(pressure: Array, rate: float) -> Array:
    """Return a signal with A-weighted magnitude and unchanged phase [Pa], shape (n,)."""
    from scipy.fft import irfft, next_fast_len, rfft

    size = next_fast_len(2 * pressure.size, real=True)
    f = np.fft.rfftfreq(size, 1.0 / rate).astype(np.float64)
    return np.asarray(irfft(rfft(pressure, size) * a_weighting(f), size)[: pressure.size])


def resampled(signal: Array, ratio: float) -> Array:
    """Return a signal at `ratio` times its rate, from its Fourier coefficients.

    What the new rate holds keeps its level exactly; the rest is cut off. The signal must be about
    zero at both ends, as it is continued by zeros.

    Examples
    --------
    >>> tone = np.sin(2.0 * np.pi * np.arange(4000) / 8.0) * np.hanning(4000)
    >>> twice = resampled(tone, 2.0)
    >>> twice.size, bool(np.allclose(twice[::2], tone, atol=1e-6))
    (8000, True)
    """
    from scipy.fft import next_fast_len
    from scipy.signal import resample

    exact = Fraction(ratio).limit_denominator(_DENOMINATOR)
    up, down = exact.numerator, exact.denominator
    if up == down:
        return signal
    pieces = next_fast_len(-(-signal.size // down) + 1)
    padded = np.concatenate([signal, np.zeros(pieces * down - signal.size)])
    size = -(-signal.size * up // down)
    return np.asarray(resample(padded, pieces * up)[:size])


@dataclass(frozen=True, slots=True, kw_only=True)
class Pressure:
    """Sound pressure at the listener.

    Parameters
    ----------
    signal : array
        At 48 kHz [Pa], shape (n,); its first sample is the first of the forces.
    band : (float, float)
        Frequencies that it holds [Hz].
    early : float
        Largest share of a path's energy more than 1 ms before the force [-]; small for a causal
        path over a wide band.
    """

    signal: Array
    band: tuple[float, float]
    early: float

    @property
    def time(self) -> Array:
        """Since the first sample [s], shape (n,)."""
        return np.arange(self.signal.size) / RATE


def sound_pressure(
    record: ForceRecord, path: TransferPath, band: tuple[float, float] | None = None
) -> Pressure:
    """Return the sound pressure of a run.

    Forces lose their mean, are resampled to 48 kHz and convolved with the impulse responses of
    their paths by `scipy.signal.oaconvolve`. Below the band the response falls by
    12 dB per octave, at its upper end it fades within a twelfth of an octave.

    Parameters
    ----------
    record : ForceRecord
    path : TransferPath
        With a response for each force.
    band : (float, float), optional
        [Hz]; None: where both run and path reach. Then the path must hold 99 % of the forces'
        A-weighted energy.

    Raises
    ------
    ParameterError
        The path does not cover the band, or its phases run backwards in time.
    """
    from scipy.signal import oaconvolve

    path.check_paths(record.paths)
    band = _band(record, path, band)
    fade = _fade(record.force.shape[1], record.rate)
    signal: Array | None = None
    early = 0.0
    for name, force in zip(record.paths, record.force, strict=True):
        forces = resampled((force - np.mean(force)) * fade, RATE / record.rate)
        response, before = impulse_response(path, name, band)
        early = max(early, _check_causal(response, before, name, path.source))
        heard = oaconvolve(forces, response)[before : before + forces.size]
        signal = heard if signal is None else signal + heard
    assert signal is not None
    return Pressure(signal=signal, band=band, early=early)


def impulse_response(path: TransferPath, name: str, band: tuple[float, float]) -> tuple[Array, int]:
    """Return the impulse response [Pa/N per sample] and how many samples lie before the force."""
    step = float(np.min(np.diff(path.frequency)))
    # a response sampled every `step` Hz lasts 1/step at most
    size = max(_LEAST_SIZE, 1 << int(np.ceil(np.log2(RATE / step)))) if step > 0.5 else 1 << 17
    f = np.fft.rfftfreq(size, 1.0 / RATE).astype(np.float64)
    shape = path.at(name, np.clip(f, *band)) * _window(f, band)
    response = np.fft.irfft(shape, size)
    before = int(_EARLY_SHARE * size)
    return np.roll(response, before), before


def _check_causal(response: Array, before: int, name: str, source: str) -> float:
    """Return the share of energy more than 1 ms before the force; refuse if more lies there.

    The ends of the band ring alike before and after; phases that run backwards do not.
    """
    energy = response**2
    whole = float(np.sum(energy))
    if whole == 0.0:
        return 0.0
    early = float(np.sum(energy[: before - RATE // 1000])) / whole
    late = float(np.sum(energy[before + RATE // 1000 :])) / whole
    if early > LARGEST_EARLY and early > 2.0 * late:
        raise ParameterError(
            f"The response {name} of {source} must follow the force, got {100 * early:.3g} % of "
            f"its energy before it and {100 * late:.3g} % after. Phases for the time factor "
            "exp(-i omega t), or in another unit, look so: change the sign of the phases, or check "
            "their unit."
        )
    return early


def _window(f: Array, band: tuple[float, float]) -> Array:
    """Return 1 within the band, 0 above it after a fade inside, 12 dB per octave below.

    A steep cut at the low end would ring for half a second.
    """
    low, high = band
    octaves = np.log2(np.maximum(f, 1e-9) / high)
    fall = np.clip(-octaves / np.log2(_EDGE), 0.0, 1.0)
    return np.asarray(np.minimum(f / low, 1.0) ** 2 * np.sin(0.5 * np.pi * fall) ** 2)


def _fade(size: int, rate: float) -> Array:
    fade = np.ones(size)
    length = min(int(_FADE * rate), size // 4)
    ramp = 0.5 - 0.5 * np.cos(np.pi * np.arange(length) / length)
    fade[:length] *= ramp
    fade[size - length :] *= ramp[::-1]
    return fade


def _band(
    record: ForceRecord, path: TransferPath, wanted: tuple[float, float] | None
) -> tuple[float, float]:
    low, high = path.band
    reach = _HIGHEST * record.rate
    if wanted is not None:
        top = min(high, reach)
        if wanted[0] < low * (1.0 - 1e-9) or wanted[1] > top * (1.0 + 1e-9):
            why = "path" if high <= reach else f"record at {record.rate:.6g} Hz"
            raise ParameterError(
                f"The band must lie within {low:.4g} to {top:.4g} Hz, where path and record reach "
                f"(the upper end is that of the {why}), got {wanted[0]:g} to {wanted[1]:g} Hz. "
                "Take a narrower band."
            )
        return wanted
    band = (max(low, _LOWEST), min(high, reach))
    if band[0] >= band[1]:
        raise ParameterError(
            f"The transfer path {path.source} must reach into {_LOWEST:g} to {reach:.4g} Hz, got "
            f"{low:.4g} to {high:.4g} Hz. Measure it there, or check the unit of its frequency."
        )
    outside, most = _outside(record, band)
    if outside > LARGEST_OUTSIDE:
        raise ParameterError(
            f"The transfer path {path.source} must cover the forces: at most "
            f"{100 * LARGEST_OUTSIDE:g} % of their A-weighted energy may lie outside it, got "
            f"{100 * outside:.3g} %, most of it near {most:.3g} Hz; it covers {low:.4g} to "
            f"{high:.4g} Hz. Measure the path there, or leave that out: --band "
            f"{band[0]:.0f}:{band[1]:.0f}."
        )
    return band


def _outside(record: ForceRecord, band: tuple[float, float]) -> tuple[float, float]:
    """Return the share of A-weighted energy of the forces outside a band, and its frequency."""
    from scipy.signal import welch

    size = min(record.force.shape[1], 1 << int(np.log2(0.5 * record.rate)))
    f, density = welch(record.force, record.rate, nperseg=size, detrend="constant")
    heard = np.sum(density, axis=0) * a_weighting(f) ** 2
    out = np.where((f < band[0]) | (f > band[1]), heard, 0.0)
    audible = (f >= _LOWEST) & (f <= _HIGHEST * record.rate)
    whole = float(np.sum(heard[audible]))
    if whole == 0.0:
        raise ParameterError(
            "The forces of the run must change with time, got constant ones: they make no sound. "
            "Give a run in which the pinion turns under load."
        )
    return float(np.sum(out[audible])) / whole, float(f[int(np.argmax(out * audible))])
