/* SPDX-License-Identifier: MIT */
#include "app_chopper.h"

#include <stddef.h>

#include "check.h"

#define TURNS_PER_TAU_MIN 2.0f /* the model is a difference equation */

static bool chopper_ok(const app_chopper_config_t *c, float dc_link_V_per_cnt, float dc_link_max_V,
                       float turn_s)
{
    return (c->off_cnt > 0U) && (c->off_cnt < c->on_cnt) &&
           (((float)c->on_cnt * dc_link_V_per_cnt) < dc_link_max_V) && check_positive(c->per_V2) &&
           check_positive(c->tau_s) && (c->tau_s > (TURNS_PER_TAU_MIN * turn_s));
}

ctl_status_t app_chopper_check(const app_chopper_config_t *c, bool wanted, float dc_link_V_per_cnt,
                               float dc_link_max_V, float turn_s)
{
    const bool ok = wanted ? chopper_ok(c, dc_link_V_per_cnt, dc_link_max_V, turn_s)
                           : ((c->on_cnt == 0U) && (c->off_cnt == 0U));

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

#if BOARD_CHOPPER

#define NEVER_cnt 0xFFFFU /* no code is above */
#define HOT       1.0f
#define COOL      0.9f /* chosen: a tenth of the rated heat */
#define LONGEST_s 1.0f /* chosen: ten times R C of 100 Ohm and 1 mF */

/* Codes in force; at the first one the resistor has to be off. */
static void set_levels(app_chopper_t *c)
{
    const bool may = c->present && !c->hot && !c->stuck;

    c->on_cnt  = may ? c->board_on_cnt : NEVER_cnt;
    c->off_cnt = may ? c->board_off_cnt : NEVER_cnt;
}

void app_chopper_init(app_chopper_t *c, const app_chopper_config_t *config, float ts_s)
{
    const bool          present = (config != NULL) && (config->on_cnt > 0U);
    const app_chopper_t start   = {.ts_s = ts_s, .present = present};

    *c = start;
    if (present) {
        c->board_on_cnt  = config->on_cnt;
        c->board_off_cnt = config->off_cnt;
        c->per_tick      = ts_s / config->tau_s;
        c->per_V2        = config->per_V2;
    }
    set_levels(c);
}

void app_chopper_turn(app_chopper_t *c, const board_sample_t *raw, float dc_link_V, uint32_t ticks)
{
    const uint32_t past     = ticks - c->seen_ticks;
    const uint16_t on_ticks = (uint16_t)(c->on_ticks - c->seen_on_ticks);
    const float    cooled   = base_min((float)past * c->per_tick, 1.0f);
    const float    heated   = (float)on_ticks * c->per_tick * c->per_V2 * dc_link_V * dc_link_V;

    c->seen_ticks    = ticks;
    c->seen_on_ticks = c->on_ticks;
    c->heat += heated - (cooled * c->heat);
    /* A heat that is no number counts as hot. */
    c->hot = !base_in_range(c->heat, 0.0f, c->hot ? COOL : HOT);

    c->stuck_s = ((uint32_t)on_ticks >= past) ? (c->stuck_s + ((float)past * c->ts_s)) : 0.0f;
    c->stuck   = (c->stuck || (c->stuck_s >= LONGEST_s)) && (raw->dc_link_cnt > c->board_off_cnt);
    set_levels(c);
}

app_chopper_state_t app_chopper_state(const volatile app_chopper_t *c)
{
    app_chopper_state_t state = c->on ? APP_CHOPPER_ON : APP_CHOPPER_OFF;

    if (!c->present) {
        state = APP_CHOPPER_NONE;
    } else if (c->hot) {
        state = APP_CHOPPER_HOT;
    } else if (c->stuck) {
        state = APP_CHOPPER_STUCK;
    } else {
        /* switches */
    }
    return state;
}

#endif
