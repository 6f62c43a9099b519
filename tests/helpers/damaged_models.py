"""Loads native FMUs with damaged model files: each is refused, or runs within its memory.

Run as a program it damages many files of each model, on libraries that watch their memory:

    python -m tests.helpers.damaged_models --count 10000
"""

from __future__ import annotations

import argparse
import os
import pickle
import random
import struct
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import replace
from pathlib import Path

from drivetrain.train.train_file import TrainFile
from fmu_src.native.build import library_kind, native_guid
from fmu_src.native.model import NativeModel
from fmu_src.native.model_file import (
    COUNTS_AT,
    GUID_SIZE,
    HEAD_SIZE,
    MODEL_FILE,
    N_COUNTS,
    with_checksum,
)
from tests.helpers.native_library import OK, NativeInstance, NativeLibrary

ROOT = Path(__file__).parents[2]
_GUID_AT = COUNTS_AT - GUID_SIZE
_NUMBERS = (float("nan"), float("inf"), -1.0, 0.0, 0.5, 1.0, 2.0, 41.0, 1e6, 2.0**31, 1e300, -1e300)
_WAYS = (
    "cut", "longer", "bits", "token", "counts", "number", "whole", "integer", "swap", "zeros",
    "moved",
)  # fmt: skip
_WHOLE = (-1, 0, 1, 2, 3, 255, 2**15, 2**16, 2**31 - 1, -(2**31), 2**28)


def damaged(content: bytes, rng: random.Random) -> tuple[str, bytes]:
    """Return one way in which a file can be wrong, and the file; half have a fitting checksum."""
    data = bytearray(content)
    words = (len(data) - HEAD_SIZE) // 4
    counts = struct.unpack_from(f"<{N_COUNTS}i", data, COUNTS_AT)
    rows = HEAD_SIZE + 8 * counts[0]
    what = rng.choice(_WAYS)
    if what == "cut":
        del data[rng.randrange(len(data)) :]
    elif what == "longer":
        data += rng.randbytes(rng.randrange(1, 64))
    elif what == "bits":
        for _ in range(rng.randrange(1, 9)):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif what == "token":
        data[rng.randrange(_GUID_AT)] = rng.randrange(256)
    elif what == "counts":
        struct.pack_into("<i", data, COUNTS_AT + 4 * rng.randrange(N_COUNTS), rng.choice(_WHOLE))
    elif what == "number":  # first all that are read as sizes and places
        near = rng.choice((64, 4096, counts[0] + 1))
        place = HEAD_SIZE + 8 * rng.randrange(min(near, counts[0] + 1))
        struct.pack_into("<d", data, place, rng.choice(_NUMBERS))
    elif what == "whole":  # sizes and places of trains, and what they are places of
        heads = min(16, counts[0])
        behind = struct.unpack_from(f"<{heads}q", data, HEAD_SIZE)
        first = rng.choice([0, *(one for one in behind if 0 <= one < counts[0])])
        place = min(first + rng.randrange(160), counts[0])
        number = rng.choice((*_WHOLE, rng.randrange(200), rng.randrange(200)))
        struct.pack_into("<q", data, HEAD_SIZE + 8 * place, number)
    elif what == "integer":
        place = rows + 4 * rng.randrange((len(data) - rows) // 4)
        struct.pack_into("<i", data, place, rng.choice((*_WHOLE, rng.randrange(2000))))
    elif what == "swap":
        one, other = (HEAD_SIZE + 4 * rng.randrange(words) for _ in range(2))
        data[one : one + 4], data[other : other + 4] = data[other : other + 4], data[one : one + 4]
    elif what == "zeros":
        start = rng.randrange(len(data))
        end = min(len(data), start + rng.randrange(1, 4096))
        data[start:end] = bytes(end - start)
    else:
        start = rng.randrange(HEAD_SIZE, len(data))
        data[start:] = data[start + 4 :] + bytes(4)
    fits = rng.random() < 0.7 and len(data) >= HEAD_SIZE
    return (f"{what}, checksum fits", with_checksum(bytes(data))) if fits else (what, bytes(data))


def try_damaged(
    library: NativeLibrary, resources: Path, count: int, seed: int, first: int = 0
) -> Counter[tuple[str, str]]:
    """Load so many damaged files, and run those that are taken; return how many went which way.

    `resources` is the folder from which the library reads; it holds the sound file again after.
    """
    path = resources / MODEL_FILE
    sound = path.read_bytes()
    uri = resources.as_uri().encode()
    found: Counter[tuple[str, str]] = Counter()
    try:
        for number in range(first, first + count):
            what, content = damaged(sound, random.Random(f"{seed} {number}"))
            what = "nothing" if content == sound else what
            path.write_bytes(content)
            found[what, _answer(library, content, uri, what)] += 1
    finally:
        path.write_bytes(sound)
    return found


def _answer(library: NativeLibrary, content: bytes, uri: bytes, what: str) -> str:
    guid = content[_GUID_AT:COUNTS_AT].split(b"\0")[0].decode("latin-1")
    instance = NativeInstance(library, guid=guid, resources=uri)
    if instance.address is None:
        ((_, category, text),) = instance.log
        assert category == "logStatusError"
        assert "model" in text or "GUID" in text, text
        return "refused"
    assert "fits" in what or what == "nothing", what  # else it passed unseen
    started = instance.start() == OK
    if started:
        instance.step()
        instance.get_raw("Real", [0, 1, 2], 3)
        state = instance.try_save()[1]
        instance.restore(state)
        instance.free_state(state)
    instance.close()
    return "runs" if started else "starts not"


def _models() -> dict[str, NativeModel]:
    from fmu_src.native.models import native_model
    from fmu_src.native.train import train_model
    from tests.helpers.fmu_cases import CASES
    from tests.helpers.small_native_builds import MODEL

    models = [MODEL, *(native_model(case.definition) for case in CASES)]
    models += [train_model(name) for name in TrainFile.shipped()]
    return {model.definition.name: model for model in models}


def main() -> None:
    """Damage files of each model; each library is tried in a process of its own."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--model", nargs="+")
    parser.add_argument("--count", type=int, default=10_000, help="for all models together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--library", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.library:
        folder = given.library.parents[2]
        model, guid = pickle.loads((folder / "model").read_bytes())
        library = NativeLibrary(given.library, model, guid, 2)
        found = try_damaged(library, folder / "resources", given.count, given.seed, given.first)
        for (what, answer), times in sorted(found.items()):
            sys.stdout.write(f"{model.definition.name}: {what}: {answer}: {times}\n")
        return
    from tests.helpers.small_native_builds import unpacked
    from tests.helpers.watching_library import watching_environment, watching_library

    known = _models()
    models = {name: one for name, one in known.items() if name in (given.model or known)}
    failed, built = False, dict[str, bytes]()  # by kind: trains share theirs
    for name, model in models.items():
        with tempfile.TemporaryDirectory() as text:
            folder = Path(text)
            kind = library_kind(model)
            if kind in built:
                path = unpacked(model, folder, built[kind])
            else:
                path = watching_library(model, folder)
                built[kind] = path.read_bytes()
            (folder / "model").write_bytes(
                pickle.dumps((replace(model, entry=None), str(native_guid(model))))
            )
            count = -(-given.count // len(models))
            numbers = [f"--count={count}", f"--seed={given.seed}", f"--first={given.first}"]
            command = [sys.executable, "-m", "tests.helpers.damaged_models", f"--library={path}"]
            environment = watching_environment() | {"PYTHONPATH": os.fspath(ROOT)}
            with (folder / "said").open("w") as said:  # refusals too
                done = subprocess.run(
                    command + numbers, cwd=ROOT, env=environment, stderr=said, check=False
                )
            if done.returncode:
                sys.stdout.write((folder / "said").read_text("utf-8", "replace")[-3000:])
            sys.stdout.write(f"{name}: {count} files, exit status {done.returncode}\n")
            failed = failed or done.returncode != 0
    sys.exit(failed)


if __name__ == "__main__":
    main()
