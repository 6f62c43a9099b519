"""Build native FMUs: one archive for FMI 2 and one for FMI 3, with libraries for all platforms."""

from __future__ import annotations

import hashlib
import inspect
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from uuid import UUID

from fmu_src.documentation import index_html
from fmu_src.identity import licence_texts, source_digest, write_archive
from fmu_src.model_description import model_description
from fmu_src.native import tangent
from fmu_src.native.kept import PREBUILT, keep_library, kept_library, one_builds
from fmu_src.native.model import ENTRY_SIGNATURE, NativeModel
from fmu_src.native.model_description_3 import (
    ICON,
    STRUCT,
    model_description_3,
    struct_manifest,
    terminals,
)
from fmu_src.native.model_file import MODEL_FILE, model_body, model_file
from fmu_src.native.platforms import (
    BUILD_OPTIONS,
    FMI2_FOLDERS,
    PLATFORM_NAMES,
    PLATFORMS,
    Platform,
    c_object,
    check_linker,
    fmi_headers,
    shared_library,
    universal_library,
)
from fmu_src.native.related_files import described, reference_run
from fmu_src.native.sources import c_sources, library_name, model_sizes
from fmu_src.object_code import cpu_of_kernels, intermediate_code, object_code
from gearlube_core.checks import check_option
from gearlube_core.kernels.source_code import code_of
from gearlube_core.kernels.source_files import source_files

ENTRY = "gearlube_entry"
FMI_VERSIONS = ("2", "3")
_PACKAGE = Path(__file__).parents[1]
_SOURCES = f"""C sources of the FMI functions in this FMU, with the headers of the standard.

They read the model, its variables and its constants, from resources/{MODEL_FILE}, and
call the physics by one function, {ENTRY}. Its object code is made from kernels in
Python (gearlube_core, in gearlube {version("gearlube")}) and is not here, so these files
alone do not build the library. `gearlube build-fmu` of that version builds this archive again, with
the same bytes if its inputs are the same.
"""


@dataclass(frozen=True, kw_only=True)
class NativeOptions:
    """Options of a native FMU's build.

    Parameters
    ----------
    platforms : sequence of str
        Platforms to build for, names in `PLATFORMS`.
    fmi : sequence of {"2", "3"}
        Versions of the standard, an archive for each.
    reference : bool
        Whether the archives describe themselves, with results of the Python model for hosts to
        compare with: see `related_files`.
    report : callable
        Called with each line of progress.

    Raises
    ------
    ParameterError
        A platform or version that does not exist, or none.
    """

    platforms: Sequence[str] = PLATFORM_NAMES
    fmi: Sequence[str] = FMI_VERSIONS
    reference: bool = True
    report: Callable[[str], None] = lambda text: None

    def __post_init__(self) -> None:
        for name, given, known in (
            ("platform", self.platforms, PLATFORM_NAMES),
            ("fmi", self.fmi, FMI_VERSIONS),
        ):
            for one in given or [""]:
                check_option(name, one, known)


def _description(model: NativeModel, guid: str) -> bytes:
    """Return modelDescription.xml of FMI 2.0."""
    return model_description(model.definition, guid, native=True, exchange=model.exchange)


def library_kind(model: NativeModel) -> str:
    """Return the token of a model's library and file: equal for models that share a library."""
    digest = hashlib.sha256(model_sizes(model, "").encode())
    if model.entry is not None:
        digest.update(_entry_digest(model.entry))
        digest.update(model.kind.encode() if model.kind else model_body(model)[0])
    for name, text in model.c_code.items():
        digest.update(f"{name}\0{text}\0".encode())
    return digest.hexdigest()[:32]


def native_guid(model: NativeModel) -> UUID:
    """Return the GUID: equal code and data have an equal GUID, on every machine."""
    digest = hashlib.sha256(_description(model, ""))
    for name, text in sorted(c_sources(model, library_kind(model)).items()):
        digest.update(f"{name}\0{text}\0".encode())
    digest.update(model_body(model)[0])
    if model.entry is not None:
        digest.update(source_digest(model.definition))
    return UUID(bytes=digest.digest()[:16])


@cache
def _entry_digest(entry: Callable[..., int]) -> bytes:
    """Return a hash of the entry's name and of its code with all that it imports."""
    codes = (
        code_of(Path(file).read_text("utf-8")).encode()
        for file in {*source_files(inspect.getfile(entry)), *source_files(tangent.__file__)}
    )
    digest = hashlib.sha256(entry.__qualname__.encode())
    digest.update(b"".join(sorted(hashlib.sha256(code).digest() for code in codes)))
    return digest.digest()


def libraries(
    model: NativeModel,
    platforms: Sequence[Platform] = PLATFORMS,
    report: Callable[[str], None] = lambda text: None,
) -> dict[str, bytes]:
    """Return the shared library of a model for each platform, by the platform's name.

    A library that ships, or has been built before for a model of the same kind, is taken.

    Raises
    ------
    GearLubeError
        A library must be built, and the linker is missing, or fails for a platform.
    """
    name = model.definition.name
    if model.entry is not None and not model.kind:
        report(f"{name}: a library for this model alone, which is not kept")
        return dict(_built(model, platforms, report))
    shipped = prebuilt_folder(model)
    found = {one.name: kept_library(shipped, one.name) for one in platforms}
    missing = [one for one in platforms if not found[one.name]]
    if missing:
        with one_builds(_key(model), [one.name for one in missing], report) as folder:
            found |= {one.name: kept_library(folder, one.name) for one in missing}
            missing = [one for one in missing if not found[one.name]]
            for platform, library in _built(model, missing, report):
                keep_library(folder, platform, library)
                found[platform] = library
    taken = [one.name for one in platforms if one not in missing]
    if taken:
        report(f"{name}: libraries of earlier builds for {', '.join(taken)}")
    return {one.name: found[one.name] or b"" for one in platforms}


def prebuilt_folder(model: NativeModel) -> Path:
    """Return the folder in the package of the libraries of a model's kind, if they ship."""
    digest = hashlib.sha256(repr(BUILD_OPTIONS).encode())
    for name, text in sorted(c_sources(model, library_kind(model)).items()):
        digest.update(f"{name}\0{text}\0".encode())
    return PREBUILT / digest.hexdigest()[:32]


def _key(model: NativeModel) -> str:
    """Return a digest of all that makes the libraries of a model."""
    compilers = [version(name) for name in ("numba", "llvmlite") if model.entry is not None]
    if find_spec("ziglang"):
        compilers.append(version("ziglang"))
    text = [prebuilt_folder(model).name, compilers, cpu_of_kernels(), sorted(fmi_headers().items())]
    return hashlib.sha256(repr(text).encode()).hexdigest()[:32]


def kernel_code(model: NativeModel) -> str:
    """Return the intermediate code of a model's kernels, "" of a model in C.

    Raises
    ------
    GearLubeError
        In model exchange, if the kernels call a function whose slope is not known.
    """
    if model.entry is None:
        return ""
    code = intermediate_code(model.entry, ENTRY_SIGNATURE, ENTRY)
    return tangent.with_tangent(code, ENTRY) if model.exchange else code


def _built(
    model: NativeModel, platforms: Sequence[Platform], report: Callable[[str], None]
) -> Iterator[tuple[str, bytes]]:
    """Give the name of each platform with its library, built from the kernels."""
    if not platforms:
        return
    check_linker()
    name = library_name(model)
    sources = c_sources(model, library_kind(model)) | fmi_headers()
    report(f"{name}: compiling the kernels")
    code = kernel_code(model)
    headers = {file: text for file, text in sources.items() if file.endswith(".h")}
    for platform in platforms:
        report(f"{name}: linking for {platform.name}")
        if code:
            kernels, _ = object_code(code, platform.target)
        else:
            kernels = c_object(platform, model.c_code, headers)
        yield platform.name, shared_library(platform, sources, kernels, name)


def _common_content(model: NativeModel, guid: str) -> dict[str, bytes]:
    definition, kind = model.definition, library_kind(model)
    page = index_html(definition, model.ranges, native=True)
    content = {"documentation/index.html": page.encode(), **licence_texts("native")}
    sources = c_sources(model, kind) | fmi_headers()
    for name, text in (sources | {"README.txt": _SOURCES}).items():
        content[f"documentation/sources/{name}"] = text.encode()
    content |= {f"resources/{name}": data for name, data in definition.resources.items()}
    content[f"resources/{MODEL_FILE}"] = model_file(model, kind, guid)
    return content


def fmi2_content(model: NativeModel, built: dict[str, bytes]) -> dict[str, bytes]:
    """Return the files of the FMI 2.0 archive around the libraries of `libraries`."""
    definition, guid = model.definition, str(native_guid(model))
    suffixes = {platform.name: platform.suffix for platform in PLATFORMS}
    content = _common_content(model, guid)
    content["modelDescription.xml"] = _description(model, guid)
    content["model.png"] = (_PACKAGE / "model.png").read_bytes()
    for folder, platforms in FMI2_FOLDERS.items():
        there = {name: built[name] for name in platforms if name in built}
        if there:
            library = universal_library(there) if len(platforms) > 1 else built[platforms[0]]
            suffix = suffixes[platforms[0]]
            content[f"binaries/{folder}/{definition.name}{suffix}"] = library
    return content


def fmi3_content(model: NativeModel, built: dict[str, bytes]) -> dict[str, bytes]:
    """Return the files of the FMI 3.0 archive around the libraries of `libraries`."""
    definition, guid = model.definition, str(native_guid(model))
    content = _common_content(model, guid)
    content["modelDescription.xml"] = model_description_3(definition, guid, model.exchange)
    content["terminalsAndIcons/terminalsAndIcons.xml"] = terminals(definition)
    if definition.map_members:
        content[STRUCT] = struct_manifest()
    content[ICON] = (_PACKAGE / "model.png").read_bytes()
    for platform in PLATFORMS:
        if platform.name in built:
            path = f"binaries/{platform.name}/{definition.name}{platform.suffix}"
            content[path] = built[platform.name]
    return content


def build_native(model: NativeModel, out_dir: Path, options: NativeOptions) -> list[Path]:
    """Build the native FMUs of a model and return their paths.

    `NAME.fmu` is that of FMI 2, `NAME_FMI3.fmu` that of FMI 3.

    Raises
    ------
    GearLubeError
        The linker is missing, or fails for a platform; then nothing is written.
    """
    platforms = [one for one in PLATFORMS if one.name in options.platforms]
    built = libraries(model, platforms, options.report)
    if options.reference:
        options.report(f"{model.definition.name}: reference results")
        run = reference_run(model)
    contents = {"2": ("", fmi2_content), "3": ("_FMI3", fmi3_content)}
    paths = []
    for number in options.fmi:
        ending, content = contents[number]
        paths.append(out_dir / f"{model.definition.name}{ending}.fmu")
        files = content(model, built)
        if options.reference:
            files |= described(model, files, run)
        write_archive(paths[-1], files)
    return paths
