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

void app_record_keep(app_record_t *r)
{
    r->kept_next  = (r->count < APP_RECORD_SAMPLES) ? 0U : r->next;
    r->kept_count = r->count;
    r->number     = (uint16_t)(r->number + 1U);
    r->writes     = (uint16_t)(r->writes ^ 1U);
    r->next       = 0U;
    r->count      = 0U;
}

float app_record_read(const volatile app_record_t *r, uint16_t at, uint16_t signal)
{
    const uint16_t kept = (uint16_t)((r->writes ^ 1U) & 1U);
    return r->ring[kept][(uint16_t)(r->kept_next + at) & MASK][signal];
}
