/* SPDX-License-Identifier: MIT */
#include "drive_config.h"

#include <stddef.h>

#include "check.h"

static bool limits_ok(const drive_config_t *c)
{
    return base_in_range(c->ts_s, 1.0e-5f, 1.0e-2f) && check_positive(c->current_max_A) &&
           check_positive(c->rated_current_A) && check_positive(c->rated_torque_Nm) &&
           check_positive(c->trip_current_A) && (c->trip_current_A > c->current_max_A) &&
           check_positive(c->trip_speed_e_radps) && check_positive(c->speed_max_e_radps) &&
           (c->speed_max_e_radps <= c->trip_speed_e_radps) && check_positive(c->dc_link_min_V) &&
           check_positive(c->dc_link_max_V) && (c->dc_link_max_V > c->dc_link_min_V) &&
           check_not_negative(c->hardware.dead_time_s);
}

ctl_status_t drive_config_check(const drive_config_t *c)
{
    const bool law_ok = (c->law != NULL) && (c->constants != NULL) && c->law->check(c);

    const bool can = law_ok && (!c->torques || c->law->takes_torque);

    return (can && limits_ok(c) && motor_check(&c->motor) && dead_time_check(&c->dead_time))
               ? CTL_OK
               : CTL_BAD_CONFIG;
}
