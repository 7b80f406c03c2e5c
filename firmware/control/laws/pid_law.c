/* SPDX-License-Identifier: MIT */
#include "pid_law.h"

#include "check.h"

void pid_law_reset(pid_law_t *s, float integral_V)
{
    s->running    = false;
    s->integral_V = integral_V;
    s->error      = 0.0f;
    s->u_V        = 0.0f;
}

float pid_law_update(pid_law_t *s, const pid_law_config_t *c, float error)
{
    const float step = s->running ? (error - s->error) : 0.0f;

    s->u_V     = (c->kp * error) + s->integral_V + (c->kd_tick * step); /* EQ-PID-1 */
    s->error   = error;
    s->running = true;
    return s->u_V;
}

void pid_law_realise(pid_law_t *s, const pid_law_config_t *c, float v_V)
{
    const float cut_V = s->u_V - v_V;

    if (cut_V * s->error <= 0.0f) { /* EQ-PID-2 */
        s->integral_V += c->ki_per_tick * s->error;
    }
}

bool pid_law_check(const pid_law_config_t *c)
{
    return check_positive(c->kp) && base_in_range(c->ki_per_tick, 0.0f, CHECK_LARGEST) &&
           base_in_range(c->kd_tick, 0.0f, CHECK_LARGEST);
}
