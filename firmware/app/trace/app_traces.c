/* SPDX-License-Identifier: MIT */
#include "app_traces.h"

#define SCOPE_WORDS  (2U * APP_SCOPE_SAMPLES * APP_SCOPE_CHANNELS)
#define RECORD_WORDS (2U * APP_RECORD_SAMPLES * APP_RECORD_SIGNALS)

static uint16_t word_of(float x, bool low)
{
    union {
        float    value;
        uint32_t bits;
    } both;

    both.value = x;
    return (uint16_t)((low ? both.bits : (both.bits >> 16)) & 0xFFFFUL);
}

static bool exist(uint16_t first, uint16_t count, uint16_t all)
{
    return (first < all) && (count <= (uint16_t)(all - first));
}

static app_traces_result_t read_scope(const volatile app_scope_t *s, uint16_t first, uint16_t count,
                                      uint16_t *values)
{
    if (!exist(first, count, SCOPE_WORDS)) {
        return APP_TRACES_BAD_ADDRESS;
    }
    if (s->state != APP_SCOPE_DONE) {
        return APP_TRACES_NOT_NOW;
    }
    for (uint16_t n = 0U; n < count; n++) {
        const uint16_t at = (uint16_t)(first + n);
        const uint16_t k  = (uint16_t)(at / 2U);
        values[n]         = word_of(app_scope_read(s, (uint16_t)(k / APP_SCOPE_CHANNELS),
                                                   (uint16_t)(k % APP_SCOPE_CHANNELS)),
                                    (at % 2U) != 0U);
    }
    return APP_TRACES_OK;
}

static app_traces_result_t read_record(const volatile app_record_t *r, uint16_t first,
                                       uint16_t count, uint16_t *values)
{
    if (!exist(first, count, RECORD_WORDS)) {
        return APP_TRACES_BAD_ADDRESS;
    }
    if (!exist(first, count, (uint16_t)(2U * APP_RECORD_SIGNALS * r->kept_count))) {
        return APP_TRACES_NOT_NOW;
    }
    for (uint16_t n = 0U; n < count; n++) {
        const uint16_t at = (uint16_t)(first + n);
        const uint16_t k  = (uint16_t)(at / 2U);
        values[n]         = word_of(app_record_read(r, (uint16_t)(k / APP_RECORD_SIGNALS),
                                                    (uint16_t)(k % APP_RECORD_SIGNALS)),
                                    (at % 2U) != 0U);
    }
    return APP_TRACES_OK;
}

app_traces_result_t app_traces_read(const volatile app_scope_t  *scope,
                                    const volatile app_record_t *record, uint16_t first,
                                    uint16_t count, uint16_t *values)
{
    return (first < APP_TRACES_RECORD)
               ? read_scope(scope, (uint16_t)(first - APP_TRACES_SCOPE), count, values)
               : read_record(record, (uint16_t)(first - APP_TRACES_RECORD), count, values);
}
