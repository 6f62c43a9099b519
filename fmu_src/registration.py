"""Variables of the table as pythonfmu objects."""

from __future__ import annotations

from collections.abc import Iterable

from pythonfmu import Boolean, Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Integer, Real

from fmu_src.variable import Variable

# pythonfmu has no Enumeration; FMI 2 reads and sets it as Integer.
_CLASSES = {"Real": Real, "Integer": Integer, "Enumeration": Integer, "Boolean": Boolean}


def register_variables(slave: Fmi2Slave, table: Iterable[Variable]) -> None:
    """Register `table` in order, so that pythonfmu counts the same value references."""
    for variable in table:
        initial = variable.initial
        slave.register_variable(
            _CLASSES[variable.type](
                variable.name,
                causality=Fmi2Causality[variable.causality],
                variability=Fmi2Variability[variable.variability],
                initial=None if initial is None else Fmi2Initial[initial],
                description=variable.description,
            ),
            nested=False,
        )
