"""Atomic file writes, stored results, worker processes."""
