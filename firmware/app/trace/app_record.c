/* SPDX-License-Identifier: MIT */
#include "app_record.h"

#define MASK (APP_RECORD_SAMPLES - 1U)

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

APP_PART void app_record_tick(app_record_t *r, const app_scope_view_t *view)
{
    const bool fault = view->modes->mode == APP_MODE_FAULT;

    take(r->ring[r->writes & 1U][r->next & MASK], view->modes, &view->out->duty);
    r->next = (uint16_t)((r->next + 1U) & MASK);
    if (r->count < APP_RECORD_SAMPLES) {
        r->count = (uint16_t)(r->count + 1U);
    }
    if (fault && !r->was_fault) {
        app_record_keep(r);
    }
    r->was_fault = fault;
}
