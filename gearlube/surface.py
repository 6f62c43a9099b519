"""Rough surfaces: files, filters, statistics, generators, and what presses or moves them."""

from gearlube.lazy_names import lazy_names

__getattr__, __dir__, __all__ = lazy_names(__name__, __file__)
