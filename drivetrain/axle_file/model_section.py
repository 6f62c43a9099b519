"""A section of the axle file whose fields are those of a model with their units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from drivetrain.axle_file.field_units import attribute_of, field_value, si_value, unit_of
from gearlube_core.input_file.input_file import Section
from gearlube_core.input_file.input_note import InputNote, Origin


class ModelSection(Section):
    """A section whose fields fall back to those of a model.

    A field is named as the model's attribute with its unit, e.g. `rolling_radius_mm`; `renamed`
    holds those that are not. Fields that the file leaves out are None.
    """

    renamed: ClassVar[Mapping[str, str]] = {}  # field: attribute
    sources: ClassVar[Mapping[str, str]] = {}  # field: where its default is from

    @classmethod
    def attribute(cls, key: str) -> str:
        """Return the name of the model's attribute of a field."""
        return cls.renamed.get(key) or attribute_of(key)

    def has(self, key: str) -> bool:
        """Whether the file gives a field."""
        return getattr(self, key) is not None

    def si(self, key: str) -> Any:
        """Return the value of a given field in SI units."""
        return si_value(key, getattr(self, key))

    def changes(self, model: object) -> dict[str, Any]:
        """Return the given fields that are attributes of `model`, in SI units."""
        named = {key: self.attribute(key) for key in type(self).model_fields if self.has(key)}
        return {name: self.si(key) for key, name in named.items() if hasattr(model, name)}

    def notes(
        self, prefix: str, model: object, why: str, inferred: Mapping[str, str] | None = None
    ) -> list[InputNote]:
        """Return a note on every field that is given or an attribute of `model`.

        Parameters
        ----------
        prefix : str
            Of the dotted names, with its dot.
        model : object
            Built with this section.
        why : str
            Where the values are from that the file leaves out, if `sources` says nothing else.
        inferred : mapping of str to str
            Fields that follow from given ones, and how.
        """
        notes = []
        for key in type(self).model_fields:
            name = self.attribute(key)
            if isinstance(getattr(self, key), Section):
                continue
            if self.has(key):
                value = getattr(self, key)
                notes.append(InputNote(prefix + key, value, unit_of(key), "given", ""))
            elif hasattr(model, name) and getattr(model, name) is not None:
                value = field_value(key, getattr(model, name))
                how = (inferred or {}).get(key)
                origin: Origin = "inferred" if how else "assumed"
                reason = how or self.sources.get(key, why)
                notes.append(InputNote(prefix + key, value, unit_of(key), origin, reason))
        return notes
