"""Order spectra of signals recorded at known shaft angles."""

from gearlube_core.spectra.angle_grid import AngleWindow, angle_window, resample, whole_revolutions
from gearlube_core.spectra.order_spectrum import (
    Extremes,
    OrderBlocks,
    OrderSpectrum,
    Waterfall,
    extremes,
    order_blocks,
    order_spectrum,
    samples_for,
    waterfall,
)

__all__ = [
    "AngleWindow",
    "Extremes",
    "OrderBlocks",
    "OrderSpectrum",
    "Waterfall",
    "angle_window",
    "extremes",
    "order_blocks",
    "order_spectrum",
    "resample",
    "samples_for",
    "waterfall",
    "whole_revolutions",
]
