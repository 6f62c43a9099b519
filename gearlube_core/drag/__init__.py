"""Drag without load: churning of a gear in its oil, and shaft seals."""
