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

static void word(fields_t *f, uint16_t *x)
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

void fields_u16(fields_t *f, uint16_t *x)
{
    FIELDS_TELL(f, FIELDS_U16, x);
    word(f, x);
}

void fields_i16(fields_t *f, int16_t *x)
{
    uint16_t bits = (uint16_t)*x;

    FIELDS_TELL(f, FIELDS_I16, x);
    word(f, &bits);
    *x = (bits <= 0x7FFFU) ? (int16_t)bits : (int16_t)((int32_t)bits - 65536L);
}

static void two_words(fields_t *f, uint32_t *x)
{
    uint16_t high = (uint16_t)(*x >> 16);
    uint16_t low  = (uint16_t)(*x & 0xFFFFUL);

    word(f, &high);
    word(f, &low);
    *x = ((uint32_t)high << 16) | low;
}

void fields_u32(fields_t *f, uint32_t *x)
{
    FIELDS_TELL(f, FIELDS_U32, x);
    two_words(f, x);
}

void fields_flag(fields_t *f, bool *x)
{
    uint16_t bit = 0U;

    if (f->from == NULL) { /* otherwise *x may be no flag yet */
        FIELDS_TELL(f, FIELDS_FLAG, x);
        bit = *x ? 1U : 0U;
    }
    word(f, &bit);
    if (bit > 1U) {
        f->ok = false;
    }
    *x = bit == 1U;
}

void fields_float(fields_t *f, float *x)
{
    union {
        float    number;
        uint32_t bits;
    } both = {.number = *x};

    FIELDS_TELL(f, FIELDS_FLOAT, x);
    two_words(f, &both.bits);
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

#ifdef FIELDS_NAMED
fields_t fields_told(const fields_listener_t *listener)
{
    fields_t f = fields_writer(NULL, 0UL);

    f.listener = listener;
    return f;
}

void fields_name(fields_t *f, const char *name)
{
    f->name = name;
}

void fields_begin(fields_t *f, const char *name)
{
    f->name = NULL;
    if (f->listener != NULL) {
        f->listener->begin(f->listener->self, name);
    }
}

void fields_end(fields_t *f)
{
    if (f->listener != NULL) {
        f->listener->end(f->listener->self);
    }
}

void fields_tell(fields_t *f, fields_kind_t kind, const void *x)
{
    if (f->listener != NULL) {
        f->listener->number(f->listener->self, f->name, kind, x);
    }
    f->name = NULL;
}
#endif
