/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers.h
 * @brief The application as 16-bit registers. Table with units: docs/modbus.md.
 *
 * Holding registers are what the operator wants, input registers what the application tells. Values are
 * rounded to their unit and held at the ends of 16 bits. Context: background.
 */
#ifndef APP_REGISTERS_H
#define APP_REGISTERS_H

#include "app_loader.h"
#include "app_status.h"

/** Holding registers. */
enum {
    APP_REGISTERS_RUN = 0,
    APP_REGISTERS_RESET,
    APP_REGISTERS_SPEED, /**< signed, 0.1 rad/s electrical */
    APP_REGISTERS_COMMISSION,
    APP_REGISTERS_COMMISSION_CURRENT, /**< bound, 0.01 A */
    APP_REGISTERS_COMMISSION_SPEED,   /**< bound, 0.1 rad/s mechanical */
    APP_REGISTERS_HOLDING_COUNT
};

/** Input registers. */
enum {
    APP_REGISTERS_MODE = 0,
    APP_REGISTERS_FAULT,
    APP_REGISTERS_DRIVE_FAULT,
    APP_REGISTERS_BOARD_FAULTS,
    APP_REGISTERS_CONDITIONS,
    APP_REGISTERS_REFERENCE,
    APP_REGISTERS_ALIGN_STAGE,
    APP_REGISTERS_SPEED_NOW,
    APP_REGISTERS_IQ,
    APP_REGISTERS_ID,
    APP_REGISTERS_IQ_REF,
    APP_REGISTERS_ID_REF,
    APP_REGISTERS_VQ,
    APP_REGISTERS_VD,
    APP_REGISTERS_DC_LINK,
    APP_REGISTERS_TEMPERATURE,
    APP_REGISTERS_THETA,
    APP_REGISTERS_POSITION,
    APP_REGISTERS_CORRECTIONS,
    APP_REGISTERS_ZERO_A,
    APP_REGISTERS_ZERO_B,
    APP_REGISTERS_CYCLES,
    APP_REGISTERS_CYCLES_WORST,
    APP_REGISTERS_TICKS_HI,
    APP_REGISTERS_TICKS_LO,
    APP_REGISTERS_FIRST_FAULT, /**< from here on: the snapshot */
    APP_REGISTERS_FIRST_MODE,
    APP_REGISTERS_FIRST_DRIVE_FAULT,
    APP_REGISTERS_FIRST_BOARD_FAULTS,
    APP_REGISTERS_FIRST_IA,
    APP_REGISTERS_FIRST_IB,
    APP_REGISTERS_FIRST_DC_LINK,
    APP_REGISTERS_FIRST_TEMPERATURE,
    APP_REGISTERS_FIRST_POSITION,
    APP_REGISTERS_FIRST_INDEX,
    APP_REGISTERS_FIRST_SAMPLE,
    APP_REGISTERS_FIRST_SPEED,
    APP_REGISTERS_FIRST_WANTED,
    APP_REGISTERS_FIRST_TICKS_HI,
    APP_REGISTERS_FIRST_TICKS_LO,
    APP_REGISTERS_RESET_CAUSE, /**< after the snapshot: board_reset_t */
    APP_REGISTERS_PHASE_ERRORS,
    APP_REGISTERS_IGNORED_ANGLES,
    APP_REGISTERS_IGNORED_CURRENTS,
    APP_REGISTERS_JUMPS,
    APP_REGISTERS_MOTOR_HEAT,
    APP_REGISTERS_INVERTER_HEAT,
    APP_REGISTERS_DERATING,
    APP_REGISTERS_COMMISSION_STAGE, /**< from here on: the commissioning */
    APP_REGISTERS_COMMISSION_REASON,
    APP_REGISTERS_COMMISSION_PERCENT,
    APP_REGISTERS_DIRECTION, /**< signed */
    APP_REGISTERS_POLE_PAIRS,
    APP_REGISTERS_COUNTS_HI,
    APP_REGISTERS_COUNTS_LO,
    APP_REGISTERS_RELUCTANCE,
    APP_REGISTERS_FOUND, /**< four words a value: its digits and its power of ten, signed; its error in the same way */
    APP_REGISTERS_INPUT_COUNT = APP_REGISTERS_FOUND + 36
};

/** Bits of APP_REGISTERS_CONDITIONS. */
enum {
    APP_REGISTERS_HOT           = 1,
    APP_REGISTERS_SILENT        = 2,
    APP_REGISTERS_GATE          = 4,
    APP_REGISTERS_DC_OUT        = 8,
    APP_REGISTERS_TRIPPED       = 16,
    APP_REGISTERS_SHORTED       = 32,
    APP_REGISTERS_WITHOUT_ANGLE = 64,
    APP_REGISTERS_VOLTAGE_LIMIT = 128,
    APP_REGISTERS_CURRENT_LIMIT = 256,
    APP_REGISTERS_DERATED       = 512
};

/** Bits of APP_REGISTERS_FIRST_SAMPLE. */
enum { APP_REGISTERS_SAMPLE_VALID = 1, APP_REGISTERS_SAMPLE_INDEX = 2 };

typedef enum {
    APP_REGISTERS_OK = 0,
    APP_REGISTERS_BAD_ADDRESS, /**< not all of the registers exist */
    APP_REGISTERS_BAD_VALUE    /**< out of range; nothing was written */
} app_registers_result_t;

typedef struct {
    app_status_t  status;
    app_command_t command;
    float         speed_max_e_radps;
    bool          changed; /**< command is new; its taker clears this and command.reset */
    app_loader_t *loader;  /**< answers from APP_LOADER_FIRST on; NULL: nothing does */
    bool          silent;  /**< run was withdrawn because nobody talked; until run is written */
} app_registers_t;

/** @param speed_max_e_radps Largest speed that may be commanded, either way. Context: init. */
void app_registers_init(app_registers_t *r, float speed_max_e_radps);

/** `count` holding registers from `first` on. */
app_registers_result_t app_registers_read_holding(const app_registers_t *r, uint16_t first,
                                                  uint16_t count, uint16_t *values);

/** `count` input registers from `first` on. */
app_registers_result_t app_registers_read_input(const app_registers_t *r, uint16_t first,
                                                uint16_t count, uint16_t *values);

/** All of them or, when one address or value is refused, none. */
app_registers_result_t app_registers_write(app_registers_t *r, uint16_t first, uint16_t count,
                                           const uint16_t *values);

/** Withdraws run and commissioning. */
void app_registers_silence(app_registers_t *r);

#endif /* APP_REGISTERS_H */
