# SPDX-License-Identifier: MIT
"""The firmware's map of the registers as C."""

from __future__ import annotations

from typing import Iterable, List, Tuple

from table import SPACES, Group, Register, of_space
from versions import digest_of, id_of, saved, version

NOTE = "/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */"
HOMES = {
    "": "COMPUTED",
    "requested": "app_registers_request_t",
    "status": "app_status_t",
    "drive": "drive_config_t",
    "config": "app_config_t",
}
MEMBERS = {
    "u16": "uint16_t",
    "i16": "int16_t",
    "u32": "uint32_t",
    "i32": "int32_t",
    "float": "float",
    "bool": "bool",
}
TYPES = {"u16": "U16", "i16": "I16", "u32": "U32", "i32": "I32", "dec": "DEC"}


def _c_float(x: float) -> str:
    text = f"{x:.9g}"
    return (text if "." in text or "e" in text else text + ".0") + "f"


def _c_bool(x: bool) -> str:
    return "true" if x else "false"


def _enum(groups: Iterable[Group]) -> List[str]:
    lines = ["enum {"]
    for g in groups:
        for r in g.registers:
            lines.append(f"    APP_REGISTERS_{r.name} = {r.address},")
        lines.append(f"    APP_REGISTERS_{g.name.upper()}_FIRST = {g.first},")
        lines.append(f"    APP_REGISTERS_{g.name.upper()}_END = {g.end},")
    lines[-1] = lines[-1].rstrip(",")
    return [*lines, "};", ""]


def header(groups: List[Group]) -> str:
    """app_registers_map.h."""
    lines = [
        "/* SPDX-License-Identifier: MIT */",
        NOTE,
        "/* clang-format off */",
        "/**",
        " * @file app_registers_map.h",
        " * @brief Addresses and kinds of the registers, and where their values come from.",
        " * docs/modbus.md says what they mean.",
        " */",
        "#ifndef APP_REGISTERS_MAP_H",
        "#define APP_REGISTERS_MAP_H",
        "",
        '#include "base.h"',
        "",
        f'#define APP_REGISTERS_VERSION "{version()}"   /**< of the firmware */',
        f'#define APP_REGISTERS_DIGEST "{digest_of(groups)}" /**< of what a master can see of the '
        f"map */",
        "",
        f"#define APP_REGISTERS_SAVED {len(saved(groups))}U /**< parameters */",
        "",
    ]
    for space in SPACES:
        lines += [
            f"/** {space.capitalize()} registers: those of two words are named by the first. */"
        ]
        lines += _enum(g for g in groups if g.space == space)
    lines += [
        "typedef enum {",
        "    APP_REGISTERS_U16 = 0,",
        "    APP_REGISTERS_I16,",
        "    APP_REGISTERS_U32, /**< two words, the high one first, as the next */",
        "    APP_REGISTERS_I32,",
        "    APP_REGISTERS_DEC /**< two words: digits and power of ten, both signed */",
        "} app_registers_type_t;",
        "",
        "/** Where a value is. */",
        "typedef enum {",
        "    APP_REGISTERS_COMPUTED = 0, /**< app_registers_map_real() and its kin */",
        "    APP_REGISTERS_REQUESTED, /**< a member of the app_registers_request_t */",
        "    APP_REGISTERS_STATUS, /**< of the app_status_t */",
        "    APP_REGISTERS_DRIVE,  /**< of the drive_config_t */",
        "    APP_REGISTERS_CONFIG  /**< of the app_config_t */",
        "} app_registers_home_t;",
        "",
        "/** Type of that member. */",
        "typedef enum {",
        "    APP_REGISTERS_AS_U16 = 0,",
        "    APP_REGISTERS_AS_I16,",
        "    APP_REGISTERS_AS_U32,",
        "    APP_REGISTERS_AS_I32,",
        "    APP_REGISTERS_AS_FLOAT,",
        "    APP_REGISTERS_AS_BOOL,",
        "    APP_REGISTERS_AS_CHAR, /**< an enumeration of this size */",
        "    APP_REGISTERS_AS_INT",
        "} app_registers_kind_t;",
        "",
        "typedef struct {",
        "    uint16_t             address; /**< of the first word */",
        "    app_registers_type_t type;",
        "    float                per_unit; /**< counts of one SI unit; 0: a whole number */",
        "    float                least;    /**< what a write may bring, in SI units */",
        "    float                most;",
        "    bool                 stopped;   /**< written while the bridge is off only */",
        "    uint16_t             saved;     /**< digest of a parameter; 0: it is none */",
        "    uint32_t             signature; /**< the one value that is taken; 0: no such thing */",
        "    app_registers_home_t home;",
        "    app_registers_kind_t kind;",
        "    uint16_t             offset; /**< of the member; of a computed value its number */",
        "    bool                 rpm;    /**< the member is electrical rad/s */",
        "    uint16_t             sense;  /**< bit of the polarity that reverses it; 0: none */",
        "} app_registers_entry_t;",
        "",
        "struct app_registers;",
        "struct app_registers_request;",
        "",
    ]
    for space in SPACES:
        count = sum(1 for _ in of_space(groups, space))
        lines += [f"#define APP_REGISTERS_MAP_{space.upper()} {count}U", ""]
    lines += [
        "/** Rows in ascending order of the address. */",
        "extern const app_registers_entry_t app_registers_map_holding[APP_REGISTERS_MAP_HOLDING];",
        "extern const app_registers_entry_t app_registers_map_input[APP_REGISTERS_MAP_INPUT];",
        "",
    ]
    lines += [
        "/** A computed value with a unit, and one without, by its number; 0: there is none. */",
        "float    app_registers_map_real(const struct app_registers *r, uint16_t number);",
        "uint32_t app_registers_map_whole(const struct app_registers *r, uint16_t number);",
        "",
        "/** Puts a value that is in its range into w, as its number says. */",
        "void app_registers_map_put(const struct app_registers *r,",
        "                           struct app_registers_request *w, uint16_t number, float x);",
        "",
        "#endif /* APP_REGISTERS_MAP_H */",
        "",
    ]
    return "\n".join(lines)


def _computed(groups: List[Group]) -> List[Register]:
    """The registers that are no members, by their number."""
    return [r for space in SPACES for r in of_space(groups, space) if not r.member]


def _place(groups: List[Group], r: Register) -> str:
    """Home, kind, offset and unit of a row."""
    if not r.member:
        number = _computed(groups).index(r)
        return f"APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, {number}U, false, 0U"
    of = HOMES[r.home]
    kind = f"APP_REGISTERS_AS_{r.kind.upper()}" if r.kind in MEMBERS else f"OF_ENUM({r.kind})"
    at = f"AT({of}, {r.member})"
    return f"APP_REGISTERS_{r.home.upper()}, {kind}, {at}, {_c_bool(r.rpm)}, {r.sense}U"


def _table(groups: List[Group], space: str) -> List[str]:
    lines = [
        f"const app_registers_entry_t app_registers_map_{space}[APP_REGISTERS_MAP_{space.upper()}] "
        f"= {{"
    ]
    for r in of_space(groups, space):
        low, high = r.range or (0.0, 0.0)
        lines.append(
            f"    {{APP_REGISTERS_{r.name}, APP_REGISTERS_{TYPES[r.type]}, {_c_float(r.per_unit)}, "
            f"{_c_float(low)}, {_c_float(high)}, {_c_bool(r.stopped)}, 0x{id_of(r):04X}U, "
            f"{f'0x{r.signature:08X}UL' if r.signature else '0UL'}, {_place(groups, r)}}},"
        )
    return [*lines, "};", ""]


def _switch(cases: Iterable[Tuple[int, str, str]]) -> List[str]:
    lines = ["    switch (number) {"]
    for number, name, line in cases:
        lines += [f"    case {number}U: /* {name} */", f"        {line};", "        break;"]
    return [*lines, "    default:", "        break;", "    }"]


def _getter(groups: List[Group], real: bool) -> List[str]:
    kind, name = ("float", "real") if real else ("uint32_t", "whole")
    zero = "0.0f" if real else "0U"
    found = [
        (n, r.name, f"x = {r.source}") for n, r in enumerate(_computed(groups)) if r.is_real == real
    ]
    return [
        f"{kind} app_registers_map_{name}(const app_registers_t *r, uint16_t number)",
        "{",
        f"    {kind} x = {zero};",
        "",
        *_switch(found),
        "    return x;",
        "}",
        "",
    ]


def source(groups: List[Group]) -> str:
    """app_registers_map.c."""
    lines = [
        "/* SPDX-License-Identifier: MIT */",
        NOTE,
        "/* clang-format off */",
        '#include "app_registers.h"',
        "",
        "#include <stddef.h>",
        "",
        "/* Offset of a member. Test unit.app_registers compares its type. */",
        "#define AT(t, m) ((uint16_t)offsetof(t, m))",
        "",
        "/* An enumeration is as short as a char, or an int. */",
        "#define OF_ENUM(t) \\",
        "    ((sizeof(t) == sizeof(unsigned char)) ? APP_REGISTERS_AS_CHAR : APP_REGISTERS_AS_INT)",
        "",
    ]
    for space in SPACES:
        lines += _table(groups, space)
    put = [(n, r.name, r.target) for n, r in enumerate(_computed(groups)) if r.target]
    lines += [
        *_getter(groups, True),
        *_getter(groups, False),
        "void app_registers_map_put(const app_registers_t *r, app_registers_request_t *w, uint16_t "
        "number, float x)",
        "{",
        *_switch(put),
        "}",
        "",
    ]
    return "\n".join(lines)


def types(groups: List[Group]) -> str:
    """register_types.h, of the unit test."""
    lines = [
        "/* SPDX-License-Identifier: MIT */",
        NOTE,
        "/* clang-format off */",
        "/* Does not compile if a member has another type than its row says, or an enumeration "
        "another size. */",
        "#ifndef REGISTER_TYPES_H",
        "#define REGISTER_TYPES_H",
        "",
        "#define IS(t, m, type) (void)sizeof((1) ? &((const t *)0)->m : (const type *)0)",
        "#define FITS(type) \\",
        "    (void)sizeof(char[((sizeof(type) == 1U) || (sizeof(type) == sizeof(int))) ? 1 : -1])",
        "",
        "static void register_types(void)",
        "{",
    ]
    rows = [r for space in SPACES for r in of_space(groups, space) if r.member]
    lines += sorted(
        {f"    IS({HOMES[r.home]}, {r.member}, {MEMBERS.get(r.kind, r.kind)});" for r in rows}
    )
    lines += sorted({f"    FITS({r.kind});" for r in rows if r.kind not in MEMBERS})
    return "\n".join([*lines, "}", "", "#endif /* REGISTER_TYPES_H */", ""])
