/* SPDX-License-Identifier: MIT */
/**
 * @file register_words.h
 * @brief Single registers of the application, as a master sees them.
 */
#ifndef REGISTER_WORDS_H
#define REGISTER_WORDS_H

#include "app_registers.h"
#include "unity.h"

static inline uint16_t register_words_input(const app_registers_t *r, int address)
{
    uint16_t value = 0xDEADU;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_input(r, (uint16_t)address, 1U, &value));
    return value;
}

static inline uint16_t register_words_holding(const app_registers_t *r, int address)
{
    uint16_t value = 0xDEADU;
    TEST_ASSERT_EQUAL_INT(APP_REGISTERS_OK,
                          app_registers_read_holding(r, (uint16_t)address, 1U, &value));
    return value;
}

static inline app_registers_result_t register_words_write(app_registers_t *r, int address,
                                                          int value)
{
    const uint16_t word = (uint16_t)value;
    return app_registers_write(r, (uint16_t)address, 1U, &word);
}

#endif /* REGISTER_WORDS_H */
