# SPDX-License-Identifier: MIT
"""The registers as CANopen objects: the firmware's table, the electronic data sheet (CiA 306), and
the tables of docs/canopen.md."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

from c_map import NOTE
from table import SPACES, Fixed, Group, Register, of_space
from versions import version

# Every register is also an object of its own: index of the first address of a space.
FIRST = {"holding": 0x2000, "input": 0x2800}
OCTETS = {"u8": 1, "i8": 1, "u16": 2, "i16": 2, "u32": 4, "i32": 4, "dec": 4}
EDS_TYPES = {
    "i8": 2,
    "i16": 3,
    "i32": 4,
    "u8": 5,
    "u16": 6,
    "u32": 7,
    "dec": 7,
    "text": 9,
    "domain": 15,
}
PDOS = 4
MAPPED = 8
PRESET = 2  # objects of a PDO at the start, at most


@dataclass(frozen=True)
class Preset:
    """A PDO at the start: objects, transmission type, inhibit time in 100 us."""

    objects: Tuple[int, ...]
    type: int
    inhibit_100us: int


# The objects are those of CiA 402. Speeds and positions leave with every SYNC. Chosen: 10 ms
# between two events, of which two PDOs take 3 % of 500 kbit/s.
RECEIVED = tuple(
    Preset(objects, 255, 0)
    for objects in (
        (0x60400010,),
        (0x60400010, 0x60600008),
        (0x60400010, 0x607A0020),
        (0x60400010, 0x60FF0020),
    )
)
SENT = (
    Preset((0x60410010,), 255, 100),
    Preset((0x60410010, 0x60610008), 255, 100),
    Preset((0x60410010, 0x60640020), 1, 100),
    Preset((0x60410010, 0x606C0020), 1, 100),
)


@dataclass(frozen=True)
class Entry:
    """One sub-index."""

    index: int
    sub: int
    name: str
    type: str
    access: str  # ro, rw, const
    default: str = ""
    mappable: bool = False
    limits: Optional[Tuple[float, float]] = None
    register: Optional[Register] = None
    space: str = ""
    row: int = 0
    value: int = 0
    text: str = ""


def _number(text: str) -> int:
    return int(text.rstrip("h"), 16)


def _entry(r: Register, space: str, row: int) -> Entry:
    kind = r.can or r.type
    limits = None
    if r.range and not r.signature and r.type != "dec":
        limits = (r.range[0] / (r.step or 1.0), r.range[1] / (r.step or 1.0))
    return Entry(
        index=_number(r.object) if r.object else FIRST[space] + r.address,
        sub=r.sub,
        name=r.name,
        type=kind,
        access="rw" if space == "holding" else "ro",
        mappable=not r.signature,
        limits=limits,
        register=r,
        space=space,
        row=row,
        text=r.text,
    )


def _registers(groups: List[Group]) -> List[Entry]:
    return [_entry(r, s, n) for s in SPACES for n, r in enumerate(of_space(groups, s))]


def _fixed(fixed: List[Fixed]) -> List[Entry]:
    major, minor, patch = (int(x) for x in version().split("."))
    revision = (major << 16) | (minor << 8) | patch
    return [
        Entry(
            index=_number(f.object),
            sub=f.sub,
            name=f.name,
            type=f.type,
            access="rw" if f.writable else "const",
            value=revision if f.value is None else f.value,
            text=f.text,
        )
        for f in fixed
    ]


def standard(groups: List[Group], fixed: List[Fixed]) -> List[Entry]:
    """Objects of a standard's index: those of registers, and constants."""
    found = [e for e in _registers(groups) if e.register.object] + _fixed(fixed)
    return sorted(found, key=lambda e: (e.index, e.sub))


def header(groups: List[Group], fixed: List[Fixed]) -> str:
    """app_canopen_map.h."""
    return "\n".join(
        [
            "/* SPDX-License-Identifier: MIT */",
            NOTE,
            "/* clang-format off */",
            "/**",
            " * @file app_canopen_map.h",
            " * @brief Objects that a standard gives an index; docs/canopen.md has them.",
            " */",
            "#ifndef APP_CANOPEN_MAP_H",
            "#define APP_CANOPEN_MAP_H",
            "",
            '#include "app_registers_map.h"',
            "",
            "/** Objects of the first holding register, and of the first input register. */",
            f"#define APP_CANOPEN_HOLDING 0x{FIRST['holding']:04X}U",
            f"#define APP_CANOPEN_INPUT   0x{FIRST['input']:04X}U",
            "",
            "typedef struct {",
            "    uint16_t index;",
            "    uint16_t sub;",
            "    uint16_t octets; /**< 1, 2 or 4 */",
            "    bool     writable; /**< of a constant: it takes its own value */",
            "    const app_registers_entry_t *entry; /**< the register; NULL: a constant */",
            "    uint32_t value;                     /**< of the constant */",
            "} app_canopen_object_t;",
            "",
            "/** A PDO at the start. */",
            "typedef struct {",
            f"    uint32_t objects[{PRESET}];",
            "    uint16_t count;",
            "    uint16_t type; /**< of transmission */",
            "    uint16_t inhibit_100us;",
            "} app_canopen_preset_t;",
            "",
            f"#define APP_CANOPEN_OBJECTS {len(standard(groups, fixed))}U",
            "",
            "/** In ascending order of index and sub-index. */",
            "extern const app_canopen_object_t app_canopen_map[APP_CANOPEN_OBJECTS];",
            "",
            f"#define APP_CANOPEN_PDOS {PDOS}U /**< of each direction */",
            "",
            "extern const app_canopen_preset_t app_canopen_received[APP_CANOPEN_PDOS];",
            "extern const app_canopen_preset_t app_canopen_sent[APP_CANOPEN_PDOS];",
            "",
            "#endif /* APP_CANOPEN_MAP_H */",
            "",
        ]
    )


def source(groups: List[Group], fixed: List[Fixed]) -> str:
    """app_canopen_map.c."""
    lines = [
        "/* SPDX-License-Identifier: MIT */",
        NOTE,
        "/* clang-format off */",
        '#include "app_canopen_map.h"',
        "",
        "#include <stddef.h>",
        "",
        "const app_canopen_object_t app_canopen_map[APP_CANOPEN_OBJECTS] = {",
    ]
    for e in standard(groups, fixed):
        entry = f"&app_registers_map_{e.space}[{e.row}]" if e.register else "NULL"
        write = "true" if e.access == "rw" else "false"
        value = e.value & 0xFFFFFFFF
        lines.append(
            f"    {{0x{e.index:04X}U, {e.sub}U, {OCTETS[e.type]}U, {write}, {entry}, "
            f"0x{value:08X}UL}}, /* {e.name} */"
        )
    lines.append("};")
    for name, presets in (("received", RECEIVED), ("sent", SENT)):
        lines += ["", f"const app_canopen_preset_t app_canopen_{name}[APP_CANOPEN_PDOS] = {{"]
        for p in presets:
            objects = [*p.objects, *[0] * (PRESET - len(p.objects))]
            words = ", ".join(f"0x{o:08X}UL" for o in objects)
            lines.append(f"    {{{{{words}}}, {len(p.objects)}U, {p.type}U, {p.inhibit_100us}U}},")
        lines.append("};")
    return "\n".join([*lines, ""])


def _own() -> List[Entry]:
    """Objects of the node's own state."""
    e = [
        Entry(0x1001, 0, "Error register", "u8", "ro"),
        Entry(0x1003, 0, "Number of errors", "u8", "rw"),
        *(Entry(0x1003, n, f"Error {n}", "u32", "ro") for n in range(1, 9)),
        Entry(0x1008, 0, "Device name", "text", "const"),
        Entry(0x100A, 0, "Software version", "text", "const"),
        Entry(0x1014, 0, "COB-ID of emergencies", "u32", "ro", "$NODEID+0x80"),
        Entry(0x1016, 0, "Highest sub-index", "u8", "const", "1"),
        Entry(0x1016, 1, "Heartbeat that is watched", "u32", "rw", "0"),
        Entry(0x1017, 0, "Heartbeat period", "u16", "rw", "0"),
        Entry(0x1200, 0, "Highest sub-index", "u8", "const", "2"),
        Entry(0x1200, 1, "COB-ID of requests", "u32", "ro", "$NODEID+0x600"),
        Entry(0x1200, 2, "COB-ID of answers", "u32", "ro", "$NODEID+0x580"),
        Entry(0x5F00, 0, "Highest sub-index", "u8", "const", "3"),
        Entry(0x5F00, 1, "Block of registers: selection", "u32", "rw", "0x00010000"),
        Entry(0x5F00, 2, "Block of registers: input registers", "domain", "ro"),
        Entry(0x5F00, 3, "Block of registers: holding registers", "domain", "rw"),
        Entry(0x5F01, 0, "Highest sub-index", "u8", "const", "4"),
        Entry(0x5F01, 1, "Identification: drive", "text", "const"),
        Entry(0x5F01, 2, "Identification: digest of the drive file", "text", "const"),
        Entry(0x5F01, 3, "Identification: digest of the registers", "text", "const"),
        Entry(0x5F01, 4, "Identification: board", "text", "const"),
    ]
    for n in range(PDOS):
        e += _pdo(n, receive=True) + _pdo(n, receive=False)
    return e


def _pdo(n: int, receive: bool) -> List[Entry]:
    what = f"{'RPDO' if receive else 'TPDO'} {n + 1}"
    settings = (0x1400 if receive else 0x1800) + n
    mapping = (0x1600 if receive else 0x1A00) + n
    cob = (0x200 if receive else 0x180) + 0x100 * n
    start = (RECEIVED if receive else SENT)[n]
    objects = start.objects
    return [
        Entry(settings, 0, f"{what}: highest sub-index", "u8", "const", "5"),
        Entry(settings, 1, f"{what}: COB-ID", "u32", "rw", f"$NODEID+0x{cob:X}"),
        Entry(settings, 2, f"{what}: transmission type", "u8", "rw", str(start.type)),
        Entry(settings, 3, f"{what}: inhibit time", "u16", "rw", str(start.inhibit_100us)),
        Entry(settings, 5, f"{what}: event timer", "u16", "rw", "0"),
        Entry(mapping, 0, f"{what}: number of objects", "u8", "rw", str(len(objects))),
        *(
            Entry(
                mapping,
                k + 1,
                f"{what}: object {k + 1}",
                "u32",
                "rw",
                f"0x{objects[k] if k < len(objects) else 0:08X}",
            )
            for k in range(MAPPED)
        ),
    ]


def _all(groups: List[Group], fixed: List[Fixed]) -> List[Entry]:
    found = _registers(groups) + _fixed(fixed) + _own()
    return sorted(found, key=lambda e: (e.index, e.sub))


def _eds_entry(e: Entry, section: str) -> List[str]:
    lines = [
        f"[{section}]",
        f"ParameterName={e.name}",
        "ObjectType=0x7",
        f"DataType=0x{EDS_TYPES[e.type]:04X}",
        f"AccessType={e.access}",
    ]
    if e.limits:
        lines += [f"LowLimit={round(e.limits[0])}", f"HighLimit={round(e.limits[1])}"]
    value = e.default or (str(e.value) if e.access != "ro" and not e.register else "")
    if value and e.type not in ("text", "domain"):
        lines.append(f"DefaultValue={value}")
    lines += [f"PDOMapping={int(e.mappable)}", ""]
    return lines


def eds(groups: List[Group], fixed: List[Fixed]) -> str:
    """docs/sdre-drive.eds. It has no date: the same table gives the same octets."""
    found: Dict[int, List[Entry]] = {}
    for e in _all(groups, fixed):
        found.setdefault(e.index, []).append(e)
    lists = {"Mandatory": [], "Optional": [], "Manufacturer": []}
    for index in found:
        kind = "Manufacturer" if 0x2000 <= index < 0x6000 else "Optional"
        lists["Mandatory" if index in (0x1000, 0x1001, 0x1018) else kind].append(index)
    lines = [
        "; Generated from firmware/app/registers/registers.toml: host_tools/registers/generate.py.",
        "[FileInfo]",
        "FileName=sdre-drive.eds",
        "FileVersion=1",
        "FileRevision=0",
        "EDSVersion=4.0",
        "Description=sdre-drive on CANopen, CiA 301 and CiA 402",
        "",
        "[DeviceInfo]",
        "VendorName=sdre-drive",
        "VendorNumber=0",
        "ProductName=sdre-drive",
        *(
            f"BaudRate_{rate}={int(rate in (125, 250, 500, 1000))}"
            for rate in (10, 20, 50, 125, 250, 500, 800, 1000)
        ),
        "SimpleBootUpMaster=0",
        "SimpleBootUpSlave=1",
        "Granularity=8",
        "DynamicChannelsSupported=0",
        "GroupMessaging=0",
        f"NrOfRXPDO={PDOS}",
        f"NrOfTXPDO={PDOS}",
        "LSS_Supported=0",
        "",
    ]
    for name, indices in lists.items():
        lines += [f"[{name}Objects]", f"SupportedObjects={len(indices)}"]
        lines += [f"{n + 1}=0x{i:04X}" for n, i in enumerate(indices)] + [""]
    for index, entries in found.items():
        if len(entries) == 1 and entries[0].sub == 0:
            lines += _eds_entry(entries[0], f"{index:04X}")
            continue
        array = index in (0x1003, 0x1010, 0x1011, 0x1016, 0x60A4)
        name = next((e.name for e in entries if e.register), entries[-1].name)
        lines += [
            f"[{index:04X}]",
            f"ParameterName={name.split(':')[0]} {index:04X}h",
            f"ObjectType=0x{8 if array else 9}",
            f"SubNumber={len(entries)}",
            "",
        ]
        for e in entries:
            lines += _eds_entry(e, f"{index:04X}sub{e.sub:X}")
    return "\n".join(lines)


def _unit(e: Entry) -> str:
    return e.register.unit_words if e.register else ""


def objects_text(groups: List[Group], fixed: List[Fixed]) -> str:
    """The objects of standards, for docs/canopen.md."""
    lines = ["| object | type | access | unit | register | |", "|---|---|---|---|---|---|"]
    for e in standard(groups, fixed):
        place = f"{e.index:04X}h" + (f":{e.sub}" if e.sub else "")
        register = f"`{e.name}`" if e.register else ""
        lines.append(f"| {place} | {e.type} | {e.access} | {_unit(e)} | {register} | {e.text} |")
    return "\n".join(lines)
