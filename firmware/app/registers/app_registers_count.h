/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers_count.h
 * @brief Converts values to register counts: rounded and limited to the type. Context: background.
 */
#ifndef APP_REGISTERS_COUNT_H
#define APP_REGISTERS_COUNT_H

#include "app_registers_map.h"

/** Registers of a value, 1 or 2. */
uint16_t app_registers_count_words(const app_registers_entry_t *e);

/** Counts of a value in SI units; of two words the high one is the upper half. */
uint32_t app_registers_count_of(float x, const app_registers_entry_t *e);

/** Value in SI units from its words. */
float app_registers_count_written(const app_registers_entry_t *e, const uint16_t *words);

/** Counts of a signed type, or of an unsigned one limited to 2^31 - 1. */
int32_t app_registers_count_whole(const app_registers_entry_t *e, const uint16_t *words);

#endif /* APP_REGISTERS_COUNT_H */
