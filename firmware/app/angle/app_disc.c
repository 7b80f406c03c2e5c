/* SPDX-License-Identifier: MIT */
#include "app_disc.h"

#include <stddef.h>

#if APP_DISC_MAP
#define OCTET_SIGN  0x80UL
#define CNT_PER_LSB (1.0f / 256.0f)

/* EQ-DISC-1. A damaged zero leads to no other memory. */
static float look_up_cnt(const app_disc_t *d, uint16_t edge_cnt)
{
    const uint16_t n       = app_disc_place(d, edge_cnt);
    float          off_cnt = 0.0f;

    if (n < d->positions) {
        const uint32_t word  = d->octets[n / 2U];
        const uint32_t high  = word >> 8U;
        const uint32_t octet = ((n & 1U) != 0U) ? high : (word & 0xFFUL);
        const uint32_t above = octet ^ OCTET_SIGN; /* above the least value */
        off_cnt              = CNT_PER_LSB * ((float)above - (float)OCTET_SIGN);
    }
    return off_cnt;
}

APP_MEASURE_PART float app_disc_turned_cnt(app_disc_t *d, uint16_t edge_cnt, float turned_cnt,
                                           float between_s)
{
    float taken_cnt = turned_cnt;

    if ((d->state == APP_DISC_IN_FORCE) || (d->state == APP_DISC_COMPARES)) {
        const float off_cnt    = look_up_cnt(d, edge_cnt);
        const bool  follows    = d->have_edge && (between_s > 0.0f);
        const float mapped_cnt = turned_cnt + (follows ? (off_cnt - d->off_cnt) : 0.0f);

        d->off_cnt   = off_cnt;
        d->have_edge = true;
        if (d->state == APP_DISC_IN_FORCE) {
            taken_cnt = mapped_cnt;
        } else if (follows) {
            app_disc_compare(d, turned_cnt, mapped_cnt, between_s);
        } else {
            d->have_speed = false;
        }
    }
    return taken_cnt;
}
#endif
