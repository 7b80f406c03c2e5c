/* SPDX-License-Identifier: MIT */
#include "app_registers_count.h"

#define SIGN_32  0x80000000UL
#define MOST_I32 2147483520.0f /* the last float below 2^31 */
#define MOST_U32 4294967040.0f /* the last float below 2^32 */

uint16_t app_registers_count_words(const app_registers_entry_t *e)
{
    return ((e->type == APP_REGISTERS_U16) || (e->type == APP_REGISTERS_I16)) ? 1U : 2U;
}

/* Both limits are floats within the type. */
static uint32_t signed_count(float scaled, float least, float most)
{
    const float   held    = base_clamp(scaled, least, most);
    const float   rounded = held + ((held < 0.0f) ? -0.5f : 0.5f);
    const int32_t count   = (int32_t)rounded;
    return (uint32_t)count;
}

static uint32_t unsigned_count(float scaled, float most)
{
    const float rounded = base_clamp(scaled, 0.0f, most) + 0.5f;
    return (uint32_t)rounded;
}

/* x = digits 10^power with at least 4 digits. For normal single-precision numbers 45 steps suffice
 * in each loop. */
static uint32_t decimal(float x)
{
    float   digits = base_clamp(x, -1.0e30f, 1.0e30f);
    int16_t power  = 0;

    for (int16_t k = 0; (k < 45) && (fabsf(digits) >= 32767.0f); k++) {
        digits *= 0.1f;
        power++;
    }
    for (int16_t k = 0; (k < 45) && (fabsf(digits) < 3276.0f) && (fabsf(digits) > 0.0f); k++) {
        digits *= 10.0f;
        power--;
    }
    const uint32_t high = signed_count(digits, -32768.0f, 32767.0f);
    const uint32_t low  = (uint32_t)(int32_t)power;
    return (high << 16) | (low & 0xFFFFU);
}

uint32_t app_registers_count_of(float x, const app_registers_entry_t *e)
{
    switch (e->type) {
    case APP_REGISTERS_U16:
        return unsigned_count(x * e->per_unit, 65535.0f);
    case APP_REGISTERS_I16:
        return signed_count(x * e->per_unit, -32768.0f, 32767.0f);
    case APP_REGISTERS_U32:
        return unsigned_count(x * e->per_unit, MOST_U32);
    case APP_REGISTERS_I32:
        return signed_count(x * e->per_unit, -MOST_I32, MOST_I32);
    case APP_REGISTERS_DEC:
    default:
        return decimal(x);
    }
}

/* Reads a two's complement without an implementation-defined conversion. */
static float signed_32(uint32_t count)
{
    const uint32_t below = ~count; /* of a negative number: how far below -1 */

    return ((count & SIGN_32) == 0UL) ? (float)count : (-1.0f - (float)below);
}

float app_registers_count_written(const app_registers_entry_t *e, const uint16_t *words)
{
    const uint16_t high = words[0];
    float          count;

    if (app_registers_count_words(e) == 2U) {
        const uint32_t both = ((uint32_t)high << 16) | (uint32_t)words[1];
        count               = (e->type == APP_REGISTERS_I32) ? signed_32(both) : (float)both;
    } else if ((e->type == APP_REGISTERS_I16) && (high >= 0x8000U)) {
        const int32_t negative = (int32_t)high - 65536L;
        count                  = (float)negative;
    } else {
        count = (float)high;
    }
    return (e->per_unit > 0.0f) ? (count / e->per_unit) : count;
}

int32_t app_registers_count_whole(const app_registers_entry_t *e, const uint16_t *words)
{
    const bool has_sign = (e->type == APP_REGISTERS_I32) || (e->type == APP_REGISTERS_I16);
    uint32_t   count    = words[0];
    uint32_t   sign     = 0x8000U;

    if (app_registers_count_words(e) == 2U) {
        count = (count << 16) | (uint32_t)words[1];
        sign  = SIGN_32;
    }
    const uint32_t below  = ~count; /* of a negative number: how far below -1 */
    const uint32_t most   = SIGN_32 - 1U;
    const uint32_t part   = below & (sign - 1U);
    const uint32_t above  = (count <= most) ? count : most;
    const bool     is_neg = has_sign && ((count & sign) != 0U);
    int32_t        whole  = (int32_t)above;

    if (is_neg) {
        whole = (int32_t)part;
        whole = -1 - whole;
    }
    return whole;
}
