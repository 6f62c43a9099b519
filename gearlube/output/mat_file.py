"""Arrays as a file for MATLAB, Simulink, Octave and scipy."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import savemat

from gearlube_core.errors import ParameterError
from gearlube_core.storage.atomic_file import atomic_write

SIZE_LIMIT = 2**31 - 1  # bytes of one array
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,62}")


def write_mat(content: Mapping[str, Any], path: Path) -> None:
    """Write arrays, texts and mappings of them (as structs); one-dimensional arrays are rows.

    Raises
    ------
    ParameterError
        A name that MATLAB does not take, or an array that is larger than the format holds.
    """
    arrays = {name: _array(name, value) for name, value in content.items()}
    with atomic_write(path) as partial, partial.open("wb") as file:
        savemat(file, arrays, oned_as="row", long_field_names=True)


def _array(name: str, value: Any) -> Any:
    if not _NAME.fullmatch(name):
        raise ParameterError(
            f"A name in a .mat file must have letters, digits and _, begin with a letter and have "
            f"at most 63, got {name!r}. Leave it out with --variable, or rename it."
        )
    if isinstance(value, Mapping):
        return {key: _array(key, one) for key, one in value.items()}
    array = np.asarray(value)
    if array.nbytes > SIZE_LIMIT:
        raise ParameterError(
            f"An array in a .mat file must have at most {SIZE_LIMIT} bytes, got {array.nbytes} "
            f"in {name}. Choose variables with --variable, or a part of them with --span."
        )
    return array.astype(object) if array.dtype.kind in "US" and array.ndim else array
