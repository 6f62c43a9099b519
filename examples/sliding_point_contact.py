"""A steel ball that slides on a disc: film and friction over the slide-roll ratio."""

import gearlube as gl

SPEED = 2.0  # mean surface speed, m/s
OIL = gl.oil.film_oil(eta0=0.04, alpha=2e-8, eyring_stress=5e6)  # Pa s, 1/Pa, Pa


def friction(slide_roll_ratios: list[float]) -> list[tuple[float, float]]:
    """Return the smallest film [m] and the friction coefficient [-] at each ratio."""
    found = []
    for ratio in slide_roll_ratios:
        contact = gl.ehl.elliptical_contact(
            R_x=0.01, R_y=0.01, entrainment=(SPEED, 0.0), sliding=(ratio * SPEED, 0.0),
            load=20.0, contact_modulus=1.15e11, lubricant=OIL, nodes=(65, 65),
        )  # fmt: skip
        film = gl.ehl.solve_point_contact(contact)
        found.append((film.minimum_film, film.friction_coefficient))
    return found


if __name__ == "__main__":
    ratios = [0.0, 0.1, 0.5, 1.0]
    for ratio, (film, mu) in zip(ratios, friction(ratios), strict=True):
        print(f"slide-roll {ratio:.1f}   {1e9 * film:.0f} nm   friction {mu:.4f}")
