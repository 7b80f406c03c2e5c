/* SPDX-License-Identifier: MIT */
#include "fields.h"

#include <stddef.h>

fields_t fields_reader(const uint16_t *words, uint32_t count)
{
    const fields_t f = {.from = words, .to = NULL, .count = count, .at = 0UL, .ok = true};
    return f;
}

fields_t fields_writer(uint16_t *words, uint32_t count)
{
    const fields_t f = {.from = NULL, .to = words, .count = count, .at = 0UL, .ok = true};
    return f;
}

void fields_u16(fields_t *f, uint16_t *x)
{
    const bool counts_only = (f->from == NULL) && (f->to == NULL);

    if (!counts_only && (f->at >= f->count)) {
        f->ok = false;
        return;
    }
    if (f->from != NULL) {
        *x = f->from[f->at];
    } else if (f->to != NULL) {
        f->to[f->at] = *x;
    } else {
        /* counts */
    }
    f->at = f->at + 1UL;
}

void fields_i16(fields_t *f, int16_t *x)
{
    uint16_t word = (uint16_t)*x;

    fields_u16(f, &word);
    *x = (word <= 0x7FFFU) ? (int16_t)word : (int16_t)((int32_t)word - 65536L);
}

void fields_u32(fields_t *f, uint32_t *x)
{
    uint16_t high = (uint16_t)(*x >> 16);
    uint16_t low  = (uint16_t)(*x & 0xFFFFUL);

    fields_u16(f, &high);
    fields_u16(f, &low);
    *x = ((uint32_t)high << 16) | low;
}

void fields_flag(fields_t *f, bool *x)
{
    uint16_t word = 0U;

    if (f->from == NULL) { /* otherwise *x may be no flag yet */
        word = *x ? 1U : 0U;
    }
    fields_u16(f, &word);
    if (word > 1U) {
        f->ok = false;
    }
    *x = word == 1U;
}

void fields_float(fields_t *f, float *x)
{
    union {
        float    number;
        uint32_t bits;
    } both = {.number = *x};

    fields_u32(f, &both.bits);
    *x = both.number;
}

void fields_floats(fields_t *f, float *x, uint16_t count)
{
    for (uint16_t n = 0U; n < count; n++) {
        fields_float(f, &x[n]);
    }
}

bool fields_complete(const fields_t *f)
{
    return f->ok && (f->at == f->count);
}
