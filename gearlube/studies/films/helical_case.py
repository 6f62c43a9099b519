"""The film of a helical pair's contact line at one position, from a gear file."""

from __future__ import annotations

from dataclasses import dataclass

from gearlube_core.checks import check_option, check_within
from gearlube_core.contact.greenwood_tripp_1971 import ROUGHNESS
from gearlube_core.contact.solid import STEEL_MOHAMMADPOUR_2015, contact_modulus
from gearlube_core.ehl.gears.helical_film import GRADINGS, HelicalFilm
from gearlube_core.errors import ParameterError
from gearlube_core.helical_geometry.gear_file import HelicalGearFile
from gearlube_core.helical_geometry.meshing_steps import (
    MeshingSteps,
    gear_file_steps,
    line_at_position,
    meshing_steps,
    position_of_line,
)
from gearlube_core.input_file.field_units import limits_in
from gearlube_core.oil.film_oil import FilmOil
from gearlube_core.oil.film_oil_data import film_oil, film_oil_of
from gearlube_core.oil.lubricant import Lubricant
from gearlube_core.units import rpm_to_rads

_STEEL = contact_modulus(STEEL_MOHAMMADPOUR_2015, STEEL_MOHAMMADPOUR_2015)
_STEP, _SMALLEST_SHARE = 0.04e-3, 0.16  # m, 1: [jamali_2015 sec. 4.4]


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalLineCase:
    """Case of one contact line of a helical pair at one position, for `run_helical_line`.

    Parameters
    ----------
    file : HelicalGearFile
    torque, pinion_speed
        Torque on the pinion [N m], its speed [rad/s]; None: those of the file.
    step
        Step of the meshing cycle, not necessarily whole; None: see `position`.
    position
        s_i of the line [m]; None, with `step` None too: where the line carries the largest load.
    oil
        Name of an oil of the library; None: the oil of the file.
    oil_temperature
        Temperature of an oil of the library [K].
    newtonian
        True: leave the Eyring stress out.
    convention
        Meaning of the load, "normal" or "thesis".
    nodes
        Numbers of nodes across the line and along it; None, also for one of them: those of the
        file.
    spacing
        Spacing of the nodes across the line, "uniform" or "exit"; None: that of the file.
    roughness_um
        Composite rms roughness of both flanks [um], for the film ratio; None: not known.

    Raises
    ------
    ParameterError
        Something is missing, given twice or out of range.

    Examples
    --------
    >>> gears = HelicalGearFile.named("jamali_2015_a")
    >>> case = HelicalLineCase(file=gears, step=300.0, nodes=(33, 49))
    >>> case.mesh
    ((33, 49), 'uniform')
    """

    file: HelicalGearFile
    torque: float | None = None
    pinion_speed: float | None = None
    step: float | None = None
    position: float | None = None
    oil: str | None = None
    oil_temperature: float = 353.15
    newtonian: bool = False
    convention: str = "normal"
    nodes: tuple[int | None, int | None] = (None, None)
    spacing: str | None = None
    roughness_um: float | None = None

    @property
    def mesh(self) -> tuple[tuple[int, int], str]:
        """Return the nodes across and along the line, and how they are spaced across it."""
        own, (across, along) = self.file.film_mesh, self.nodes
        return (
            own.nodes_across if across is None else across,
            own.nodes_along if along is None else along,
        ), own.spacing if self.spacing is None else self.spacing

    def film(self) -> HelicalFilm:
        """Return the film problem of the whole meshing cycle."""
        torque, speed = self._operation()
        modified = self.file.modified_pair()
        modulus = self.file.pair.reduced_modulus_gpa
        (across, along), spacing = self.mesh
        for name, count in (("across", across), ("along", along)):
            check_within(f"nodes {name} the line", count, 17, 2049)
        check_option("spacing", spacing, tuple(GRADINGS))
        if self.roughness_um is not None:
            check_within("roughness_um", self.roughness_um, *limits_in("um", ROUGHNESS), "um")
        return HelicalFilm(
            modified=modified,
            steps=meshing_steps(modified, _STEP, _SMALLEST_SHARE)
            if self.file.meshing_steps is None
            else gear_file_steps(self.file),
            torque=torque,
            pinion_speed=speed,
            lubricant=self._lubricant(),
            contact_modulus=_STEEL if modulus is None else 0.5e9 * modulus,
            nodes=(across, along),
            grading=GRADINGS[spacing],
            convention=self.convention,
        )

    def step_of(self, film: HelicalFilm) -> float:
        """Return the step of the line's position in the meshing cycle [-]."""
        steps = film.steps
        if self.step is not None and self.position is not None:
            raise ParameterError(
                f"Give a step or a position, not both, got step {self.step:g} and position "
                f"{1e3 * self.position:g} mm."
            )
        if self.step is not None:
            check_within("step", self.step, 0.0, steps.count)
            return self.step
        if self.position is not None:
            first, last = (1e3 * float(steps.position(n)) for n in (0, steps.count))
            check_within("position", 1e3 * self.position, first, last, "mm")
            return float(steps.step_at(self.position))
        return float(steps.step_at(position_of_line(film.largest_load()[1], steps.pair)))

    def _operation(self) -> tuple[float, float]:
        given = self.file.operation
        torque, speed = self.torque, self.pinion_speed
        if given is not None:
            torque = given.pinion_torque_n_m if torque is None else torque
            speed = rpm_to_rads(given.pinion_speed_rpm) if speed is None else speed
        if torque is None or speed is None:
            raise ParameterError(
                f"Torque and speed must be given for {self.file.name}, whose file has no "
                f"[operation], got {torque} N.m and {speed} rad/s. Add the section or give both."
            )
        check_within("torque", torque, 1e-3, 1e6, "N.m", "Give its magnitude.")
        check_within("pinion_speed", speed, 1e-2, 1e5, "rad/s", "Give its magnitude.")
        return torque, speed

    def _lubricant(self) -> FilmOil:
        own = self.file.oil
        if self.oil is not None:
            return film_oil_of(
                Lubricant.named(self.oil), self.oil_temperature, newtonian=self.newtonian
            )
        if own is None:
            raise ParameterError(
                f"An oil must be given for {self.file.name}, whose file has no [oil]. "
                "Add the section or name an oil of the library."
            )
        stress = None if self.newtonian else own.eyring_stress_mpa
        return film_oil(
            eta0=own.viscosity_pa_s,
            alpha=1e-9 * own.pressure_viscosity_per_gpa,
            eyring_stress=None if stress is None else 1e6 * stress,
        )


def line_of_step(steps: MeshingSteps, step: float) -> tuple[float, float]:
    """Return s_i and X of the line at a step [m]."""
    position = float(steps.position(step))
    return position, float(line_at_position(position, steps.pair))


def with_flanks(
    file: HelicalGearFile,
    facets: int | None = None,
    crown_start_mm: float | None = None,
    relief_parabola: float | None = None,
    relief_exponent: float | None = None,
) -> HelicalGearFile:
    """Return the gear file with other facets, crown or tip relief on both flanks.

    Parameters
    ----------
    file
        Gear file of the pair.
    facets
        In place of the involute; 0: none.
    crown_start_mm
        Start of both crowns, from mid-face [mm].
    relief_parabola
        Parabolic share k of both tip reliefs [-].
    relief_exponent
        Exponent of both tip reliefs as powers of the depth [-]; not beside `relief_parabola`.

    Raises
    ------
    ParameterError
        Something is out of range, or both forms of relief are given.
    """
    if relief_parabola is not None and relief_exponent is not None:
        raise ParameterError(
            f"relief_parabola must not be given with relief_exponent, got {relief_parabola:g} and "
            f"{relief_exponent:g}. Leave one out."
        )
    form = None if relief_exponent is None else "power"
    fields = {
        "facets": facets,
        "crown_start_mm": crown_start_mm,
        "tip_relief_parabola": relief_parabola,
        "tip_relief_exponent": relief_exponent,
        "tip_relief_form": form if relief_parabola is None else "blended",
    }
    changes = {
        f"{role}.flank.{field}": value
        for role in ("pinion", "gear")
        for field, value in fields.items()
        if value is not None
    }
    return file.varied(changes) if changes else file
