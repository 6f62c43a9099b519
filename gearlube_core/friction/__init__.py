"""Friction of a lubricated flank: viscous traction, boundary friction, and their sum."""
