/* SPDX-License-Identifier: MIT */
#include "app_registers.h"

void app_registers_see_ring(app_registers_t *r)
{
    const app_status_t         *s    = &r->status;
    const app_watch_ring_seen_t seen = {.ticks = s->ticks,
                                        .runs  = (s->mode == APP_MODE_RUN) && !s->without_angle,
                                        .iq_A  = s->i_A.q};

    app_watch_ring_see(&r->ring, &seen, r->drive->current_max_A, r->drive->ts_s);
}

float app_registers_ring(const app_registers_t *r)
{
    return r->ring.hz;
}
