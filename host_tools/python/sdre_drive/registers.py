# SPDX-License-Identifier: MIT
"""The registers of docs/modbus.md as SI values. Needs nothing but the standard library."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Sequence

# Holding registers from 0 on.
HOLDING_NAMES = ("RUN", "RESET", "SPEED", "COMMISSION", "COMMISSION_CURRENT", "COMMISSION_SPEED")
RUN, RESET, SPEED, COMMISSION = range(4)
SPEED_PER_UNIT_E_RADPS = 0.1
TICK_S = 200e-6

# Input registers from 0 on, named as APP_REGISTERS_* in firmware/app/app_registers.h; those of commissioning follow.
INPUT_NAMES = (
    "MODE", "FAULT", "DRIVE_FAULT", "BOARD_FAULTS", "CONDITIONS", "REFERENCE", "ALIGN_STAGE", "SPEED_NOW",
    "IQ", "ID", "IQ_REF", "ID_REF", "VQ", "VD", "DC_LINK", "TEMPERATURE", "THETA", "POSITION", "CORRECTIONS",
    "ZERO_A", "ZERO_B", "CYCLES", "CYCLES_WORST", "TICKS_HI", "TICKS_LO",
    "FIRST_FAULT", "FIRST_MODE", "FIRST_DRIVE_FAULT", "FIRST_BOARD_FAULTS", "FIRST_IA", "FIRST_IB",
    "FIRST_DC_LINK", "FIRST_TEMPERATURE", "FIRST_POSITION", "FIRST_INDEX", "FIRST_SAMPLE", "FIRST_SPEED",
    "FIRST_WANTED", "FIRST_TICKS_HI", "FIRST_TICKS_LO",
    "RESET_CAUSE", "PHASE_ERRORS", "IGNORED_ANGLES", "IGNORED_CURRENTS", "JUMPS", "MOTOR_HEAT", "INVERTER_HEAT",
    "DERATING",
)  # fmt: skip
INPUT_COUNT = len(INPUT_NAMES)


class Mode(IntEnum):
    """app_mode_t."""

    BOOT = 0
    CALIBRATE = 1
    READY = 2
    ALIGN = 3
    RUN = 4
    FAULT = 5
    PRECHARGE = 6
    STOP = 7
    COMMISSION = 8


MODE_WORDS = {
    Mode.BOOT: "starts up",
    Mode.CALIBRATE: "measures the zeros of its current sensors",
    Mode.READY: "ready, bridge off",
    Mode.ALIGN: "finds the rotor's angle: the shaft moves",
    Mode.RUN: "runs",
    Mode.FAULT: "FAULT",
    Mode.PRECHARGE: "charges the gate supplies",
    Mode.STOP: "brakes before the bridge opens",
    Mode.COMMISSION: "finds out what motor it has: the shaft moves",
}


@dataclass(frozen=True)
class Why:
    """The numbers that say why a drive is in FAULT; `fault` is 0 when it is not."""

    fault: int
    drive_fault: int
    board_faults: int


@dataclass(frozen=True)
class FirstFault:
    """What the drive kept of the tick of its last fault; also after a reset."""

    why: Why
    mode: int
    speed_e_radps: float
    wanted_e_radps: float
    time_s: float


@dataclass(frozen=True)
class Reading:
    """All input registers of one tick."""

    mode: int
    why: Why
    conditions: int
    speed_e_radps: float
    iq_A: float
    id_A: float
    iq_ref_A: float
    id_ref_A: float
    vq_V: float
    vd_V: float
    dc_link_V: float
    temperature_degC: float
    theta_e_rad: float
    time_s: float
    first_fault: FirstFault
    reset_cause: int
    phase_errors: int
    ignored_angles: int
    ignored_currents: int
    position_jumps: int
    motor_heat: float
    inverter_heat: float
    derating: float

    @property
    def mode_words(self) -> str:
        """The mode for a person."""
        return MODE_WORDS[Mode(self.mode)] if self.mode in set(Mode) else f"unknown mode {self.mode}"


def signed(value: int) -> int:
    """Two's complement of 16 bits."""
    return value - 0x10000 if value >= 0x8000 else value


def speed_register(speed_e_radps: float) -> int:
    """What to write for a speed; ValueError beyond 16 bits."""
    tenths = round(speed_e_radps / SPEED_PER_UNIT_E_RADPS)
    if not -0x8000 <= tenths <= 0x7FFF:
        raise ValueError(f"{speed_e_radps:g} rad/s electrical does not fit the register (+-3276.7)")
    return tenths & 0xFFFF


def decode(values: Sequence[int]) -> Reading:
    """A reading from all input registers."""
    if len(values) != INPUT_COUNT:
        raise ValueError(f"{len(values)} registers instead of {INPUT_COUNT}")
    raw = dict(zip(INPUT_NAMES, values))

    def tenths(name: str) -> float:
        return signed(raw[name]) / 10.0

    def milli(name: str) -> float:
        return signed(raw[name]) / 1000.0

    def seconds(name: str) -> float:
        return (raw[name + "_HI"] * 0x10000 + raw[name + "_LO"]) * TICK_S

    first = FirstFault(
        why=Why(raw["FIRST_FAULT"], raw["FIRST_DRIVE_FAULT"], raw["FIRST_BOARD_FAULTS"]),
        mode=raw["FIRST_MODE"],
        speed_e_radps=tenths("FIRST_SPEED"),
        wanted_e_radps=tenths("FIRST_WANTED"),
        time_s=seconds("FIRST_TICKS"),
    )
    return Reading(
        mode=raw["MODE"],
        why=Why(raw["FAULT"], raw["DRIVE_FAULT"], raw["BOARD_FAULTS"]),
        conditions=raw["CONDITIONS"],
        speed_e_radps=tenths("SPEED_NOW"),
        iq_A=milli("IQ"),
        id_A=milli("ID"),
        iq_ref_A=milli("IQ_REF"),
        id_ref_A=milli("ID_REF"),
        vq_V=tenths("VQ"),
        vd_V=tenths("VD"),
        dc_link_V=raw["DC_LINK"] / 10.0,
        temperature_degC=tenths("TEMPERATURE"),
        theta_e_rad=raw["THETA"] / 1000.0,
        time_s=seconds("TICKS"),
        first_fault=first,
        reset_cause=raw["RESET_CAUSE"],
        phase_errors=raw["PHASE_ERRORS"],
        ignored_angles=raw["IGNORED_ANGLES"],
        ignored_currents=raw["IGNORED_CURRENTS"],
        position_jumps=raw["JUMPS"],
        motor_heat=raw["MOTOR_HEAT"] / 1000.0,
        inverter_heat=raw["INVERTER_HEAT"] / 1000.0,
        derating=raw["DERATING"] / 1000.0,
    )
