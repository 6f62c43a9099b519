"""How viscosity depends on temperature, pressure and shear: kernels."""
