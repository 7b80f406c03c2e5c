/* SPDX-License-Identifier: MIT */
/**
 * @file app_modbus_answer.h
 * @brief Executes complete Modbus requests and builds the answers. Context: background.
 */
#ifndef APP_MODBUS_ANSWER_H
#define APP_MODBUS_ANSWER_H

#include "app_modbus.h"

/** Exceptions, by the protocol. */
enum {
    APP_MODBUS_NO_FUNCTION = 1,
    APP_MODBUS_NO_ADDRESS  = 2,
    APP_MODBUS_NO_VALUE    = 3,
    APP_MODBUS_NOT_NOW     = 4
};

/** True if the request length fits its function. An unknown function may have any length. */
bool app_modbus_answer_length_ok(const app_modbus_t *m);

/** Executes the request and builds the answer, without its CRC. */
void app_modbus_answer(app_modbus_t *m, app_registers_t *r);

/* For the files that build answers. */

/** Begins the answer of the request's function. */
void app_modbus_answer_begin(app_modbus_t *m);
void app_modbus_answer_octet(app_modbus_t *m, uint16_t octet);
void app_modbus_answer_word(app_modbus_t *m, uint16_t word);
void app_modbus_answer_exception(app_modbus_t *m, uint16_t exception);
/** Two octets of the request, the high one first. */
uint16_t app_modbus_answer_asked(const app_modbus_t *m, uint16_t at);

#endif /* APP_MODBUS_ANSWER_H */
