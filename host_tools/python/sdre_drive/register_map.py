# SPDX-License-Identifier: MIT
"""Generated from firmware/app/registers/registers.toml. Do not edit: host_tools/registers/generate.py."""

from __future__ import annotations

from typing import NamedTuple, Optional, Tuple


class Register(NamedTuple):
    """One value: step is 0 for a whole number."""

    name: str
    address: int
    type: str
    step: float
    unit: str


class Parameter(NamedTuple):
    """A parameter that is kept over power: range in its unit. No default means the largest."""

    register: Register
    low: float
    high: float
    default: Optional[float]
    stopped: bool
    object: str
    text: str


DIGEST = "0e9a34fe"
VERSION = "1.0.0"

COMMAND: Tuple[Register, ...] = (  # holding
    Register("CONTROLWORD", 0, "u16", 0.0, "bits"),
    Register("MODE_OF_OPERATION", 1, "i16", 0.0, ""),
    Register("SPEED", 2, "i32", 0.1, "rad/s electrical"),
    Register("SPEED_RPM", 4, "i32", 0.1, "r/min"),
    Register("SPEED_RPM_16", 6, "i16", 1.0, "r/min"),
    Register("ACCELERATION", 7, "u32", 1.0, "rad/s2 electrical"),
    Register("DECELERATION", 9, "u32", 1.0, "rad/s2 electrical"),
    Register("QUICK_STOP_DECELERATION", 11, "u32", 1.0, "rad/s2 electrical"),
    Register("QUICK_STOP_OPTION", 13, "i16", 0.0, ""),
    Register("SHUTDOWN_OPTION", 14, "i16", 0.0, ""),
    Register("DISABLE_OPTION", 15, "i16", 0.0, ""),
    Register("LOST_OPTION", 16, "i16", 0.0, ""),
    Register("MAX_CURRENT", 17, "i32", 0.001, "A"),
    Register("SPEED_WINDOW", 19, "u16", 0.1, "rad/s electrical"),
    Register("COMMISSION_CURRENT", 20, "u16", 0.01, "A"),
    Register("COMMISSION_SPEED", 21, "u16", 0.1, "rad/s mechanical"),
    Register("INERTIA_START", 22, "u16", 0.0, "0.001"),
)

LINE: Tuple[Register, ...] = (  # holding
    Register("MODBUS_ADDRESS", 64, "u16", 0.0, ""),
    Register("MODBUS_TIMEOUT", 65, "u16", 0.001, "s"),
    Register("BAUD_RATE", 66, "u32", 0.0, "Bd"),
    Register("LINE_FORMAT", 68, "u16", 0.0, ""),
    Register("DIRECTION_PIN", 69, "u16", 0.0, ""),
)

SCOPE: Tuple[Register, ...] = (  # holding
    Register("SCOPE_COMMAND", 96, "u16", 0.0, ""),
    Register("SCOPE_SIGNAL_1", 97, "u16", 0.0, ""),
    Register("SCOPE_SIGNAL_2", 98, "u16", 0.0, ""),
    Register("SCOPE_SIGNAL_3", 99, "u16", 0.0, ""),
    Register("SCOPE_SIGNAL_4", 100, "u16", 0.0, ""),
    Register("SCOPE_DECIMATION", 101, "u16", 0.0, "control periods"),
    Register("SCOPE_TRIGGER", 102, "u16", 0.0, ""),
    Register("SCOPE_CHANNEL", 103, "u16", 0.0, ""),
    Register("SCOPE_LEVEL", 104, "i32", 0.001, "of its signal"),
    Register("SCOPE_BEFORE", 106, "u16", 0.0, "samples"),
)

STORE: Tuple[Register, ...] = (  # holding
    Register("STORE_PARAMETERS", 128, "u32", 0.0, ""),
    Register("RESTORE_PARAMETERS", 130, "u32", 0.0, ""),
    Register("ACCEPT_FALLBACK", 132, "u32", 0.0, ""),
)

TARGET: Tuple[Register, ...] = (  # holding
    Register("TARGET_POSITION", 160, "i32", 0.0, "position units"),
    Register("PROFILE_VELOCITY", 162, "u32", 0.1, "rad/s electrical"),
    Register("PROFILE_JERK", 164, "u32", 1.0, "rad/s3 electrical"),
    Register("POSITION_WINDOW", 166, "u16", 0.0, "position units"),
    Register("PROFILE_SPEED_MAX", 167, "u32", 0.1, "r/min"),
    Register("PROFILE_VELOCITY_RPM", 169, "u32", 0.1, "r/min"),
)

TRIM: Tuple[Register, ...] = (  # holding
    Register("SENSOR_TRIM", 192, "u16", 0.0, ""),
)

TORQUE: Tuple[Register, ...] = (  # holding
    Register("TORQUE", 224, "i16", 0.001, "of RATED_TORQUE"),
    Register("TORQUE_OFFSET", 225, "i16", 0.001, "of RATED_TORQUE"),
    Register("MAX_TORQUE", 226, "u16", 0.001, "of RATED_TORQUE"),
    Register("TORQUE_SLOPE", 227, "u32", 0.001, "of RATED_TORQUE per s"),
    Register("TORQUE_SPEED_MAX", 229, "u32", 1.0, "r/min"),
    Register("MAX_CURRENT_SHARE", 231, "u16", 0.001, "of RATED_CURRENT"),
)

CYCLIC: Tuple[Register, ...] = (  # holding
    Register("VELOCITY_OFFSET", 256, "i32", 0.1, "r/min"),
    Register("INTERPOLATION_PERIOD", 258, "u16", 0.001, "s"),
    Register("POSITION_OFFSET", 259, "i32", 0.0, "position units"),
    Register("FOLLOWING_WINDOW", 261, "u32", 0.0, "position units"),
    Register("FOLLOWING_TIMEOUT", 263, "u16", 0.001, "s"),
)

CAN: Tuple[Register, ...] = (  # holding
    Register("CAN_NODE", 288, "u16", 0.0, ""),
    Register("CAN_RATE", 289, "u16", 0.0, "kbit/s"),
)

UNITS: Tuple[Register, ...] = (  # holding
    Register("GEAR_MOTOR", 320, "u16", 0.0, "turns"),
    Register("GEAR_SHAFT", 321, "u16", 0.0, "turns"),
    Register("FEED", 322, "u32", 0.0, "position units"),
    Register("FEED_SHAFT", 324, "u16", 0.0, "turns"),
    Register("POLARITY", 325, "u16", 0.0, "bits"),
    Register("POSITION_LEAST", 326, "i32", 0.0, "position units"),
    Register("POSITION_MOST", 328, "i32", 0.0, "position units"),
)

HOMING: Tuple[Register, ...] = (  # holding
    Register("HOMING_METHOD", 352, "i16", 0.0, ""),
    Register("HOMING_SPEED_SWITCH", 353, "u32", 0.1, "r/min"),
    Register("HOMING_SPEED_ZERO", 355, "u32", 0.1, "r/min"),
    Register("HOMING_ACCELERATION", 357, "u32", 1.0, "rad/s2 electrical"),
    Register("HOME_OFFSET", 359, "i32", 0.0, "position units"),
    Register("HOMING_TIME", 361, "u16", 0.1, "s"),
    Register("INPUTS_USED", 362, "u16", 0.0, "bits"),
    Register("INPUTS_INVERTED", 363, "u16", 0.0, "bits"),
)

BRAKE: Tuple[Register, ...] = (  # holding
    Register("BRAKE_USED", 384, "u16", 0.0, ""),
    Register("BRAKE_RELEASE_TIME", 385, "u16", 0.0, "ms"),
    Register("BRAKE_CLOSE_TIME", 386, "u16", 0.0, "ms"),
)

LIVE: Tuple[Register, ...] = (  # input
    Register("STATUSWORD", 0, "u16", 0.0, "bits"),
    Register("MODE_NOW", 1, "i16", 0.0, ""),
    Register("ERROR_CODE", 2, "u16", 0.0, ""),
    Register("MODE", 3, "u16", 0.0, ""),
    Register("FAULT", 4, "u16", 0.0, ""),
    Register("DRIVE_FAULT", 5, "u16", 0.0, ""),
    Register("BOARD_FAULTS", 6, "u16", 0.0, "bits"),
    Register("CONDITIONS", 7, "u16", 0.0, "bits"),
    Register("REFERENCE", 8, "u16", 0.0, ""),
    Register("ALIGN_STAGE", 9, "u16", 0.0, ""),
    Register("SPEED_NOW", 10, "i32", 0.1, "rad/s electrical"),
    Register("SPEED_NOW_RPM", 12, "i32", 0.1, "r/min"),
    Register("SPEED_DEMAND_RPM", 14, "i32", 0.1, "r/min"),
    Register("IQ", 16, "i32", 0.001, "A"),
    Register("ID", 18, "i32", 0.001, "A"),
    Register("IQ_REF", 20, "i32", 0.001, "A"),
    Register("ID_REF", 22, "i32", 0.001, "A"),
    Register("VQ", 24, "i16", 0.1, "V"),
    Register("VD", 25, "i16", 0.1, "V"),
    Register("DC_LINK", 26, "u16", 0.1, "V"),
    Register("TEMPERATURE", 27, "i16", 0.1, "degC"),
    Register("THETA", 28, "u16", 0.001, "rad"),
    Register("POSITION", 29, "u16", 0.0, "counts"),
    Register("CORRECTIONS", 30, "u16", 0.0, ""),
    Register("ZERO_A", 31, "u16", 0.1, "codes"),
    Register("ZERO_B", 32, "u16", 0.1, "codes"),
    Register("CYCLES", 33, "u16", 0.0, "cycles"),
    Register("CYCLES_WORST", 34, "u16", 0.0, "cycles"),
    Register("TICKS", 35, "u32", 0.0, "control periods"),
    Register("RESET_CAUSE", 37, "u16", 0.0, ""),
    Register("PHASE_ERRORS", 38, "u16", 0.0, ""),
    Register("IGNORED_ANGLES", 39, "u16", 0.0, "samples"),
    Register("IGNORED_CURRENTS", 40, "u16", 0.0, "samples"),
    Register("JUMPS", 41, "u16", 0.0, ""),
    Register("MOTOR_HEAT", 42, "u16", 0.001, ""),
    Register("INVERTER_HEAT", 43, "u16", 0.001, ""),
    Register("DERATING", 44, "u16", 0.001, ""),
    Register("FIRST_FAULT", 45, "u16", 0.0, ""),
    Register("FIRST_MODE", 46, "u16", 0.0, ""),
    Register("FIRST_DRIVE_FAULT", 47, "u16", 0.0, ""),
    Register("FIRST_BOARD_FAULTS", 48, "u16", 0.0, "bits"),
    Register("FIRST_IA", 49, "u16", 0.0, "codes"),
    Register("FIRST_IB", 50, "u16", 0.0, "codes"),
    Register("FIRST_DC_LINK", 51, "u16", 0.0, "codes"),
    Register("FIRST_TEMPERATURE", 52, "u16", 0.0, "codes"),
    Register("FIRST_POSITION", 53, "u16", 0.0, "counts"),
    Register("FIRST_INDEX", 54, "u16", 0.0, "counts"),
    Register("FIRST_SAMPLE", 55, "u16", 0.0, "bits"),
    Register("FIRST_SPEED", 56, "i32", 0.1, "rad/s electrical"),
    Register("FIRST_WANTED", 58, "i32", 0.1, "rad/s electrical"),
    Register("FIRST_TICKS", 60, "u32", 0.0, "control periods"),
)

POSITION: Tuple[Register, ...] = (  # input
    Register("POSITION_NOW", 64, "i32", 0.0, "position units"),
    Register("POSITION_TARGET", 66, "i32", 0.0, "position units"),
    Register("DISC_MAP", 68, "u16", 0.0, ""),
    Register("HOMING_STAGE", 69, "u16", 0.0, ""),
    Register("HOMED", 70, "u16", 0.0, ""),
    Register("DIGITAL_INPUTS", 71, "u16", 0.0, "bits"),
)

SHAFT: Tuple[Register, ...] = (  # input
    Register("INERTIA_RATIO", 96, "u16", 0.001, ""),
    Register("INERTIA_CHANGES", 97, "u16", 0.0, ""),
    Register("RING_FREQUENCY", 98, "u16", 0.1, "Hz"),
    Register("INERTIA_BELIEVED", 99, "u16", 0.001, ""),
)

TRIMMED: Tuple[Register, ...] = (  # input
    Register("TRIM_A", 112, "i16", 0.001, "A"),
    Register("TRIM_B", 113, "i16", 0.001, "A"),
    Register("TRIM_GAIN", 114, "i16", 0.0001, ""),
    Register("TRIM_BLOCKS", 115, "u16", 0.0, ""),
)

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
    Register("FOUND_COUPLING", 172, "u16", 0.0, ""),
    Register("FOUND_SEARCHED", 173, "u16", 0.1, "Hz"),
    Register("FOUND_RESONANCE", 174, "dec", 0.0, "Hz"),
    Register("FOUND_RESONANCE_ERROR", 176, "dec", 0.0, "Hz"),
    Register("FOUND_DAMPING", 178, "dec", 0.0, ""),
    Register("FOUND_DAMPING_ERROR", 180, "dec", 0.0, ""),
    Register("FOUND_LOAD_SHARE", 182, "dec", 0.0, ""),
    Register("FOUND_LOAD_SHARE_ERROR", 184, "dec", 0.0, ""),
)

TRACES: Tuple[Register, ...] = (  # input
    Register("SCOPE_STATE", 192, "u16", 0.0, ""),
    Register("SCOPE_TICKS", 193, "u32", 0.0, "control periods"),
    Register("RECORD_NUMBER", 195, "u16", 0.0, ""),
    Register("RECORD_COUNT", 196, "u16", 0.0, "samples"),
)

STORED: Tuple[Register, ...] = (  # input
    Register("PARAMETERS_STATE", 224, "u16", 0.0, ""),
    Register("PARAMETERS_DONE", 225, "u16", 0.0, ""),
    Register("PARAMETERS_NUMBER", 226, "u32", 0.0, ""),
    Register("PARAMETERS_WRITES", 228, "u32", 0.0, ""),
    Register("PARAMETERS_DROPPED", 230, "u16", 0.0, ""),
)

CONSTANTS: Tuple[Register, ...] = (  # input
    Register("SUPPORTED_MODES", 256, "u32", 0.0, "bits"),
    Register("POLE_PAIRS", 258, "u16", 0.0, ""),
    Register("ENCODER_POSITIONS", 259, "u32", 0.0, "counts"),
    Register("CONTROL_PERIOD", 261, "u32", 1e-09, "s"),
    Register("SPEED_MAX", 263, "i32", 0.1, "rad/s electrical"),
    Register("SPEED_MAX_RPM", 265, "i32", 0.1, "r/min"),
    Register("SPEED_TRIP", 267, "i32", 0.1, "rad/s electrical"),
    Register("CURRENT_MAX", 269, "i32", 0.001, "A"),
    Register("CURRENT_TRIP", 271, "i32", 0.001, "A"),
    Register("DC_LINK_MIN", 273, "u16", 0.1, "V"),
    Register("DC_LINK_MAX", 274, "u16", 0.1, "V"),
    Register("TEMPERATURE_LIMIT", 275, "i16", 0.1, "degC"),
    Register("TEMPERATURE_TRIP", 276, "i16", 0.1, "degC"),
    Register("TURN_UNITS", 277, "u32", 0.001, "position units"),
)

MAP: Tuple[Register, ...] = (  # input
    Register("FOUND_MAP_STEP", 288, "dec", 0.0, "A"),
    Register("FOUND_MAP_BIAS", 290, "dec", 0.0, "A"),
    Register("FOUND_LD_POSITIVE_1", 292, "u16", 0.0001, ""),
    Register("FOUND_LD_POSITIVE_2", 293, "u16", 0.0001, ""),
    Register("FOUND_LD_POSITIVE_3", 294, "u16", 0.0001, ""),
    Register("FOUND_LD_POSITIVE_4", 295, "u16", 0.0001, ""),
    Register("FOUND_LD_NEGATIVE_1", 296, "u16", 0.0001, ""),
    Register("FOUND_LD_NEGATIVE_2", 297, "u16", 0.0001, ""),
    Register("FOUND_LD_NEGATIVE_3", 298, "u16", 0.0001, ""),
    Register("FOUND_LD_NEGATIVE_4", 299, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_0_1", 300, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_0_2", 301, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_0_3", 302, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_0_4", 303, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_1_1", 304, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_1_2", 305, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_1_3", 306, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_1_4", 307, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_2_1", 308, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_2_2", 309, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_2_3", 310, "u16", 0.0001, ""),
    Register("FOUND_LQ_BESIDE_2_4", 311, "u16", 0.0001, ""),
)

TORQUE_NOW: Tuple[Register, ...] = (  # input
    Register("TORQUE_NOW", 320, "i16", 0.001, "of RATED_TORQUE"),
    Register("TORQUE_DEMAND", 321, "i16", 0.001, "of RATED_TORQUE"),
    Register("RATED_CURRENT", 322, "u32", 0.001, "A"),
    Register("RATED_TORQUE", 324, "u32", 0.001, "N m"),
)

CHOPPER_NOW: Tuple[Register, ...] = (  # input
    Register("CHOPPER_STATE", 416, "u16", 0.0, ""),
    Register("CHOPPER_HEAT", 417, "u16", 0.001, ""),
    Register("CHOPPER_ON", 418, "u16", 0.1, "V"),
    Register("CHOPPER_OFF", 419, "u16", 0.1, "V"),
)

BRAKE_NOW: Tuple[Register, ...] = (  # input
    Register("BRAKE_STATE", 448, "u16", 0.0, ""),
    Register("DIGITAL_OUTPUTS", 449, "u16", 0.0, "bits"),
)

HOLDING = (*COMMAND, *LINE, *SCOPE, *STORE, *TARGET, *TRIM, *TORQUE, *CYCLIC, *CAN, *UNITS, *HOMING, *BRAKE)
INPUT = (*LIVE, *POSITION, *SHAFT, *TRIMMED, *COMMISSIONING, *TRACES, *STORED, *CONSTANTS, *MAP, *TORQUE_NOW, *CHOPPER_NOW, *BRAKE_NOW)

# Blocks that hold parameters.
PARAMETER_BLOCKS = (COMMAND, LINE, TARGET, TRIM, TORQUE, CYCLIC, CAN, UNITS, HOMING, BRAKE,)

BY_NAME = {r.name: r for r in (*HOLDING, *INPUT)}

PARAMETERS: Tuple[Parameter, ...] = (
    Parameter(BY_NAME["ACCELERATION"], 0, 1000000.0, 0.0, False, "6083h", "away from zero speed; 0: the drive's limit"),
    Parameter(BY_NAME["DECELERATION"], 0, 1000000.0, 0.0, False, "6084h", "towards zero speed; 0: the drive's limit"),
    Parameter(BY_NAME["QUICK_STOP_DECELERATION"], 0, 1000000.0, 0.0, False, "6085h", "of a quick stop; 0: the drive's limit"),
    Parameter(BY_NAME["QUICK_STOP_OPTION"], 0, 6, 2.0, False, "605Ah", "0, 1, 2, 5 or 6. 0 acts as disable voltage. 1 stops with DECELERATION, 2 with QUICK_STOP_DECELERATION; both then go to SWITCH ON DISABLED. 5 and 6 stop in the same ways and stay enabled at zero speed."),
    Parameter(BY_NAME["SHUTDOWN_OPTION"], 0, 1, 0.0, False, "605Bh", "0: `stop` of the drive file; 1: with DECELERATION"),
    Parameter(BY_NAME["DISABLE_OPTION"], 0, 1, 0.0, False, "605Ch", "the same for disable operation"),
    Parameter(BY_NAME["LOST_OPTION"], 2, 3, 2.0, False, "6007h", "2 disable voltage, 3 quick stop. It acts when no request arrives for MODBUS_TIMEOUT."),
    Parameter(BY_NAME["MAX_CURRENT"], 0, 1000000.0, None, False, "", "limit of the current vector. It acts up to CURRENT_MAX. Below that the drive cannot detect a stall. Only laws with near_optimal.h use it, such as the shipped one."),
    Parameter(BY_NAME["SPEED_WINDOW"], 0, 6553.5, 5.0, False, "606Dh", "around the command: target reached"),
    Parameter(BY_NAME["INERTIA_START"], 0, 5000, 0.0, False, "", "inertia over the drive's at the start; 0: not used. With 0 the law keeps the inertia of the drive file. With any other value it begins with that ratio, and then uses what changes of speed teach (INERTIA_RATIO): [Inertia](tuning.md#inertia). Below 500 it is 500. Only law noc has it."),
    Parameter(BY_NAME["MODBUS_ADDRESS"], 1, 247, 1.0, False, "", "of the drive. The answer to the write still has the old address."),
    Parameter(BY_NAME["MODBUS_TIMEOUT"], 0.01, 60.0, 0.5, False, "", "without a request for longer: LOST_OPTION"),
    Parameter(BY_NAME["BAUD_RATE"], 9600, 115200, 115200.0, True, "", "acts when stored. Allowed are 9600, 19200, 38400, 57600 and 115200. Baud rate, LINE_FORMAT and DIRECTION_PIN act with the restart that stores them."),
    Parameter(BY_NAME["LINE_FORMAT"], 0, 2, 0.0, True, "", "0 even, 1 odd, 2 no parity. Even and odd parity have one stop bit; no parity has two."),
    Parameter(BY_NAME["DIRECTION_PIN"], 0, 1, 0.0, True, "", "1: pin high while the drive sends. It is for an RS-485 transceiver."),
    Parameter(BY_NAME["PROFILE_VELOCITY"], 0, 1000000.0, 0.0, False, "", "largest profile speed; 0: the drive's limit. ACCELERATION and DECELERATION act too."),
    Parameter(BY_NAME["PROFILE_JERK"], 0, 4000000000.0, 0.0, False, "60A4h", "0: the drive's limit"),
    Parameter(BY_NAME["POSITION_WINDOW"], 1, 65535, 4.0, False, "6067h", "around the target: reached"),
    Parameter(BY_NAME["PROFILE_SPEED_MAX"], 0, 10000000.0, 0.0, False, "607Fh", "limit of SPEED, PROFILE_VELOCITY and TORQUE_SPEED_MAX; 0: SPEED_MAX. SPEED is cut to it, with bit 11 of the status word. A set-point of a position keeps the limit of the time when it was taken."),
    Parameter(BY_NAME["SENSOR_TRIM"], 0, 1, 1.0, False, "", "1: learns errors of the current sensors in a run. 0 forgets what was learned: [Current sensors](hardware.md#trim-of-the-current-sensors). The image of noc_h has no room for it: there it is 0."),
    Parameter(BY_NAME["MAX_TORQUE"], 0, 33, 33.0, False, "6072h", "limit of their sum, either way. MAX_CURRENT, heat, the voltage and the speed limit act too."),
    Parameter(BY_NAME["TORQUE_SLOPE"], 0, 1000000.0, 0.0, False, "6087h", "profile torque; 0: a step"),
    Parameter(BY_NAME["INTERPOLATION_PERIOD"], 0.001, 0.1, 0.01, False, "60C2h", "between two set-points"),
    Parameter(BY_NAME["FOLLOWING_WINDOW"], 0, 1000000000, 0.0, False, "6065h", "cyclic position: largest following error; 0: any"),
    Parameter(BY_NAME["FOLLOWING_TIMEOUT"], 0, 65.535, 0.1, False, "6066h", "beyond the window for longer: fault 16"),
    Parameter(BY_NAME["CAN_NODE"], 1, 127, 1.0, False, "", "node number. It and CAN_RATE act after a restart, or after the NMT command \"reset communication\"."),
    Parameter(BY_NAME["CAN_RATE"], 125, 1000, 500.0, False, "", "125, 250, 500 or 1000"),
    Parameter(BY_NAME["GEAR_MOTOR"], 1, 65535, 1.0, True, "6091h", "motor turns per GEAR_SHAFT turns"),
    Parameter(BY_NAME["GEAR_SHAFT"], 1, 65535, 1.0, True, "6091h", "of the shaft behind the gear"),
    Parameter(BY_NAME["FEED"], 0, 1000000000, 0.0, True, "6092h", "units per FEED_SHAFT turns; 0: counts. Position units are what positions, their windows and limits count: [Position units](#position-units)."),
    Parameter(BY_NAME["FEED_SHAFT"], 1, 65535, 1.0, True, "6092h", "of the shaft behind the gear"),
    Parameter(BY_NAME["POLARITY"], 0, 255, 0.0, True, "607Eh", "128 position, 64 speed, 32 torque: other sense. 224 turns the whole drive round. Other bits are refused."),
    Parameter(BY_NAME["POSITION_LEAST"], -2147483647, 2147483647, 0.0, False, "607Dh", "limit of target positions. Both limits act when POSITION_LEAST is below POSITION_MOST. A target beyond them becomes the limit, and bit 11 of the status word is set."),
    Parameter(BY_NAME["POSITION_MOST"], -2147483647, 2147483647, 0.0, False, "607Dh", "the same in the other direction"),
    Parameter(BY_NAME["HOMING_METHOD"], 1, 37, 37.0, False, "6098h", "1 to 14, 17 to 30, 33, 34, 35, 37. [Homing](#homing) describes them."),
    Parameter(BY_NAME["HOMING_SPEED_SWITCH"], 0, 10000000.0, 60.0, False, "6099h", "of the motor, towards a switch"),
    Parameter(BY_NAME["HOMING_SPEED_ZERO"], 0, 10000000.0, 6.0, False, "6099h", "of the motor, over its edge or the mark"),
    Parameter(BY_NAME["HOMING_ACCELERATION"], 0, 1000000.0, 0.0, False, "609Ah", "of all its speeds; 0: the drive's limit"),
    Parameter(BY_NAME["HOME_OFFSET"], -2147483647, 2147483647, 0.0, False, "607Ch", "from home to the zero of positions. So home has the position -HOME_OFFSET. It acts with the next homing."),
    Parameter(BY_NAME["HOMING_TIME"], 0.1, 6000, 60.0, False, "", "after it homing has failed"),
    Parameter(BY_NAME["INPUTS_USED"], 0, 7, 0.0, False, "", "1 negative, 2 positive limit switch, 4 home switch. An input that is not used is never active."),
    Parameter(BY_NAME["INPUTS_INVERTED"], 0, 7, 0.0, False, "", "0: high or open is active, 1: low. With 0 a contact that opens is active, and so is a broken wire."),
    Parameter(BY_NAME["BRAKE_USED"], 0, 1, 0.0, True, "", "1: a holding brake at its output. [Holding brake](#holding-brake) describes it."),
    Parameter(BY_NAME["BRAKE_RELEASE_TIME"], 0, 5000, 100.0, False, "", "from the output to the open brake. Set-points act after it."),
    Parameter(BY_NAME["BRAKE_CLOSE_TIME"], 0, 5000, 100.0, False, "", "from the output to the closed brake. The bridge goes off after it."),
)

# Signals of the scope by number: name and unit.
SIGNALS = (
    ("NONE", ""),
    ("SPEED", "rad/s electrical"),
    ("SPEED_MEASURED", "rad/s electrical"),
    ("SPEED_WANTED", "rad/s electrical"),
    ("IQ", "A"),
    ("ID", "A"),
    ("IQ_REF", "A"),
    ("ID_REF", "A"),
    ("VQ", "V"),
    ("VD", "V"),
    ("IA", "A"),
    ("IB", "A"),
    ("DC_LINK", "V"),
    ("THETA", "rad"),
    ("DUTY_A", ""),
    ("DUTY_B", ""),
    ("DUTY_C", ""),
    ("LOAD", "rad/s2 electrical"),
    ("MODE", ""),
    ("EDGE", ""),
    ("CHOPPER", ""),
)
