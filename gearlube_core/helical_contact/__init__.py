"""Loaded tooth contact and mesh stiffness of a helical pair."""
