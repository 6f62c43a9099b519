"""Values to which three nested grids go, with their errors; rows of the published table."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from docs.ehl.film_map import ALPHA, ETA0, REDUCED_MODULUS, Contact
from docs.film_table.contacts import Solved, film_group, hertz_pressure, pressure_group
from gearlube_core.oil.film_oil_data import film_oil

DOMAIN_ERROR = (
    0.0005  # of a film; what half as large a domain again changes, see docs/film_table.md
)
COLUMNS = (
    "ellipticity", "angle_deg", "M", "L", "R_y_over_R_x", "U", "W", "hertz_pressure_gpa",
    "H_c", "H_c_error_percent", "H_min", "H_min_error_percent",
    "p_max", "p_max_error_percent", "central_density", "nodes",
    "H_c_fine", "H_c_middle", "H_c_coarse", "H_min_fine", "H_min_middle", "H_min_coarse",
)  # fmt: skip


class Value(NamedTuple):
    """A value with its relative error [-]."""

    value: float
    error: float


def second_order(fine: float, coarse: float) -> float:
    """Return what two grids of half the spacing each go to."""
    return fine + (fine - coarse) / 3.0


def extrapolated(grids: Sequence[float]) -> Value:
    """Return what three nested grids go to, finest first.

    The error is the step from the finest grid to it, plus what it moves where the two coarser
    grids are taken instead of the two finer ones: of pure second order the first is left, of
    pure first order both make up twice the true error.
    """
    fine, middle, coarse = grids
    value = second_order(fine, middle)
    error = abs(value - fine) + abs(value - second_order(middle, coarse))
    return Value(value, error / abs(value))


class Row(NamedTuple):
    """A contact of the table with its films in the group of Moes."""

    solved: Solved
    central: Value
    minimum: Value
    pressure: Value  # over the largest of the dry contact

    @classmethod
    def of(cls, solved: Solved) -> Row:
        """Return the row of a solved contact."""
        films = [
            extrapolated([film_group(solved.contact, film) for film in heights])
            for heights in (
                [grid.central_film for grid in solved.grids],
                [grid.minimum_film for grid in solved.grids],
            )
        ]
        pressures = [pressure_group(solved.contact, g.maximum_pressure) for g in solved.grids]
        found = extrapolated(pressures)
        # a spike grows with the grid and may hide: no value beyond the finest grid's is claimed
        finest = Value(pressures[0], max(found.error, solved.peak))
        central, minimum = (Value(one.value, one.error + DOMAIN_ERROR) for one in films)
        return cls(solved, central, minimum, finest)

    def cells(self) -> list[str]:
        """Return the row as it is written."""
        c, films = self.solved.contact, self.solved.grids
        numbers = [f"{v:.6g}" for v in (c.ellipticity, c.angle, c.M, c.L)]
        numbers += [f"{v:.6g}" for v in (c.radius_ratio, c.speed_group, c.load_group)]
        numbers.append(f"{1e-9 * hertz_pressure(c):.4g}")
        for value in (self.central, self.minimum, self.pressure):
            numbers += [f"{value.value:.5g}", f"{100.0 * value.error:.2g}"]
        numbers += [f"{self.solved.density_ratio:.4f}", str(self.solved.nodes)]
        numbers += [f"{film_group(c, one.central_film):.6g}" for one in films]
        return numbers + [f"{film_group(c, one.minimum_film):.6g}" for one in films]


def header(version: str) -> str:
    """Return the comment above the columns."""
    oil = film_oil(eta0=ETA0, alpha=ALPHA)
    lines = (
        "Films of smooth elliptical point contacts: steady, isothermal, Newtonian.",
        f"gearlube {version}, MIT licence. Written by python -m docs.film_table.make.",
        "How to use it: docs/film_table.md.",
        "",
        "R_x, R_y [m]: relative radii along the short and the long axis of the dry contact.",
        "E' = 2 E* [Pa], u [m/s]: mean of the surface speeds, F [N]: load.",
        "U = eta0 u/(E' R_x), G = alpha E', W = F/(E' R_x^2); M = W (2U)^(-3/4), L = G (2U)^(1/4).",
        "H = (h/R_x) (2U)^(-1/2). All columns are dimensionless [-] but where a unit stands.",
        "Viscosity after Roelands, eta = eta0 exp{(ln(eta0) + 9.67) [(1 + 5.1 p)^Z - 1]},",
        f"  p in GPa, eta0 = {ETA0:g} Pa s, alpha = {1e9 * ALPHA:g} 1/GPa.",
        f"So Z = {oil.viscosity.Z:.4f} and G = {ALPHA * REDUCED_MODULUS:g}, with E' = "
        f"{1e-9 * REDUCED_MODULUS:g} GPa.",
        "Density after Dowson and Higginson, rho/rho0 = (1 + 2.266 p)/(1 + 1.683 p), p in GPa.",
        "Cavitation: pressure and its gradient vanish (Reynolds). Oil goes on beyond the domain.",
        "",
        "ellipticity: a_y/a_x of the dry contact.",
        "angle_deg: of entrainment to the short axis [degree].",
        "hertz_pressure_gpa: largest pressure of the dry contact [GPa].",
        "H_c, H_min: film in the centre and smallest film, extrapolated from three grids.",
        "..._error_percent: bound of the error of the value before it, of grid and domain [%].",
        "p_max: largest pressure over that of the dry contact, on the finest grid; spikes grow.",
        "central_density: rho/rho0 in the centre. nodes: along a side of the finest grid.",
        "..._fine, _middle, _coarse: on the three grids, each of twice the spacing of the last.",
    )
    return "".join(f"# {line}".rstrip() + "\n" for line in lines)


def write_table(path: Path, rows: Sequence[Row], version: str) -> None:
    """Write the table."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(header(version))
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(row.cells() for row in rows)


def read_table(path: Path) -> list[dict[str, float]]:
    """Return the rows of the table by their columns."""
    with path.open(encoding="utf-8", newline="") as file:
        lines = (line for line in file if not line.startswith("#"))
        return [{name: float(cell) for name, cell in row.items()} for row in csv.DictReader(lines)]


def contact_of(row: dict[str, float]) -> Contact:
    """Return the contact of a row of the table."""
    return Contact(row["ellipticity"], row["M"], row["L"], row["angle_deg"])
