"""The script inside HelicalPair.fmu. It has no physics; it imports the installed gearlube.

pythonfmu imports this file and then runs its source once more at each instantiation. A class
statement here would make a new class each time, so the class is imported.
"""

import sys

try:
    from fmu_src.helical_pair import HelicalPair
    from fmu_src.wrapper import give_reference
except ImportError as error:
    reason = (
        "HelicalPair.fmu needs the Python package gearlube where it runs, "
        f"not found in {sys.prefix} (Python {sys.version.split()[0]}): {error}. "
        "Install it there with `pip install gearlube`. A host that is not Python is started by "
        "`gearlube native HOST` of the environment that has it."
    )
    if sys.stderr is not None:  # a host without logging hears nothing else
        sys.stderr.write(f"{reason}\n")
    raise ImportError(reason) from error

__all__ = ["HelicalPair"]

give_reference(globals())
