"""Figures of lubricated contacts: functions from a dataset to a matplotlib Figure."""
