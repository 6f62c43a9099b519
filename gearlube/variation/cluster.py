"""Blocks of points on the workers of a Dask cluster."""

from __future__ import annotations

import hashlib
from typing import Any

from gearlube.variation.design import Design
from gearlube.variation.point_study import Block, PointStudy, computed_block
from gearlube_core.storage.dask_pool import NamedPlugin, get_worker


class StudyOnWorker(NamedPlugin):
    """Carries a study and its design to every worker, once."""

    def __init__(self, study: PointStudy, design: Design, key: str) -> None:
        self.study, self.design = study, design
        self.name = f"gearlube-vary-{hashlib.sha256(key.encode()).hexdigest()[:16]}"


def block_on_worker(plugin: str, size: int, number: int) -> Block:
    """Compute a block with the study that the plugin of that name brought to this worker."""
    carrier: Any = get_worker().plugins[plugin]
    return computed_block(carrier.study, carrier.design, size, number)
