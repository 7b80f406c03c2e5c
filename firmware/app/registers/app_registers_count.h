/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers_count.h
 * @brief Values as registers count them: rounded to their step, held at the ends of their type. Context: background.
 */
#ifndef APP_REGISTERS_COUNT_H
#define APP_REGISTERS_COUNT_H

#include "app_registers_map.h"

/** Registers of a value, 1 or 2. */
uint16_t app_registers_count_words(const app_registers_entry_t *e);

/** A value with a unit; of two words the high one is the upper half. */
uint32_t app_registers_count_of(float x, const app_registers_entry_t *e);

/** And back, from its words. */
float app_registers_count_written(const app_registers_entry_t *e, const uint16_t *words);

/** The counts themselves, of a type with a sign or below 2^31; else the largest. */
int32_t app_registers_count_whole(const app_registers_entry_t *e, const uint16_t *words);

#endif /* APP_REGISTERS_COUNT_H */
