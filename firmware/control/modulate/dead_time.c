/* SPDX-License-Identifier: MIT */
#include "dead_time.h"

#include "check.h"

bool dead_time_check(const dead_time_config_t *c)
{
    return base_in_range(c->share, 0.0f, 0.1f) && check_positive(c->inv_fade_1pA);
}
