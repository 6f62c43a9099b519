"""Member and flank in the rows of a table of measured values."""

from __future__ import annotations

from gearlube_core.errors import ParameterError
from gearlube_core.hypoid_geometry.flank.flank import CURVES, Role, Side
from gearlube_core.input_file.table import Row

_ROLES: tuple[Role, Role] = ("pinion", "gear")


def role_of(row: Row) -> Role:
    """Return the member of a row: "pinion" or "gear"."""
    given = row.text("member").lower()
    for role in _ROLES:
        if given == role:
            return role
    raise ParameterError(
        f"{row.where}: member must be pinion or gear, got {given!r}. The gear is the larger "
        "one, also called wheel or ring gear."
    )


def side_of(row: Row, role: Role) -> Side:
    """Return the flank of a row: "drive" or "coast", for which it may say convex or concave."""
    given = row.text("flank").lower()
    for (member, side), curve in CURVES.items():
        if member == role and given in (side, curve):
            return side
    raise ParameterError(
        f"{row.where}: flank must be drive, coast, convex or concave, got {given!r}. Left and "
        "right depend on who looks; the drive flank of the gear is convex, that of the pinion "
        "concave."
    )
