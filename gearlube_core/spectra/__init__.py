"""Order spectra of signals recorded at known shaft angles."""

from gearlube_core.spectra.angle_grid import (
    AngleWindow,
    angle_window,
    resample,
    whole_revolutions,
)
from gearlube_core.spectra.extremes import Extremes, extremes
from gearlube_core.spectra.order_spectrum import OrderSpectrum, order_cut, order_spectrum

__all__ = [
    "AngleWindow",
    "Extremes",
    "OrderSpectrum",
    "angle_window",
    "extremes",
    "order_cut",
    "order_spectrum",
    "resample",
    "whole_revolutions",
]
