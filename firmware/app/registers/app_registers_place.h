/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers_place.h
 * @brief Values of the registers, by the rows of registers.toml. Context: background.
 */
#ifndef APP_REGISTERS_PLACE_H
#define APP_REGISTERS_PLACE_H

#include "app_registers.h"

/** Value of a register as its words; of two words the high one is the upper half. */
uint32_t app_registers_place_value(const app_registers_t *r, const app_registers_entry_t *e);

/**
 * @brief Puts a value that is in its range into `w`.
 *
 * @param x In SI units.
 * @param n In counts, for a whole number with a sign.
 */
void app_registers_place_put(const app_registers_t *r, app_registers_request_t *w,
                             const app_registers_entry_t *e, float x, int32_t n);

#endif /* APP_REGISTERS_PLACE_H */
