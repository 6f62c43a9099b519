"""Figures of helical and spur gear pairs: functions from datasets to a matplotlib Figure."""
