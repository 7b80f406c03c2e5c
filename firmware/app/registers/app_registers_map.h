/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
/**
 * @file app_registers_map.h
 * @brief Addresses and kinds of the registers, and where their values come from.
 * docs/modbus.md says what they mean.
 */
#ifndef APP_REGISTERS_MAP_H
#define APP_REGISTERS_MAP_H

#include "base.h"

#define APP_REGISTERS_VERSION "1.0.0"   /**< of the firmware */
#define APP_REGISTERS_DIGEST "df8bc9b4" /**< of what a master can see of the map */

#define APP_REGISTERS_SAVED 17U /**< parameters */

/** Holding registers: those of two words are named by the first. */
enum {
    APP_REGISTERS_CONTROLWORD = 0,
    APP_REGISTERS_MODE_OF_OPERATION = 1,
    APP_REGISTERS_SPEED = 2,
    APP_REGISTERS_SPEED_RPM = 4,
    APP_REGISTERS_SPEED_RPM_16 = 6,
    APP_REGISTERS_ACCELERATION = 7,
    APP_REGISTERS_DECELERATION = 9,
    APP_REGISTERS_QUICK_STOP_DECELERATION = 11,
    APP_REGISTERS_QUICK_STOP_OPTION = 13,
    APP_REGISTERS_SHUTDOWN_OPTION = 14,
    APP_REGISTERS_DISABLE_OPTION = 15,
    APP_REGISTERS_LOST_OPTION = 16,
    APP_REGISTERS_MAX_CURRENT = 17,
    APP_REGISTERS_SPEED_WINDOW = 19,
    APP_REGISTERS_COMMISSION_CURRENT = 20,
    APP_REGISTERS_COMMISSION_SPEED = 21,
    APP_REGISTERS_COMMAND_FIRST = 0,
    APP_REGISTERS_COMMAND_END = 22,
    APP_REGISTERS_MODBUS_ADDRESS = 64,
    APP_REGISTERS_MODBUS_TIMEOUT = 65,
    APP_REGISTERS_BAUD_RATE = 66,
    APP_REGISTERS_LINE_FORMAT = 68,
    APP_REGISTERS_DIRECTION_PIN = 69,
    APP_REGISTERS_LINE_FIRST = 64,
    APP_REGISTERS_LINE_END = 70,
    APP_REGISTERS_SCOPE_COMMAND = 96,
    APP_REGISTERS_SCOPE_SIGNAL_1 = 97,
    APP_REGISTERS_SCOPE_SIGNAL_2 = 98,
    APP_REGISTERS_SCOPE_SIGNAL_3 = 99,
    APP_REGISTERS_SCOPE_SIGNAL_4 = 100,
    APP_REGISTERS_SCOPE_DECIMATION = 101,
    APP_REGISTERS_SCOPE_TRIGGER = 102,
    APP_REGISTERS_SCOPE_CHANNEL = 103,
    APP_REGISTERS_SCOPE_LEVEL = 104,
    APP_REGISTERS_SCOPE_BEFORE = 106,
    APP_REGISTERS_SCOPE_FIRST = 96,
    APP_REGISTERS_SCOPE_END = 107,
    APP_REGISTERS_STORE_PARAMETERS = 128,
    APP_REGISTERS_RESTORE_PARAMETERS = 130,
    APP_REGISTERS_ACCEPT_FALLBACK = 132,
    APP_REGISTERS_STORE_FIRST = 128,
    APP_REGISTERS_STORE_END = 134,
    APP_REGISTERS_TARGET_POSITION = 160,
    APP_REGISTERS_PROFILE_VELOCITY = 162,
    APP_REGISTERS_PROFILE_JERK = 164,
    APP_REGISTERS_POSITION_WINDOW = 166,
    APP_REGISTERS_TARGET_FIRST = 160,
    APP_REGISTERS_TARGET_END = 167
};

/** Input registers: those of two words are named by the first. */
enum {
    APP_REGISTERS_STATUSWORD = 0,
    APP_REGISTERS_MODE_NOW = 1,
    APP_REGISTERS_ERROR_CODE = 2,
    APP_REGISTERS_MODE = 3,
    APP_REGISTERS_FAULT = 4,
    APP_REGISTERS_DRIVE_FAULT = 5,
    APP_REGISTERS_BOARD_FAULTS = 6,
    APP_REGISTERS_CONDITIONS = 7,
    APP_REGISTERS_REFERENCE = 8,
    APP_REGISTERS_ALIGN_STAGE = 9,
    APP_REGISTERS_SPEED_NOW = 10,
    APP_REGISTERS_SPEED_NOW_RPM = 12,
    APP_REGISTERS_SPEED_DEMAND_RPM = 14,
    APP_REGISTERS_IQ = 16,
    APP_REGISTERS_ID = 18,
    APP_REGISTERS_IQ_REF = 20,
    APP_REGISTERS_ID_REF = 22,
    APP_REGISTERS_VQ = 24,
    APP_REGISTERS_VD = 25,
    APP_REGISTERS_DC_LINK = 26,
    APP_REGISTERS_TEMPERATURE = 27,
    APP_REGISTERS_THETA = 28,
    APP_REGISTERS_POSITION = 29,
    APP_REGISTERS_CORRECTIONS = 30,
    APP_REGISTERS_ZERO_A = 31,
    APP_REGISTERS_ZERO_B = 32,
    APP_REGISTERS_CYCLES = 33,
    APP_REGISTERS_CYCLES_WORST = 34,
    APP_REGISTERS_TICKS = 35,
    APP_REGISTERS_RESET_CAUSE = 37,
    APP_REGISTERS_PHASE_ERRORS = 38,
    APP_REGISTERS_IGNORED_ANGLES = 39,
    APP_REGISTERS_IGNORED_CURRENTS = 40,
    APP_REGISTERS_JUMPS = 41,
    APP_REGISTERS_MOTOR_HEAT = 42,
    APP_REGISTERS_INVERTER_HEAT = 43,
    APP_REGISTERS_DERATING = 44,
    APP_REGISTERS_FIRST_FAULT = 45,
    APP_REGISTERS_FIRST_MODE = 46,
    APP_REGISTERS_FIRST_DRIVE_FAULT = 47,
    APP_REGISTERS_FIRST_BOARD_FAULTS = 48,
    APP_REGISTERS_FIRST_IA = 49,
    APP_REGISTERS_FIRST_IB = 50,
    APP_REGISTERS_FIRST_DC_LINK = 51,
    APP_REGISTERS_FIRST_TEMPERATURE = 52,
    APP_REGISTERS_FIRST_POSITION = 53,
    APP_REGISTERS_FIRST_INDEX = 54,
    APP_REGISTERS_FIRST_SAMPLE = 55,
    APP_REGISTERS_FIRST_SPEED = 56,
    APP_REGISTERS_FIRST_WANTED = 58,
    APP_REGISTERS_FIRST_TICKS = 60,
    APP_REGISTERS_LIVE_FIRST = 0,
    APP_REGISTERS_LIVE_END = 62,
    APP_REGISTERS_POSITION_NOW = 64,
    APP_REGISTERS_POSITION_TARGET = 66,
    APP_REGISTERS_POSITION_FIRST = 64,
    APP_REGISTERS_POSITION_END = 68,
    APP_REGISTERS_INERTIA_RATIO = 96,
    APP_REGISTERS_INERTIA_CHANGES = 97,
    APP_REGISTERS_SHAFT_FIRST = 96,
    APP_REGISTERS_SHAFT_END = 98,
    APP_REGISTERS_COMMISSION_STAGE = 128,
    APP_REGISTERS_COMMISSION_REASON = 129,
    APP_REGISTERS_COMMISSION_PERCENT = 130,
    APP_REGISTERS_FOUND_DIRECTION = 131,
    APP_REGISTERS_FOUND_POLE_PAIRS = 132,
    APP_REGISTERS_FOUND_COUNTS = 133,
    APP_REGISTERS_FOUND_RELUCTANCE = 135,
    APP_REGISTERS_FOUND_R = 136,
    APP_REGISTERS_FOUND_R_ERROR = 138,
    APP_REGISTERS_FOUND_V_LOSS = 140,
    APP_REGISTERS_FOUND_V_LOSS_ERROR = 142,
    APP_REGISTERS_FOUND_LD = 144,
    APP_REGISTERS_FOUND_LD_ERROR = 146,
    APP_REGISTERS_FOUND_LQ = 148,
    APP_REGISTERS_FOUND_LQ_ERROR = 150,
    APP_REGISTERS_FOUND_FLUX = 152,
    APP_REGISTERS_FOUND_FLUX_ERROR = 154,
    APP_REGISTERS_FOUND_INERTIA = 156,
    APP_REGISTERS_FOUND_INERTIA_ERROR = 158,
    APP_REGISTERS_FOUND_FRICTION = 160,
    APP_REGISTERS_FOUND_FRICTION_ERROR = 162,
    APP_REGISTERS_FOUND_COULOMB = 164,
    APP_REGISTERS_FOUND_COULOMB_ERROR = 166,
    APP_REGISTERS_FOUND_OFFSET = 168,
    APP_REGISTERS_FOUND_OFFSET_ERROR = 170,
    APP_REGISTERS_COMMISSIONING_FIRST = 128,
    APP_REGISTERS_COMMISSIONING_END = 172,
    APP_REGISTERS_SCOPE_STATE = 192,
    APP_REGISTERS_SCOPE_TICKS = 193,
    APP_REGISTERS_RECORD_NUMBER = 195,
    APP_REGISTERS_RECORD_COUNT = 196,
    APP_REGISTERS_TRACES_FIRST = 192,
    APP_REGISTERS_TRACES_END = 197,
    APP_REGISTERS_PARAMETERS_STATE = 224,
    APP_REGISTERS_PARAMETERS_DONE = 225,
    APP_REGISTERS_PARAMETERS_NUMBER = 226,
    APP_REGISTERS_PARAMETERS_WRITES = 228,
    APP_REGISTERS_PARAMETERS_DROPPED = 230,
    APP_REGISTERS_STORED_FIRST = 224,
    APP_REGISTERS_STORED_END = 231,
    APP_REGISTERS_SUPPORTED_MODES = 256,
    APP_REGISTERS_POLE_PAIRS = 258,
    APP_REGISTERS_ENCODER_POSITIONS = 259,
    APP_REGISTERS_CONTROL_PERIOD = 261,
    APP_REGISTERS_SPEED_MAX = 263,
    APP_REGISTERS_SPEED_MAX_RPM = 265,
    APP_REGISTERS_SPEED_TRIP = 267,
    APP_REGISTERS_CURRENT_MAX = 269,
    APP_REGISTERS_CURRENT_TRIP = 271,
    APP_REGISTERS_DC_LINK_MIN = 273,
    APP_REGISTERS_DC_LINK_MAX = 274,
    APP_REGISTERS_TEMPERATURE_LIMIT = 275,
    APP_REGISTERS_TEMPERATURE_TRIP = 276,
    APP_REGISTERS_CONSTANTS_FIRST = 256,
    APP_REGISTERS_CONSTANTS_END = 277
};

typedef enum {
    APP_REGISTERS_U16 = 0,
    APP_REGISTERS_I16,
    APP_REGISTERS_U32, /**< two words, the high one first, as the next */
    APP_REGISTERS_I32,
    APP_REGISTERS_DEC /**< two words: digits and power of ten, both signed */
} app_registers_type_t;

/** Where a value is. */
typedef enum {
    APP_REGISTERS_COMPUTED = 0, /**< app_registers_map_real() and its kin */
    APP_REGISTERS_REQUESTED, /**< a member of the app_registers_request_t */
    APP_REGISTERS_STATUS, /**< of the app_status_t */
    APP_REGISTERS_DRIVE,  /**< of the drive_config_t */
    APP_REGISTERS_CONFIG  /**< of the app_config_t */
} app_registers_home_t;

/** Type of that member. */
typedef enum {
    APP_REGISTERS_AS_U16 = 0,
    APP_REGISTERS_AS_I16,
    APP_REGISTERS_AS_U32,
    APP_REGISTERS_AS_I32,
    APP_REGISTERS_AS_FLOAT,
    APP_REGISTERS_AS_BOOL,
    APP_REGISTERS_AS_CHAR, /**< an enumeration of this size */
    APP_REGISTERS_AS_INT
} app_registers_kind_t;

typedef struct {
    uint16_t             address; /**< of the first word */
    app_registers_type_t type;
    float                per_unit; /**< counts of one SI unit; 0: a whole number */
    float                least;    /**< what a write may bring, in SI units */
    float                most;
    bool                 stopped;   /**< written while the bridge is off only */
    uint16_t             saved;     /**< digest of a parameter; 0: it is none */
    uint32_t             signature; /**< the one value that is taken; 0: no such thing */
    app_registers_home_t home;
    app_registers_kind_t kind;
    uint16_t             offset; /**< of the member; of a computed value its number */
    bool                 rpm;    /**< the member is electrical rad/s */
} app_registers_entry_t;

struct app_registers;
struct app_registers_request;

#define APP_REGISTERS_MAP_HOLDING 38U

#define APP_REGISTERS_MAP_INPUT 102U

/** Rows in ascending order of the address. */
extern const app_registers_entry_t app_registers_map_holding[APP_REGISTERS_MAP_HOLDING];
extern const app_registers_entry_t app_registers_map_input[APP_REGISTERS_MAP_INPUT];

/** A computed value with a unit, and one without, by its number; 0: there is none. */
float    app_registers_map_real(const struct app_registers *r, uint16_t number);
uint32_t app_registers_map_whole(const struct app_registers *r, uint16_t number);

/** Puts a value that is in its range into w, as its number says. */
void app_registers_map_put(const struct app_registers *r,
                           struct app_registers_request *w, uint16_t number, float x);

#endif /* APP_REGISTERS_MAP_H */
