"""Figures of a run-up: functions from its dataset to a matplotlib Figure."""
