/* SPDX-License-Identifier: MIT */
/**
 * @file app_parameters.h
 * @brief The registers that are kept over power: docs/parameters.md.
 *
 * All of them are one record of the store, written as a whole:
 *
 *     0, 1     APP_REGISTERS_SAVED_VERSION, high word first: what the words mean
 *     2 ..     the words of the parameters as a master reads them, in the order of registers.toml
 *
 * Flash cannot be read while it is written, and the watchdog of a running application cannot be stopped: so the command
 * puts the record into words that outlast a reset, restarts the drive, and main() writes it before anything else runs.
 */
#ifndef APP_PARAMETERS_H
#define APP_PARAMETERS_H

#include "store.h"

/** What is asked for: 1010h, 1011h. */
typedef enum {
    APP_PARAMETERS_NO_COMMAND = 0,
    APP_PARAMETERS_STORE,
    APP_PARAMETERS_RESTORE
} app_parameters_command_t;

typedef enum {
    APP_PARAMETERS_DEFAULT = 0,   /**< nothing is stored */
    APP_PARAMETERS_STORED,        /**< in force */
    APP_PARAMETERS_OTHER_VERSION, /**< of a firmware with other parameters: defaults */
    APP_PARAMETERS_OUT_OF_RANGE   /**< one of the values: defaults */
} app_parameters_state_t;

/** What became of a command. */
typedef enum {
    APP_PARAMETERS_NOT_ASKED = 0,
    APP_PARAMETERS_DONE,
    APP_PARAMETERS_FLASH /**< it failed: what was stored before stays */
} app_parameters_done_t;

typedef struct {
    app_parameters_state_t state;
    app_parameters_done_t  done;
    uint32_t               number; /**< of the writing in force; 0: defaults */
} app_parameters_t;

struct app_registers;

/** The newest record into the registers, which are as after their init. Context: init. */
void app_parameters_take(app_parameters_t *p, struct app_registers *r, app_parameters_done_t done);

/** Leaves word of a command for app_parameters_work(), with the parameters as they are. Context: background. */
void app_parameters_ask(const struct app_registers *r, app_parameters_command_t command);

/** Does what was asked for before the restart, once. Context: init, before board_start(); lasts seconds. */
app_parameters_done_t app_parameters_work(void);

#endif /* APP_PARAMETERS_H */
