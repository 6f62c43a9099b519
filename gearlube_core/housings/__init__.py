"""Housings from finite elements: reduced models, their files and modes."""
