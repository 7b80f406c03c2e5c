/* SPDX-License-Identifier: MIT */
#include "app_watch_heat.h"

#include "check.h"

#define STARTS   0.9f  /* chosen: the limit decreases from here to 1 */
#define PER_ROOM 10.0f /* 1 / (1 - STARTS) */
#define TOO_HOT  1.1f
#define HALF     0.5f /* chosen: least share that a hot heat sink leaves */
#define THIRD    0.333333333f

static void part_init(app_watch_heat_part_t *p, float nominal_A, float tau_s, float max_A,
                      float ts_s)
{
    p->per_tick = ts_s / tau_s;
    p->per_A2   = 1.0f / (nominal_A * nominal_A);
    p->most     = base_max(1.0f - (nominal_A / max_A), 0.0f);
    p->x        = 0.0f;
}

ctl_status_t app_watch_heat_check(const app_watch_heat_config_t *c, float current_max_A, float ts_s)
{
    const bool ok = check_positive(c->motor_A) && check_positive(c->motor_s) &&
                    check_positive(c->inverter_A) && check_positive(c->inverter_s) &&
                    check_positive(current_max_A) && (c->motor_s > ts_s) && (c->inverter_s > ts_s);

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

ctl_status_t app_watch_heat_init(app_watch_heat_t *h, const app_watch_heat_config_t *c,
                                 float current_max_A, float ts_s)
{
    const ctl_status_t status = app_watch_heat_check(c, current_max_A, ts_s);

    if (status == CTL_OK) {
        part_init(&h->motor, c->motor_A, c->motor_s, current_max_A, ts_s);
        part_init(&h->inverter, c->inverter_A, c->inverter_s, current_max_A, ts_s);
    }
    h->derating = 0.0f;
    return status;
}

/* EQ-APP-HEAT-1 and 2: derating by this part. */
static float warm(app_watch_heat_part_t *p, float i2_A2)
{
    p->x += p->per_tick * ((i2_A2 * p->per_A2) - p->x);
    return base_clamp(PER_ROOM * (p->x - STARTS), 0.0f, 1.0f) * p->most;
}

bool app_watch_heat_tick(app_watch_heat_t *h, float ia_A, float ib_A, float warmth)
{
    const float beta        = ia_A + (2.0f * ib_A);
    const float i2_A2       = (ia_A * ia_A) + (THIRD * beta * beta);
    const float by_motor    = warm(&h->motor, i2_A2);
    const float by_inverter = warm(&h->inverter, i2_A2);
    const float by_sink     = HALF * base_clamp(warmth, 0.0f, 1.0f); /* EQ-APP-HEAT-3 */

    h->derating = base_max(by_sink, base_max(by_motor, by_inverter));
    return base_within(h->motor.x, TOO_HOT) && base_within(h->inverter.x, TOO_HOT);
}
