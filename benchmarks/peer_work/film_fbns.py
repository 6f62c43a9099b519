"""Point film by EHL-FBNS in Octave: `film_fbns.py REPOSITORY`, whose script runs unchanged in part.

Octave knows no local functions behind a script, no `compose`, so that functions get files of their
own and two lines are replaced; no number is touched. Time is that of its solver alone.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from cases import FILM, serve

HERE = Path(__file__).parent


def unpack(repository: str, folder: Path) -> None:
    shown = ["git", "-C", repository, "show", "HEAD:code/EHL_02_mainprocess.m"]
    text = subprocess.run(shown, capture_output=True, check=True).stdout.decode("latin-1")
    main, *functions = re.split(r"(?m)^(?=function \[)", text)
    for one in functions:
        name = re.match(r"function \[[^\]]*\]\s*=\s*(\w+)", one).group(1)
        (folder / f"{name}.m").write_text(one)
    main = re.sub(r"close all; clc; clearvars[^\n]*", "", main, count=1)
    main = re.sub(r"char\(compose\(([^)]*)\)\)", r"sprintf(\1)", main)
    (folder / "main_process.m").write_text(main)
    (folder / "film.m").write_text((HERE / "film_fbns.m").read_text())


def run(nodes):
    given = {**os.environ, "FILM": json.dumps({**FILM, "nodes": nodes})}
    command = ["octave-cli", "--norc", "--quiet", "film.m"]
    done = subprocess.run(command, cwd=CODE, env=given, capture_output=True, text=True, check=False)
    answer = re.search(r"ANSWER (.*)", done.stdout)
    if answer is None:
        raise RuntimeError(done.stderr[-200:])
    return json.loads(answer.group(1))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        CODE = Path(name) / "code"
        CODE.mkdir()
        unpack(sys.argv[1], CODE)
        git = ["git", "-C", sys.argv[1], "log", "-1", "--format=%h of %cs"]
        commit = subprocess.run(git, capture_output=True, text=True, check=True).stdout.strip()
        told = subprocess.run(["octave-cli", "--version"], capture_output=True, text=True).stdout
        octave = re.search(r"version (\S+)", told).group(1)
        serve(run, f"{commit}, Octave {octave}")
