"""The film of a roller on a plate with an oil from a data sheet, at three temperatures."""

import gearlube as gl

# viscosities at 40 and 100 degC; the rest is that of a published gear oil
OWN_OIL = gl.Lubricant.named("mohammadpour_2015").with_two_viscosities(
    1.5e-4, gl.celsius_to_kelvin(40.0), 1.6e-5, gl.celsius_to_kelvin(100.0), name="own oil"
)


def films(temperatures_degc: list[float]) -> list[tuple[float, float]]:
    """Return the central film [m] and the friction coefficient [-] at each temperature."""
    found = []
    for temperature in temperatures_degc:
        oil = gl.oil.film_oil_of(OWN_OIL, gl.celsius_to_kelvin(temperature))
        contact = gl.ehl.LineProblem(
            lubricant=oil, radius=0.012, line_load=2e5, reduced_modulus=2.3e11,
            speed_1=4.0, speed_2=5.0,
        )  # fmt: skip
        film = gl.ehl.solve_line(contact, gl.ehl.LineSettings(nodes=401))
        found.append((film.central_film, film.friction_coefficient))
    return found


if __name__ == "__main__":
    temperatures = [40.0, 70.0, 100.0]
    for temperature, (film, friction) in zip(temperatures, films(temperatures), strict=True):
        print(f"{temperature:4.0f} degC   {1e6 * film:.2f} um   friction {friction:.4f}")
