"""Figures of a tooth contact analysis: functions from its dataset to a matplotlib Figure."""
