"""Rough line contacts in time: plan, march, files."""
