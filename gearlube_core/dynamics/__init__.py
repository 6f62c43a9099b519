"""Mesh dynamics with backlash and dynamic bearings."""
