/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers_holding.h
 * @brief The holding registers one by one, for the files that make up app_registers.h.
 */
#ifndef APP_REGISTERS_HOLDING_H
#define APP_REGISTERS_HOLDING_H

#include "app_registers.h"

/** Place in app_registers_map_holding of the value with this address; APP_REGISTERS_MAP_HOLDING: there is none. */
uint16_t app_registers_holding_find(uint16_t address);

/** What its words are now; of two the high one is the upper half. */
uint32_t app_registers_holding_value(const app_registers_t *r, const app_registers_entry_t *e);

#endif /* APP_REGISTERS_HOLDING_H */
