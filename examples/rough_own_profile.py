"""A film between two surfaces in motion, one of them with a measured profile."""

import gearlube as gl

films = gl.ehl.run_rough(gl.ehl.RoughCase.from_toml("examples/my_rough_contact.toml"))
print(f"pressure up to {1e-9 * films.pressure_max[-1]:.2f} GPa")
print(f"film down to {1e9 * films.film_min[-1]:.0f} nm")
