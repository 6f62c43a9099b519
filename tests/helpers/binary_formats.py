"""What a shared library exports and needs: ELF, PE and Mach-O, 64-bit and little-endian."""

from __future__ import annotations

import io
import struct
from typing import Any, NamedTuple

from elftools.elf.elffile import ELFFile
from elftools.elf.gnuversions import GNUVerNeedSection
from elftools.elf.sections import NoteSection


class Binary(NamedTuple):
    """A shared library.

    `needs` are libraries, `imports` symbols, `versions` those of the C library, `system` the oldest
    release of macOS as (major, minor), `name` that under which the library calls itself, `guards`
    what the system is asked to hold against attacks, by its own names.
    """

    machine: str
    exports: set[str]
    needs: set[str]
    imports: set[str]
    versions: set[str] = frozenset()  # type: ignore[assignment]
    system: tuple[int, int] = (0, 0)
    name: str = ""
    is_signed: bool = False
    guards: set[str] = frozenset()  # type: ignore[assignment]


# bits of NT_GNU_PROPERTY_TYPE_0, and of DllCharacteristics in the PE header
_ELF_GUARDS = {"GNU_PROPERTY_X86_FEATURE_1_AND": ("IBT", "SHSTK"),
               "GNU_PROPERTY_AARCH64_FEATURE_1_AND": ("BTI", "PAC")}  # fmt: skip
_PE_GUARDS = {0x20: "HIGH_ENTROPY_VA", 0x40: "DYNAMIC_BASE", 0x100: "NX_COMPAT"}


def _elf_guards(file: ELFFile, tags: list[Any]) -> set[str]:
    found = {one.header.p_type for one in file.iter_segments()} & {"PT_GNU_RELRO"}
    if any(tag.entry.d_tag == "DT_FLAGS" and tag.entry.d_val & 0x8 for tag in tags):
        found.add("BIND_NOW")
    for section in file.iter_sections():
        for note in section.iter_notes() if isinstance(section, NoteSection) else ():
            for item in note["n_desc"] if note["n_type"] == "NT_GNU_PROPERTY_TYPE_0" else ():
                names = _ELF_GUARDS.get(item["pr_type"], ())
                found |= {name for i, name in enumerate(names) if item["pr_data"] >> i & 1}
    return found


def elf(content: bytes) -> Binary:
    """Read a library of Linux."""
    file = ELFFile(io.BytesIO(content))
    symbols = [s for s in file.get_section_by_name(".dynsym").iter_symbols() if s.name]
    inside = {s.name for s in symbols if s["st_shndx"] != "SHN_UNDEF"}
    tags = list(file.get_section_by_name(".dynamic").iter_tags())
    versions = {
        version.name
        for section in file.iter_sections()
        if isinstance(section, GNUVerNeedSection)
        for _, auxiliaries in section.iter_versions()
        for version in auxiliaries
    }
    return Binary(
        file["e_machine"],
        inside,
        {tag.needed for tag in tags if tag.entry.d_tag == "DT_NEEDED"},
        {s.name for s in symbols} - inside,
        versions,
        name="".join(tag.runpath for tag in tags if tag.entry.d_tag == "DT_RUNPATH"),
        guards=_elf_guards(file, tags),
    )


def _text(content: bytes, at: int) -> str:
    return content[at : content.index(b"\0", at)].decode()


def pe(content: bytes) -> Binary:
    """Read a library of Windows."""
    (start,) = struct.unpack_from("<I", content, 0x3C)
    assert content[start : start + 4] == b"PE\0\0"
    machine, n_sections, _, _, _, size = struct.unpack_from("<HHIIIH", content, start + 4)
    optional = start + 24
    assert struct.unpack_from("<H", content, optional) == (0x20B,)  # 64-bit
    sections = [
        struct.unpack_from("<8xIIII", content, optional + size + 40 * i) for i in range(n_sections)
    ]

    def place(address: int) -> int:
        for _, virtual, raw_size, raw in sections:
            if virtual <= address < virtual + raw_size:
                return address - virtual + raw
        raise AssertionError(address)

    directories = [struct.unpack_from("<II", content, optional + 112 + 8 * i) for i in range(2)]
    exports_at, imports_at = (place(address) for address, _ in directories)
    count, names = struct.unpack_from("<24xI4xI", content, exports_at)
    exports = {
        _text(content, place(address))
        for (address,) in struct.iter_unpack("<I", content[place(names) : place(names) + 4 * count])
    }
    needs, imports = set(), set()
    while (entry := struct.unpack_from("<IIIII", content, imports_at))[3]:
        needs.add(_text(content, place(entry[3])))
        at = place(entry[0] or entry[4])
        while (symbol := struct.unpack_from("<Q", content, at)[0]) != 0:
            imports.add(_text(content, place(symbol) + 2))
            at += 8
        imports_at += 20
    (flags,) = struct.unpack_from("<H", content, optional + 70)
    guards = {name for bit, name in _PE_GUARDS.items() if flags & bit}
    return Binary({0x8664: "x86_64"}[machine], exports, needs, imports, guards=guards)


def mach_o(content: bytes) -> Binary:
    """Read a library of macOS for one processor."""
    magic, machine, _, kind, n_commands = struct.unpack_from("<5I", content)
    assert (magic, kind) == (0xFEEDFACF, 6)  # 64-bit, dynamic library
    found: dict[str, Any] = {"needs": set(), "name": "", "system": (0, 0), "is_signed": False}
    exports: set[str] = set()
    imports: set[str] = set()
    at = 32
    for _ in range(n_commands):
        command, size = struct.unpack_from("<II", content, at)
        if command in (0xC, 0xD):
            (offset,) = struct.unpack_from("<8xI", content, at)
            name = _text(content, at + offset)
            if command == 0xD:
                found["name"] = name
            else:
                found["needs"].add(name)
        elif command == 0x32:  # build version
            (oldest,) = struct.unpack_from("<12xI", content, at)
            found["system"] = (oldest >> 16, oldest >> 8 & 0xFF)
        elif command == 0x1D:
            found["is_signed"] = True
        elif command == 0x2:
            first, count, strings, _ = struct.unpack_from("<8x4I", content, at)
            for i in range(count):
                where, type_, section = struct.unpack_from("<IBB", content, first + 16 * i)
                if type_ & 0x01 and not type_ & 0x10:  # external, not private
                    (exports if section else imports).add(_text(content, strings + where))
        at += size
    machines = {0x01000007: "x86_64", 0x0100000C: "arm64"}
    return Binary(machines[machine], exports, found.pop("needs"), imports, **found)
