/* SPDX-License-Identifier: MIT */
#include "motion_watch.h"

/* Errors of one half in R, L and flux leave half of the voltage, plus the rest of the dead time. */
#define HALF_OFF  0.6f
#define DEAD_TIME 0.02f
/* Chosen: a dead time wrong by a fortieth of the PWM period leaves 4/3 of that, and noise. Alone:
 * with the error of R as well, an encoder that stands still would be found late. */
#define DEAD_TIME_ALONE 0.035f
#define POWER_OFF       0.5f     /* errors of one half in flux, Lq - Ld and R */
#define ODD_s           10.0e-3f /* chosen: twice what a step at the voltage limit takes */

#define AT_LIMIT2 0.81f /* 0.9 of the limit */
#define STILL_s                                                                                    \
    50.0e-3f /* chosen: in this time the limit's torque turns 3 x the motor's inertia by 2 rad */
#define GAP_SEEN_s   45.0e-3f /* gaps are measured up to 50 ms (app_angle.c) */
#define SLOW_e_radps 10.0f    /* one and a half counts per period */
#define SLOW_s                                                                                     \
    0.5f /* chosen: longer than a heavy load takes to start, shorter than the motor to heat up */
#define AWAY_e_radps 20.0f /* chosen: three counts per period, the noise of a plain difference */
#define FAR_e_radps  50.0f /* chosen: a tenth of the rated speed of the shipped motor */
#define AWAY_s       0.25f /* chosen: an overload of 0.1 s and the recovery from it must not trip */

CTL_PART void motion_watch_reset(motion_watch_t *w)
{
    static const motion_watch_t rest = {.look = MOTION_WATCH_LOOK_STALL};

    *w = rest;
}

static float counted(float so_far_s, bool on, float ts_s)
{
    return on ? (so_far_s + ts_s) : 0.0f;
}

/* EQ-MOTION-WATCH-1 and 4, divided by Lq; a NaN is odd. */
static bool is_odd(const motion_watch_input_t *in)
{
    const motor_reduced_t *m    = in->motor;
    const float            id_A = in->now.id_A;
    const float            iq_A = in->now.iq_A;
    const float            w    = in->now.omega_e_radps;
    const float            i_A  = fabsf(id_A) + fabsf(iq_A); /* at least the length */
    const float            link = m->l6 * in->dc_link_V;
    const float            rest =
        base_max((HALF_OFF * m->l4 * i_A) + (DEAD_TIME * link), DEAD_TIME_ALONE * link);
    const float most = (HALF_OFF * (m->l5 + i_A) * fabsf(w)) + rest;

    const float d_d   = m->l10 * in->d_Aps.d;
    const float taken = (in->d_Aps.q * iq_A) + (d_d * id_A);
    const float shaft = (m->l5 + ((m->l10 - 1.0f) * id_A)) * iq_A * w;

    /* One comparison for both axes: a d_q that is no number is one in `taken`. */
    return !(base_max(fabsf(in->d_Aps.q), fabsf(d_d)) <= most) ||
           !base_within(taken, (POWER_OFF * fabsf(shaft)) + (rest * i_A));
}

/* EQ-MOTION-WATCH-3 */
static bool goes_away(motion_watch_t *w, const motion_watch_input_t *in, bool at_limit, float off)
{
    const float change = in->command_e_radps - w->command_e_radps;

    if (!at_limit || !base_within(change, 1.0f)) {
        w->command_e_radps = in->command_e_radps;
        w->nearest_e_radps = off;
    }
    w->nearest_e_radps = base_min(w->nearest_e_radps, off);
    return (off > FAR_e_radps) && (off > (w->nearest_e_radps + AWAY_e_radps));
}

static motion_watch_verdict_t judge_voltage(motion_watch_t *w, const motion_watch_input_t *in,
                                            float step_s)
{
    w->odd_s = counted(w->odd_s, is_odd(in), step_s);
    return (w->odd_s > ODD_s) ? MOTION_WATCH_ODD : MOTION_WATCH_GOOD;
}

static bool is_at_limit(const motion_watch_input_t *in)
{
    const float i2_A2 = (in->now.id_A * in->now.id_A) + (in->now.iq_A * in->now.iq_A);

    return i2_A2 > (AT_LIMIT2 * in->current_max_A * in->current_max_A);
}

static float off_e_radps(const motion_watch_input_t *in)
{
    return fabsf(in->command_e_radps - in->now.omega_e_radps);
}

static motion_watch_verdict_t judge_stall(motion_watch_t *w, const motion_watch_input_t *in,
                                          float step_s)
{
    const bool pushes  = is_at_limit(in) && (off_e_radps(in) > SLOW_e_radps);
    const bool no_edge = in->edge_gap_s > base_min(w->still_s, GAP_SEEN_s);

    w->still_s = counted(w->still_s, pushes && no_edge, step_s);
    w->slow_s =
        counted(w->slow_s, pushes && base_within(in->now.omega_e_radps, SLOW_e_radps), step_s);
    return ((w->still_s > STILL_s) || (w->slow_s > SLOW_s)) ? MOTION_WATCH_STALL
                                                            : MOTION_WATCH_GOOD;
}

static motion_watch_verdict_t judge_away(motion_watch_t *w, const motion_watch_input_t *in,
                                         float step_s)
{
    w->away_s = counted(w->away_s, goes_away(w, in, is_at_limit(in), off_e_radps(in)), step_s);
    return (w->away_s > AWAY_s) ? MOTION_WATCH_AWAY : MOTION_WATCH_GOOD;
}

CTL_PART motion_watch_verdict_t motion_watch_judge(motion_watch_t             *w,
                                                   const motion_watch_input_t *in)
{
    const float               step_s = MOTION_WATCH_LOOKS * in->ts_s;
    const motion_watch_look_t look   = w->look;

    if (look == MOTION_WATCH_LOOK_VOLTAGE) { /* first: it is the dearest */
        w->look = MOTION_WATCH_LOOK_AWAY;
        return judge_voltage(w, in, step_s);
    }
    if (look == MOTION_WATCH_LOOK_STALL) {
        w->look = MOTION_WATCH_LOOK_VOLTAGE;
        return judge_stall(w, in, step_s);
    }
    if (look == MOTION_WATCH_LOOK_AWAY) {
        w->look = MOTION_WATCH_LOOK_CURRENTS;
        return judge_away(w, in, step_s);
    }
    w->look = MOTION_WATCH_LOOK_STALL;
    return MOTION_WATCH_GOOD;
}
