/* SPDX-License-Identifier: MIT */
#include "app_registers_place.h"

#include <stddef.h>

#include "app_registers_count.h"

static bool has_no_unit(const app_registers_entry_t *e)
{
    return (e->type != APP_REGISTERS_DEC) && !(e->per_unit > 0.0f);
}

/* The member of a row. */
static const void *place(const app_registers_t *r, const app_registers_entry_t *e)
{
    const void *home = &r->requested;

    if (e->home == APP_REGISTERS_STATUS) {
        home = &r->status;
    } else if (e->home == APP_REGISTERS_DRIVE) {
        home = r->drive;
    } else if (e->home == APP_REGISTERS_CONFIG) {
        home = r->config;
    } else {
        /* APP_REGISTERS_REQUESTED */
    }
    return &((const char *)home)[e->offset];
}

static uint32_t whole_of(const app_registers_t *r, const app_registers_entry_t *e)
{
    const void *const at = place(r, e);
    uint32_t          x  = 0UL;

    switch (e->kind) {
    case APP_REGISTERS_AS_U16:
        x = *(const uint16_t *)at;
        break;
    case APP_REGISTERS_AS_I16:
        x = (uint32_t) * (const int16_t *)at;
        break;
    case APP_REGISTERS_AS_U32:
        x = *(const uint32_t *)at;
        break;
    case APP_REGISTERS_AS_I32:
        x = (uint32_t) * (const int32_t *)at;
        break;
    case APP_REGISTERS_AS_BOOL:
        x = *(const bool *)at ? 1UL : 0UL;
        break;
    case APP_REGISTERS_AS_CHAR:
        x = *(const unsigned char *)at;
        break;
    case APP_REGISTERS_AS_INT:
        x = *(const unsigned int *)at;
        break;
    case APP_REGISTERS_AS_FLOAT: /* has a unit */
    default:
        break;
    }
    return x;
}

static bool is_reversed(const app_registers_request_t *w, const app_registers_entry_t *e)
{
    return (w->units.polarity & e->sense) != 0U;
}

static float real(const app_registers_t *r, const app_registers_entry_t *e)
{
    const float x    = *(const float *)place(r, e);
    const float held = e->rpm ? (x * r->rpm_per_e_radps) : x;

    return is_reversed(&r->requested, e) ? -held : held;
}

uint32_t app_registers_place_value(const app_registers_t *r, const app_registers_entry_t *e)
{
    const bool computed = e->home == APP_REGISTERS_COMPUTED;

    if (has_no_unit(e)) {
        return computed ? app_registers_map_whole(r, e->offset) : whole_of(r, e);
    }
    return app_registers_count_of(computed ? app_registers_map_real(r, e->offset) : real(r, e), e);
}

/* Only the types of app_registers_request_t. */
static void put(const app_registers_entry_t *e, void *at, float x, int32_t n)
{
    switch (e->kind) {
    case APP_REGISTERS_AS_U16:
        *(uint16_t *)at = (uint16_t)x;
        break;
    case APP_REGISTERS_AS_I16:
        *(int16_t *)at = (int16_t)x;
        break;
    case APP_REGISTERS_AS_U32:
        *(uint32_t *)at = (uint32_t)n;
        break;
    case APP_REGISTERS_AS_I32:
        *(int32_t *)at = n;
        break;
    case APP_REGISTERS_AS_FLOAT:
        *(float *)at = x;
        break;
    case APP_REGISTERS_AS_BOOL:
    case APP_REGISTERS_AS_CHAR:
    case APP_REGISTERS_AS_INT:
    default:
        break;
    }
}

void app_registers_place_put(const app_registers_t *r, app_registers_request_t *w,
                             const app_registers_entry_t *e, float x, int32_t n)
{
    if (e->home == APP_REGISTERS_COMPUTED) {
        app_registers_map_put(r, w, e->offset, x);
    } else if (e->home == APP_REGISTERS_REQUESTED) {
        void *const home  = w;
        const float given = e->rpm ? (x / r->rpm_per_e_radps) : x;

        put(e, &((char *)home)[e->offset], is_reversed(w, e) ? -given : given, n);
    } else {
        /* input registers are not written */
    }
}
