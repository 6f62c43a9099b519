"""Differences of the plain analysis, extrapolated, for comparison with derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gearlube_core.hypoid_contact.pair import FlankPair


def changed_pair(file, pair, parameter, change):
    """Return a pair built again from a gear file or a misalignment with a changed number."""
    section, _, key = parameter.name.partition(".")
    value = parameter.value + change
    if section == "misalignment":
        return pair.misaligned(replace(pair.misalignment, **{key: value}))
    changed = file.varied({parameter.name: value})
    return FlankPair.from_file(changed, pair.side, pair.misalignment)


def extrapolated(function, step):
    """Return the derivative of `function` at zero, by Richardson's rule from steps h and 2 h."""
    near = (np.asarray(function(step)) - np.asarray(function(-step))) / (2.0 * step)
    far = (np.asarray(function(2.0 * step)) - np.asarray(function(-2.0 * step))) / (4.0 * step)
    return (4.0 * near - far) / 3.0


def apart(found, expected):
    """Return the largest difference over the largest expected value."""
    return float(np.nanmax(np.abs(found - expected)) / np.nanmax(np.abs(expected)))
