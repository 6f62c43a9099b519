"""Rating of gears by the formulas of standards: safety, life and damage."""
