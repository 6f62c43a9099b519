"""Resonance of the torsional hypoid pair: response curves, motions, flank contacts as datasets."""

from gearlube.studies.resonance.settings import MODELS, ResonanceSettings, quick_settings
from gearlube.studies.resonance.study import ResonanceStudy, Stage, study_resonance

__all__ = [
    "MODELS",
    "ResonanceSettings",
    "ResonanceStudy",
    "Stage",
    "quick_settings",
    "study_resonance",
]
