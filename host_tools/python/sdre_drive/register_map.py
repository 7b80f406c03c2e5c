# SPDX-License-Identifier: MIT
"""Generated from firmware/app/registers.toml. Do not edit: host_tools/registers/generate.py."""

from __future__ import annotations

from typing import NamedTuple, Tuple


class Register(NamedTuple):
    """One value: step is 0 for a whole number."""

    name: str
    address: int
    type: str
    step: float
    unit: str


DIGEST = "1d52188f"

COMMAND: Tuple[Register, ...] = (  # holding
    Register("RUN", 0, "u16", 0.0, ""),
    Register("RESET", 1, "u16", 0.0, ""),
    Register("SPEED", 2, "i32", 0.1, "rad/s electrical"),
    Register("SPEED_RPM", 4, "i32", 0.1, "r/min"),
    Register("SPEED_RPM_16", 6, "i16", 1.0, "r/min"),
    Register("COMMISSION", 7, "u16", 0.0, ""),
    Register("COMMISSION_CURRENT", 8, "u16", 0.01, "A"),
    Register("COMMISSION_SPEED", 9, "u16", 0.1, "rad/s mechanical"),
)  # fmt: skip

LINE: Tuple[Register, ...] = (  # holding
    Register("MODBUS_ADDRESS", 64, "u16", 0.0, ""),
    Register("MODBUS_TIMEOUT", 65, "u16", 0.001, "s"),
)  # fmt: skip

LIVE: Tuple[Register, ...] = (  # input
    Register("MODE", 0, "u16", 0.0, ""),
    Register("FAULT", 1, "u16", 0.0, ""),
    Register("DRIVE_FAULT", 2, "u16", 0.0, ""),
    Register("BOARD_FAULTS", 3, "u16", 0.0, "bits"),
    Register("CONDITIONS", 4, "u16", 0.0, "bits"),
    Register("REFERENCE", 5, "u16", 0.0, ""),
    Register("ALIGN_STAGE", 6, "u16", 0.0, ""),
    Register("SPEED_NOW", 7, "i32", 0.1, "rad/s electrical"),
    Register("SPEED_NOW_RPM", 9, "i32", 0.1, "r/min"),
    Register("IQ", 11, "i32", 0.001, "A"),
    Register("ID", 13, "i32", 0.001, "A"),
    Register("IQ_REF", 15, "i32", 0.001, "A"),
    Register("ID_REF", 17, "i32", 0.001, "A"),
    Register("VQ", 19, "i16", 0.1, "V"),
    Register("VD", 20, "i16", 0.1, "V"),
    Register("DC_LINK", 21, "u16", 0.1, "V"),
    Register("TEMPERATURE", 22, "i16", 0.1, "degC"),
    Register("THETA", 23, "u16", 0.001, "rad"),
    Register("POSITION", 24, "u16", 0.0, "counts"),
    Register("CORRECTIONS", 25, "u16", 0.0, ""),
    Register("ZERO_A", 26, "u16", 0.1, "codes"),
    Register("ZERO_B", 27, "u16", 0.1, "codes"),
    Register("CYCLES", 28, "u16", 0.0, "cycles"),
    Register("CYCLES_WORST", 29, "u16", 0.0, "cycles"),
    Register("TICKS", 30, "u32", 0.0, "control periods"),
    Register("RESET_CAUSE", 32, "u16", 0.0, ""),
    Register("PHASE_ERRORS", 33, "u16", 0.0, ""),
    Register("IGNORED_ANGLES", 34, "u16", 0.0, "samples"),
    Register("IGNORED_CURRENTS", 35, "u16", 0.0, "samples"),
    Register("JUMPS", 36, "u16", 0.0, ""),
    Register("MOTOR_HEAT", 37, "u16", 0.001, ""),
    Register("INVERTER_HEAT", 38, "u16", 0.001, ""),
    Register("DERATING", 39, "u16", 0.001, ""),
    Register("FIRST_FAULT", 40, "u16", 0.0, ""),
    Register("FIRST_MODE", 41, "u16", 0.0, ""),
    Register("FIRST_DRIVE_FAULT", 42, "u16", 0.0, ""),
    Register("FIRST_BOARD_FAULTS", 43, "u16", 0.0, "bits"),
    Register("FIRST_IA", 44, "u16", 0.0, "codes"),
    Register("FIRST_IB", 45, "u16", 0.0, "codes"),
    Register("FIRST_DC_LINK", 46, "u16", 0.0, "codes"),
    Register("FIRST_TEMPERATURE", 47, "u16", 0.0, "codes"),
    Register("FIRST_POSITION", 48, "u16", 0.0, "counts"),
    Register("FIRST_INDEX", 49, "u16", 0.0, "counts"),
    Register("FIRST_SAMPLE", 50, "u16", 0.0, "bits"),
    Register("FIRST_SPEED", 51, "i32", 0.1, "rad/s electrical"),
    Register("FIRST_WANTED", 53, "i32", 0.1, "rad/s electrical"),
    Register("FIRST_TICKS", 55, "u32", 0.0, "control periods"),
)  # fmt: skip

COMMISSIONING: Tuple[Register, ...] = (  # input
    Register("COMMISSION_STAGE", 128, "u16", 0.0, ""),
    Register("COMMISSION_REASON", 129, "u16", 0.0, ""),
    Register("COMMISSION_PERCENT", 130, "u16", 0.0, "%"),
    Register("FOUND_DIRECTION", 131, "i16", 0.0, ""),
    Register("FOUND_POLE_PAIRS", 132, "u16", 0.0, ""),
    Register("FOUND_COUNTS", 133, "u32", 0.0, "counts"),
    Register("FOUND_RELUCTANCE", 135, "u16", 0.0, ""),
    Register("FOUND_R", 136, "dec", 0.0, "Ohm"),
    Register("FOUND_R_ERROR", 138, "dec", 0.0, "Ohm"),
    Register("FOUND_V_LOSS", 140, "dec", 0.0, "V"),
    Register("FOUND_V_LOSS_ERROR", 142, "dec", 0.0, "V"),
    Register("FOUND_LD", 144, "dec", 0.0, "H"),
    Register("FOUND_LD_ERROR", 146, "dec", 0.0, "H"),
    Register("FOUND_LQ", 148, "dec", 0.0, "H"),
    Register("FOUND_LQ_ERROR", 150, "dec", 0.0, "H"),
    Register("FOUND_FLUX", 152, "dec", 0.0, "Wb"),
    Register("FOUND_FLUX_ERROR", 154, "dec", 0.0, "Wb"),
    Register("FOUND_INERTIA", 156, "dec", 0.0, "kg m2"),
    Register("FOUND_INERTIA_ERROR", 158, "dec", 0.0, "kg m2"),
    Register("FOUND_FRICTION", 160, "dec", 0.0, "N m s"),
    Register("FOUND_FRICTION_ERROR", 162, "dec", 0.0, "N m s"),
    Register("FOUND_COULOMB", 164, "dec", 0.0, "N m"),
    Register("FOUND_COULOMB_ERROR", 166, "dec", 0.0, "N m"),
    Register("FOUND_OFFSET", 168, "dec", 0.0, "rad"),
    Register("FOUND_OFFSET_ERROR", 170, "dec", 0.0, "rad"),
)  # fmt: skip

CONSTANTS: Tuple[Register, ...] = (  # input
    Register("POLE_PAIRS", 256, "u16", 0.0, ""),
    Register("ENCODER_POSITIONS", 257, "u32", 0.0, "counts"),
    Register("CONTROL_PERIOD", 259, "u32", 1e-09, "s"),
    Register("SPEED_MAX", 261, "i32", 0.1, "rad/s electrical"),
    Register("SPEED_MAX_RPM", 263, "i32", 0.1, "r/min"),
    Register("SPEED_TRIP", 265, "i32", 0.1, "rad/s electrical"),
    Register("CURRENT_MAX", 267, "i32", 0.001, "A"),
    Register("CURRENT_TRIP", 269, "i32", 0.001, "A"),
    Register("DC_LINK_MIN", 271, "u16", 0.1, "V"),
    Register("DC_LINK_MAX", 272, "u16", 0.1, "V"),
    Register("TEMPERATURE_LIMIT", 273, "i16", 0.1, "degC"),
    Register("TEMPERATURE_TRIP", 274, "i16", 0.1, "degC"),
)  # fmt: skip

HOLDING = (*COMMAND, *LINE)
INPUT = (*LIVE, *COMMISSIONING, *CONSTANTS)
