/* SPDX-License-Identifier: MIT */
#include "dead_time.h"

#include "check.h"

static float compensate(const dead_time_config_t *c, float duty, float i_A)
{
    const float direction = base_clamp(i_A * c->inv_fade_1pA, -1.0f, 1.0f);
    return duty + (c->share * direction); /* EQ-DEAD-TIME-1 */
}

abc_t dead_time_compensate(const dead_time_config_t *c, abc_t duty, abc_t i_A)
{
    const abc_t out = {.a = compensate(c, duty.a, i_A.a),
                       .b = compensate(c, duty.b, i_A.b),
                       .c = compensate(c, duty.c, i_A.c)};
    return out;
}

bool dead_time_check(const dead_time_config_t *c)
{
    return base_in_range(c->share, 0.0f, 0.1f) && check_positive(c->inv_fade_1pA);
}
