"""The oil: library of lubricants, laws of viscosity, density and shear, and the oil of a film.

A law is a NamedTuple of floats whose kernels are methods. To add one, write such a class (in any
file) and hand it to `film_oil` in `gearlube_core.oil.film_oil_data`. What it needs stands in
`film_laws`.
"""
