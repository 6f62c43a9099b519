"""Mesh table: periodic mesh data against pinion angle and load, tagged datum by datum."""
