"""Gear pairs: files, mesh tables, parameters of models, states of the flanks."""

from gearlube.lazy_names import lazy_names

__getattr__, __dir__, __all__ = lazy_names(__name__, __file__)
