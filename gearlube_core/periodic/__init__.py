"""Periodic motions: found, followed and judged for stability, whatever the model."""
