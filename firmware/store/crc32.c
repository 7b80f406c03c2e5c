/* SPDX-License-Identifier: MIT */
#include "crc32.h"

#define POLYNOMIAL 0xEDB88320UL /* reflected */

static uint32_t octet(uint32_t register32, uint16_t value)
{
    uint32_t r = register32 ^ (uint32_t)value;

    for (uint16_t bit = 0U; bit < 8U; bit++) {
        const bool one = (r & 1UL) != 0UL;
        r >>= 1;
        if (one) {
            r ^= POLYNOMIAL;
        }
    }
    return r;
}

uint32_t crc32_words(uint32_t crc, const uint16_t *words, uint32_t count)
{
    uint32_t r = crc ^ 0xFFFFFFFFUL;

    for (uint32_t n = 0UL; n < count; n++) {
        r = octet(r, (uint16_t)(words[n] >> 8));
        r = octet(r, (uint16_t)(words[n] & 0xFFU));
    }
    return r ^ 0xFFFFFFFFUL;
}
