"""Figures of a resonance study: functions from its datasets to a matplotlib Figure."""
