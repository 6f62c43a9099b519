"""Figures of a speed sweep: functions from the merged dataset to a matplotlib Figure."""
