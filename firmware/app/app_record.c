/* SPDX-License-Identifier: MIT */
#include "app_record.h"

#define MASK (APP_RECORD_SAMPLES - 1U)

void app_record_init(app_record_t *r)
{
    r->writes     = 0U;
    r->next       = 0U;
    r->count      = 0U;
    r->kept_next  = 0U;
    r->kept_count = 0U;
    r->number     = 0U;
    r->was_fault  = true; /* one of the start has nothing before it */
}

static void keep(app_record_t *r)
{
    r->kept_next  = (r->count < APP_RECORD_SAMPLES) ? 0U : r->next;
    r->kept_count = r->count;
    r->number     = (uint16_t)(r->number + 1U);
    r->writes     = (uint16_t)(r->writes ^ 1U);
    r->next       = 0U;
    r->count      = 0U;
}

void app_record_tick(app_record_t *r, const app_scope_view_t *view)
{
    static const uint16_t signals[APP_RECORD_SIGNALS] = {
        APP_SCOPE_IA,     APP_SCOPE_IB,     APP_SCOPE_DC_LINK, APP_SCOPE_SPEED,
        APP_SCOPE_DUTY_A, APP_SCOPE_DUTY_B, APP_SCOPE_DUTY_C};
    const bool   fault = view->modes->mode == APP_MODE_FAULT;
    float *const to    = r->ring[r->writes & 1U][r->next & MASK];

    for (uint16_t k = 0U; k < APP_RECORD_SIGNALS; k++) {
        to[k] = app_scope_signals_value(view, signals[k]);
    }
    r->next = (uint16_t)((r->next + 1U) & MASK);
    if (r->count < APP_RECORD_SAMPLES) {
        r->count = (uint16_t)(r->count + 1U);
    }
    if (fault && !r->was_fault) {
        keep(r);
    }
    r->was_fault = fault;
}

float app_record_read(const volatile app_record_t *r, uint16_t at, uint16_t signal)
{
    const uint16_t kept = (uint16_t)((r->writes ^ 1U) & 1U);
    return r->ring[kept][(uint16_t)(r->kept_next + at) & MASK][signal];
}
