# SPDX-License-Identifier: MIT
"""The registers of docs/modbus.md as SI values. Needs nothing but the standard library."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Dict, Iterable, List, Sequence, Tuple

from sdre_drive import register_map
from sdre_drive.register_map import Register

WORDS = {"u16": 1, "i16": 1, "u32": 2, "i32": 2, "dec": 2}
RANGES = {
    "u16": (0, 0xFFFF),
    "i16": (-0x8000, 0x7FFF),
    "u32": (0, 0xFFFFFFFF),
    "i32": (-0x80000000, 0x7FFFFFFF),
}
BY_NAME = register_map.BY_NAME


def block(registers: Sequence[Register]) -> Tuple[int, int]:
    """First address and how many, of registers without a gap."""
    last = registers[-1]
    return registers[0].address, last.address + WORDS[last.type] - registers[0].address


def signed(value: int, bits: int = 16) -> int:
    """Two's complement."""
    return value - (1 << bits) if value >= 1 << (bits - 1) else value


def value_of(r: Register, words: Sequence[int]) -> float:
    """In SI units; of two registers the high one comes first."""
    if r.type == "dec":
        return signed(words[0]) * 10.0 ** signed(words[1])
    count = words[0] if len(words) == 1 else words[0] << 16 | words[1]
    if r.type.startswith("i"):
        count = signed(count, 16 * len(words))
    return count * r.step if r.step else count


def words_of(r: Register, value: float) -> List[int]:
    """Words of a value; ValueError beyond the register."""
    count = round(value / r.step) if r.step else round(value)
    low, high = RANGES[r.type]
    if not low <= count <= high:
        raise ValueError(f"{value:g} {r.unit} does not fit register {r.name}")
    return [count & 0xFFFF] if WORDS[r.type] == 1 else [count >> 16 & 0xFFFF, count & 0xFFFF]


def values(registers: Iterable[Register], words: Sequence[int]) -> Dict[str, float]:
    """Values by name, of a block that was read as a whole."""
    out: Dict[str, float] = {}
    at = 0
    for r in registers:
        out[r.name] = value_of(r, words[at : at + WORDS[r.type]])
        at += WORDS[r.type]
    if at != len(words):
        raise ValueError(f"{len(words)} registers instead of {at}")
    return out


ANGLE_KNOWN = 1 << 15  # of the status word: with it the zero of positions
PROFILE_POSITION, PROFILE_VELOCITY, PROFILE_TORQUE = 1, 3, 4  # modes of operation
CYCLIC_POSITION, CYCLIC_VELOCITY, CYCLIC_TORQUE = 8, 9, 10
# In these the law has the bridge.
RUNS = (
    PROFILE_POSITION,
    PROFILE_VELOCITY,
    PROFILE_TORQUE,
    CYCLIC_POSITION,
    CYCLIC_VELOCITY,
    CYCLIC_TORQUE,
)


class ControlWord(IntEnum):
    """Control words of CiA 402, object 6040h."""

    DISABLE_VOLTAGE = 0
    QUICK_STOP = 2
    SHUT_DOWN = 6
    SWITCH_ON = 7
    ENABLE = 15
    FAULT_RESET = 128


# Bits of the status word (6041h) and their values in each state.
STATES = (
    (0x4F, 0x00, "not ready to switch on"),
    (0x4F, 0x40, "switch on disabled"),
    (0x6F, 0x21, "ready to switch on"),
    (0x6F, 0x23, "switched on"),
    (0x6F, 0x27, "operation enabled"),
    (0x6F, 0x07, "quick stop active"),
    (0x4F, 0x0F, "fault reaction active"),
    (0x4F, 0x08, "fault"),
)


def state_words(statusword: int) -> str:
    """The state of CiA 402."""
    return next((words for mask, bits, words in STATES if statusword & mask == bits), "unknown")


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


RESET_WORDS = (
    "power on, or the reset pin",
    "its watchdog: the program before hung, or was asked to restart",
)
STORED_WORDS = (  # register PARAMETERS_STATE
    "defaults: nothing is stored",
    "as stored",
    "DEFAULTS: what is stored has another format",
    "DEFAULTS: a stored value is out of its range",
    "RECORD_LOST: what was stored last is lost",
    "as stored",
)
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
    """Record of the tick of the last fault; it stays after a reset."""

    why: Why
    mode: int
    speed_e_radps: float
    wanted_e_radps: float
    time_s: float


@dataclass(frozen=True)
class Reading:
    """The live registers of one tick."""

    statusword: int
    mode_of_operation: int
    error_code: int
    mode: int
    why: Why
    conditions: int
    speed_e_radps: float
    speed_demand_rpm: float
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
    def reset_words(self) -> str:
        """The cause of the last start."""
        known = self.reset_cause < len(RESET_WORDS)
        return RESET_WORDS[self.reset_cause] if known else f"unknown cause {self.reset_cause}"

    @property
    def mode_words(self) -> str:
        """The mode in words."""
        return (
            MODE_WORDS[Mode(self.mode)] if self.mode in set(Mode) else f"unknown mode {self.mode}"
        )


@dataclass(frozen=True)
class Constants:
    """Constants of the firmware."""

    pole_pairs: int
    period_s: float
    speed_max_e_radps: float
    current_max_A: float
    encoder_counts: int  # of a turn
    turn_units: float  # position units in a turn of the motor
    supported_modes: int  # bits of CiA 402


def constants(words: Sequence[int]) -> Constants:
    """From the block of constants."""
    raw = values(register_map.CONSTANTS, words)
    return Constants(
        int(raw["POLE_PAIRS"]),
        raw["CONTROL_PERIOD"],
        raw["SPEED_MAX"],
        raw["CURRENT_MAX"],
        int(raw["ENCODER_POSITIONS"]),
        raw["TURN_UNITS"],
        int(raw["SUPPORTED_MODES"]),
    )


def decode(words: Sequence[int], period_s: float) -> Reading:
    """A reading from the live registers."""
    raw = values(register_map.LIVE, words)

    def whole(name: str) -> int:
        return int(raw[name])

    first = FirstFault(
        why=Why(whole("FIRST_FAULT"), whole("FIRST_DRIVE_FAULT"), whole("FIRST_BOARD_FAULTS")),
        mode=whole("FIRST_MODE"),
        speed_e_radps=raw["FIRST_SPEED"],
        wanted_e_radps=raw["FIRST_WANTED"],
        time_s=raw["FIRST_TICKS"] * period_s,
    )
    return Reading(
        statusword=whole("STATUSWORD"),
        mode_of_operation=whole("MODE_NOW"),
        error_code=whole("ERROR_CODE"),
        mode=whole("MODE"),
        why=Why(whole("FAULT"), whole("DRIVE_FAULT"), whole("BOARD_FAULTS")),
        conditions=whole("CONDITIONS"),
        speed_e_radps=raw["SPEED_NOW"],
        speed_demand_rpm=raw["SPEED_DEMAND_RPM"],
        iq_A=raw["IQ"],
        id_A=raw["ID"],
        iq_ref_A=raw["IQ_REF"],
        id_ref_A=raw["ID_REF"],
        vq_V=raw["VQ"],
        vd_V=raw["VD"],
        dc_link_V=raw["DC_LINK"],
        temperature_degC=raw["TEMPERATURE"],
        theta_e_rad=raw["THETA"],
        time_s=raw["TICKS"] * period_s,
        first_fault=first,
        reset_cause=whole("RESET_CAUSE"),
        phase_errors=whole("PHASE_ERRORS"),
        ignored_angles=whole("IGNORED_ANGLES"),
        ignored_currents=whole("IGNORED_CURRENTS"),
        position_jumps=whole("JUMPS"),
        motor_heat=raw["MOTOR_HEAT"],
        inverter_heat=raw["INVERTER_HEAT"],
        derating=raw["DERATING"],
    )
