"""Figures of a tooth contact analysis: functions from its dataset to a matplotlib Figure."""

from gearlube.studies.contact.figures.catalogue import CONTACT_CATALOGUE, save_contact_figures

__all__ = ["CONTACT_CATALOGUE", "save_contact_figures"]
