"""Transmission error of pairs whose teeth differ: pitch, running axis, waves."""
