"""Models with classes from outside the package, in a process of their own.

numba would keep code for these classes beside that of the package, and every later process would
have to find the classes.
"""

import json
import os
import subprocess
import sys

INTERPRETED = {"NUMBA_DISABLE_JIT": "1"}


def report_of(module, function="report", **environment):
    """What a function of a helper module writes, read as JSON."""
    command = [sys.executable, "-c", f"from tests.helpers import {module} as m; m.{function}()"]
    path = os.pathsep.join(filter(None, sys.path))
    env = dict(os.environ, PYTHONPATH=path, **environment)
    out = subprocess.run(command, env=env, capture_output=True, text=True, check=True, timeout=900)
    return json.loads(out.stdout)
