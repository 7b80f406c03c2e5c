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
    r->was_fault  = true; /* a fault at the start has no samples before it */
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

/* Copies the scope signals of the same names directly. A switch for each costs ten times as
 * much. */
static void take(float to[APP_RECORD_SIGNALS], const app_modes_t *m, const abc_t *duty)
{
    to[0] = m->sample.ia_A;
    to[1] = m->sample.ib_A;
    to[2] = m->sample.dc_link_V;
    to[3] = (m->drive.state == DRIVE_RUN) ? m->drive.answer.now.omega_e_radps
                                          : m->reading.omega_e_radps;
    to[4] = duty->a;
    to[5] = duty->b;
    to[6] = duty->c;
}

void app_record_tick(app_record_t *r, const app_scope_view_t *view)
{
    const bool fault = view->modes->mode == APP_MODE_FAULT;

    take(r->ring[r->writes & 1U][r->next & MASK], view->modes, &view->out->duty);
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
