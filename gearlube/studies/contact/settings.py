"""Settings of a tooth contact analysis."""

from __future__ import annotations

from gearlube_core.hypoid_contact.contact_dataset import ContactSettings
from gearlube_core.hypoid_contact.loaded_contact import LoadedSettings
from gearlube_core.hypoid_contact.mesh_cycle import CycleSettings
from gearlube_core.hypoid_contact.placement import Misalignment

__all__ = ["QUICK", "ContactSettings", "CycleSettings", "LoadedSettings", "Misalignment"]

# few positions and torques, for a first look
QUICK = ContactSettings(cycle=CycleSettings(positions=8, torques=(20.0, 50.0, 150.0)))
