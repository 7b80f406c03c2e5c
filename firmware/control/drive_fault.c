/* SPDX-License-Identifier: MIT */
#include "drive_fault.h"

#include <stddef.h>

static bool is_good_motion(const drive_config_t *c, const position_motion_t *m)
{
    return position_ok(&m->at) && base_within(m->omega_e_radps, c->speed_max_e_radps) &&
           base_within(m->omega_dot_e_radps2, CHECK_LARGEST) &&
           base_within(m->omega_2dot_e_radps3, CHECK_LARGEST);
}

static bool is_good_position(const drive_config_t *c, const position_command_t *p)
{
    const bool goal = p->moves ? is_good_motion(c, &p->motion)
                               : (position_ok(&p->target) && position_profile_is_any(&p->profile));

    return c->positions && position_ok(&p->actual) && goal;
}

static bool is_good_torque(const drive_config_t *c, const torque_command_t *t)
{
    return c->torques && base_within(t->share, TORQUE_SHARE_MAX) &&
           base_in_range(t->speed_max_e_radps, 0.0f, c->speed_max_e_radps);
}

bool drive_fault_aim_ok(const drive_config_t *c, const law_aim_t *aim)
{
    const bool moves = aim->position != NULL;

    return (moves && is_good_position(c, aim->position)) ||
           (!moves && (aim->torque != NULL) && is_good_torque(c, aim->torque));
}

/* Uncertainty of the angle and both times of edges: none negative, and a NaN or an infinity shows
 * in the sum. */
static bool edges_ok(const drive_sample_t *s)
{
    const float least = base_min(base_min(s->band_rad, s->edge_gap_s), s->edge_age_s);
    const float sum   = s->band_rad + s->edge_gap_s + s->edge_age_s;

    return (least >= 0.0f) && (sum <= DRIVE_FAULT_TIMES_MAX_s) && (s->band_rad <= BASE_PI);
}

drive_fault_t drive_fault_of(const drive_t *d, const drive_sample_t *s,
                             const drive_command_t *command, current_gate_verdict_t currents)
{
    const drive_config_t *c = d->config;

    if (!s->valid || !base_within(s->theta_e_rad, BASE_TWO_PI) || !edges_ok(s)) {
        return DRIVE_FAULT_SAMPLE;
    }
    if (currents == CURRENT_GATE_TRIP) {
        return DRIVE_FAULT_OVER_CURRENT;
    }
    if (!base_in_range(s->dc_link_V, c->dc_link_min_V, c->dc_link_max_V)) {
        return DRIVE_FAULT_DC_LINK;
    }
    if (!base_within(s->omega_e_radps, d->sample_speed_max_e_radps)) {
        return DRIVE_FAULT_OVER_SPEED;
    }
    if (!drive_fault_command_ok(c, command)) {
        return DRIVE_FAULT_COMMAND;
    }
    return DRIVE_FAULT_NONE;
}
