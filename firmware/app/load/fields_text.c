/* SPDX-License-Identifier: MIT */
#include "fields_text.h"

static uint16_t char_word(char c)
{
    return (uint16_t)((uint16_t)c & 0xFFU); /* a C28x char has 16 bits */
}

void fields_text(fields_t *f, char *x, uint16_t words)
{
    for (uint16_t n = 0U; n < words; n++) {
        char *const c    = &x[2U * n];
        uint16_t    word = (uint16_t)((uint16_t)(char_word(c[0]) << 8) | char_word(c[1]));
        fields_u16(f, &word);
        c[0] = (char)(word >> 8);
        c[1] = (char)(word & 0xFFU);
    }
    x[2U * words] = '\0';
}
