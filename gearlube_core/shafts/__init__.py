"""Shafts as beams: from sections and discs to rigid motion and modes."""
