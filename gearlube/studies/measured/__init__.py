"""Measured gears: from CSV files to a gear file with the measured flanks."""
