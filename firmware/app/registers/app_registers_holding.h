/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers_holding.h
 * @brief Access to single holding registers, for the files that implement app_registers.h.
 */
#ifndef APP_REGISTERS_HOLDING_H
#define APP_REGISTERS_HOLDING_H

#include "app_registers.h"

/** Index of this address in app_registers_map_holding; APP_REGISTERS_MAP_HOLDING: not found. */
uint16_t app_registers_holding_find(uint16_t address);

#endif /* APP_REGISTERS_HOLDING_H */
