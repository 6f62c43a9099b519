"""Settings of the sound of a run, and of its files."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.checks import check_option, check_positive, check_within

METRICS = ("loudness", "tonality", "roughness", "fluctuation_strength")
FIELDS = ("free", "diffuse")
WAV_RATES = (16000, 22050, 24000, 32000, 44100, 48000)


@dataclass(frozen=True, slots=True, kw_only=True)
class SoundSettings:
    """How `run_sound` makes and judges the sound of a run.

    Parameters
    ----------
    band : (float, float), optional
        Lowest and highest frequency that is kept [Hz]. None: as far as run and path reach.
    orders : tuple of float
        Orders of the pinion that are tracked [-]. Empty: the first mesh orders of the run.
    full_scale : float, optional
        Pressure at the full scale of the WAV [Pa]. None: the next of 1, 2, 5, 10 ... above the
        peak, the same for both runs.
    wav_rate : int
        Sample rate of the WAV [Hz]; the analysis is always at 48 kHz.
    field : {"free", "diffuse"}
        Sound field of the loudness.
    metrics : tuple of str
        Which of `METRICS` are computed. Empty: levels and order tracks only.
    revolutions : int
        Number of pinion revolutions in a block of the order tracks [-]; orders are separated if
        their distance is at least 1/revolutions.

    Raises
    ------
    ParameterError
        A value is out of range.

    Examples
    --------
    >>> SoundSettings(band=(50.0, 4000.0), orders=(13.0, 26.0)).field
    'free'
    """

    band: tuple[float, float] | None = None
    orders: tuple[float, ...] = ()
    full_scale: float | None = None
    wav_rate: int = 48000
    field: str = "free"
    metrics: tuple[str, ...] = METRICS
    revolutions: int = 4

    def __post_init__(self) -> None:
        if self.band is not None:
            low, high = self.band
            check_within("band: lowest frequency", low, 1.0, 20000.0, "Hz")
            check_within(
                "band: highest frequency", high, 1.5 * low, 20000.0, "Hz", "It is above the lowest."
            )
        for order in self.orders:
            check_within("orders", order, 0.1, 1000.0, "", "They count per turn of the pinion.")
        if self.full_scale is not None:
            check_positive("full_scale", self.full_scale, "Pa")
        check_option("wav_rate", str(self.wav_rate), [str(rate) for rate in WAV_RATES])
        check_option("field", self.field, FIELDS)
        for metric in self.metrics:
            check_option("metrics", metric, METRICS)
        check_within("revolutions", self.revolutions, 1, 100, "rev")
