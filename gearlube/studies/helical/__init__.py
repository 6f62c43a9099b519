"""Studies of helical and spur gear pairs: geometry and dynamics as datasets."""
