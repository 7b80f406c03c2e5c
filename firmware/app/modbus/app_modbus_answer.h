/* SPDX-License-Identifier: MIT */
/**
 * @file app_modbus_answer.h
 * @brief Executes complete Modbus requests and builds the answers. Context: background.
 */
#ifndef APP_MODBUS_ANSWER_H
#define APP_MODBUS_ANSWER_H

#include "app_modbus.h"

/** True if the request length fits its function. An unknown function may have any length. */
bool app_modbus_answer_length_ok(const app_modbus_t *m);

/** Executes the request and builds the answer, without its CRC. */
void app_modbus_answer(app_modbus_t *m, app_registers_t *r);

#endif /* APP_MODBUS_ANSWER_H */
