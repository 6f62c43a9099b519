"""Order spectra of signals recorded at known shaft angles."""

from gearlube_core.spectra.angle_grid import (
    AngleWindow,
    angle_window,
    resample,
    whole_revolutions,
)
from gearlube_core.spectra.extremes import Extremes, extremes
from gearlube_core.spectra.order_spectrum import OrderSpectrum, order_cut, order_spectrum
from gearlube_core.spectra.order_track import OrderBlocks, order_blocks, samples_for
from gearlube_core.spectra.waterfalls import Waterfall, waterfall

__all__ = [
    "AngleWindow",
    "Extremes",
    "OrderBlocks",
    "OrderSpectrum",
    "Waterfall",
    "angle_window",
    "extremes",
    "order_blocks",
    "order_cut",
    "order_spectrum",
    "resample",
    "samples_for",
    "waterfall",
    "whole_revolutions",
]
