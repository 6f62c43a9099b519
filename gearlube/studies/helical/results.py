"""Results of a study of a helical pair."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import xarray as xr

from gearlube.studies.helical.settings import HelicalSettings
from gearlube_core.mesh_table.line_mesh import LineMesh


@dataclass(frozen=True, slots=True, kw_only=True)
class HelicalResults:
    """Results; a stopped study lacks the parts that it did not reach.

    Parameters
    ----------
    settings : HelicalSettings
    datasets : mapping of str to xarray.Dataset
        "contact", "response", "friction_sweep", "sweep", "stability", "separation", "film",
        "losses", "geometry" and "geometry_" with each name in the gear file's `compared_with`.
    mesh : LineMesh, optional
        Of the loaded contact.
    failures : mapping of str to str
        Why a stage found nothing, by its name.
    interrupted : bool
        Whether it was stopped by KeyboardInterrupt.
    """

    settings: HelicalSettings
    datasets: Mapping[str, xr.Dataset]
    mesh: LineMesh | None
    failures: Mapping[str, str]
    interrupted: bool
