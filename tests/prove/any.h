/* SPDX-License-Identifier: MIT */
/**
 * @file any.h
 * @brief Values that the analyser knows nothing of: whole numbers, also of a range, and truth values.
 */
#ifndef ANY_H
#define ANY_H

#include <stdbool.h>
#include <stdint.h>

/* The analyser reads any bits from what is volatile; in what is not it starts with any value of its type. */
volatile int      any_int;
volatile int32_t  any_long;
volatile uint16_t any_word;

static bool any_bool(void)
{
    return any_int != 0;
}

static int32_t any_long_between(int32_t lo, int32_t hi)
{
    const int32_t x = any_long;

    return (x < lo) ? lo : ((x > hi) ? hi : x);
}

static int any_between(int lo, int hi)
{
    const int x = any_int;

    return (x < lo) ? lo : ((x > hi) ? hi : x);
}

#endif /* ANY_H */
