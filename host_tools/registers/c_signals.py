# SPDX-License-Identifier: MIT
"""The signals of the scope as C."""

from __future__ import annotations

from typing import List

from c_map import NOTE
from table import Signal

LICENCE = "/* SPDX-License-Identifier: MIT */"


def signals_header(found: List[Signal]) -> str:
    """app_scope_signals.h."""
    lines = [
        LICENCE,
        NOTE,
        "/* clang-format off */",
        "/**",
        " * @file app_scope_signals.h",
        " * @brief Signals of the scope. Units: docs/modbus.md.",
        " */",
        "#ifndef APP_SCOPE_SIGNALS_H",
        "#define APP_SCOPE_SIGNALS_H",
        "",
        '#include "app_modes.h"',
        "",
        "enum {",
        *[f"    APP_SCOPE_{s.name} = {s.number}," for s in found],
        f"    APP_SCOPE_SIGNALS = {len(found)}",
        "};",
        "",
        "/** The end of a tick. */",
        "typedef struct {",
        "    const app_modes_t   *modes;",
        "    const app_command_t *command;",
        "    const bridge_t      *out;",
        "} app_scope_view_t;",
        "",
        "/** 0 for a number that is none of them. Context: control ISR. One branch by a table of "
        "cases. */",
        "float app_scope_signals_value(const app_scope_view_t *v, uint16_t signal);",
        "",
        "#endif /* APP_SCOPE_SIGNALS_H */",
        "",
    ]
    return "\n".join(lines)


def signals_source(found: List[Signal]) -> str:
    """app_scope_signals.c."""
    lines = [
        LICENCE,
        NOTE,
        "/* clang-format off */",
        '#include "app_scope_signals.h"',
        "",
        "/* While the drive runs this is its estimate. */",
        "static float app_scope_speed(const app_modes_t *m)",
        "{",
        "    return (m->drive.state == DRIVE_RUN) ? m->drive.answer.now.omega_e_radps : "
        "m->reading.omega_e_radps;",
        "}",
        "",
        "float app_scope_signals_value(const app_scope_view_t *v, uint16_t signal)",
        "{",
        "    float x = 0.0f;",
        "",
        "    switch (signal) {",
    ]
    for s in found:
        lines += [f"    case APP_SCOPE_{s.name}:", f"        x = {s.source};", "        break;"]
    return "\n".join([*lines, "    default:", "        break;", "    }", "    return x;", "}", ""])
