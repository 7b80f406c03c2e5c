/* SPDX-License-Identifier: MIT */
#include "commission_resistance.h"

/* Chosen: shares of the current limit. */
#define PULL_SHARE  0.05f
#define LEVEL_SHARE 0.125f
#define LEVELS      4
/* Chosen: times. A mean covers many periods of noise. The shaft has a few seconds to come to rest.
 * After that the measurement goes on: the voltage induced by an oscillating magnet averages to
 * zero. */
#define RAMP_s      0.5f
#define STILL_s     0.2f
#define PATIENCE_s  12.0f
#define SETTLE_s    0.25f
#define MEAN_s      0.1f
#define LONG_MEAN_s 2.0f
/* Chosen: pulses that ask the sensors end with the settling; the loop has forgotten them after it.
 * With a quarter of it R was off by 0.6 % (syrm_6k7), and with none by 6 %. */
#define QUIET_s 0.08f
/* Chosen: limits of the mean voltage at the first angle, twice the largest of ten healthy motors.
 * PULL: to the voltage of LOOK. LEVEL: voltage per ampere, to that of a smaller current. The
 * inverter's loss makes this ratio smaller, and a rotor that snaps into place makes it larger. */
#define PULL_RATIO  3.0f
#define FIRST_RATIO 1.3f
#define LEVEL_RATIO 2.0f
/* Chosen: voltage above the first angle's line, share of that of R at the limit; healthy 0.32. */
#define KNOWN_SHARE 0.5f
/* Chosen: the same above the line of the two levels before, a rotor may snap; healthy 0.76. */
#define RISING_SHARE 0.9f
/* Chosen: the same of a shaft that stands, 1.5 times the largest of eleven healthy motors. PULL and
 * FIRST are ratios. Later levels have a line: share of the limit, whose R it is above the line. */
#define STAND_PULL  1.65f
#define STAND_FIRST 1.2f
#define STAND_SHARE 0.35f
/* Chosen: mean current across the vector, share of the limit: no voltage holds it there. At the
 * larger levels of the first angle a rotor may snap; healthy 0.18 there and 0.08 elsewhere. */
#define ACROSS_SHARE      0.13f
#define SNAP_ACROSS_SHARE 0.22f
/* Chosen: voltage against the current, in that of LOOK; healthy 0.09. */
#define AGAINST_RATIO 0.3f
/* Levels are farther apart. */
#define LEAST_STEP_A 1.0e-6f
/* Chosen: share of the limit that the loop acts on. */
#define ERROR_SHARE 0.04f
/* Chosen: mean distance of the current to its reference, share of the limit, and its time. At the
 * larger levels of the first angle a rotor may snap; healthy 0.09 there and 0.028 elsewhere. */
#define FOLLOW_s     0.02f
#define BEHIND_SHARE 0.045f
#define SNAP_SHARE   0.15f

void commission_resistance_start(commission_resistance_t *r, const commission_config_t *c,
                                 const commission_result_t *known)
{
    commission_resistance_t fresh = {.level = -1};
    *r                            = fresh;
    r->before_V                   = known->odd_V;
    commission_vector_start(&r->vector, c, known, RAMP_s);
    commission_vector_allow(&r->vector, ERROR_SHARE * c->current_max_A, known->odd_V, FOLLOW_s);
    commission_fit_reset(&r->line);
}

static void next_level(commission_resistance_t *r)
{
    if (r->before_A > 0.0f) {
        r->slope_Ohm = (r->vector.mean_V - r->before_V) /
                       base_max(r->vector.length_A - r->before_A, LEAST_STEP_A);
    }
    r->before_V = base_max(r->before_V, r->vector.mean_V);
    r->before_A = r->vector.length_A;
    r->level++;
    r->ticks      = 0L;
    r->mean_ticks = 0L;
    r->sums       = 0L;
    r->sum_v_V    = 0.0f;
    r->sum_i_A    = 0.0f;
    if (r->level >= LEVELS) {
        r->lines[r->angle] = commission_fit_solve(&r->line);
        commission_fit_reset(&r->line);
        r->level = -1;
        r->angle++;
    }
}

static void add_to_mean(commission_resistance_t *r, const commission_vector_out_t *out)
{
    r->sum_v_V += out->v_V.d;
    r->sum_i_A += out->i_A.d;
    r->sums++;
    if (r->sums >= r->mean_ticks) {
        const float per = 1.0f / (float)r->sums;
        commission_fit_add(&r->line, r->sum_i_A * per, 1.0f, r->sum_v_V * per);
        next_level(r);
    }
}

static bool set_result(const commission_resistance_t *r, commission_result_t *found)
{
    float sum   = 0.0f;
    float sum2  = 0.0f;
    float cross = 0.0f;
    float worst = 0.0f;
    for (int16_t k = 0; k < COMMISSION_ANGLES; k++) {
        if (!r->lines[k].valid) {
            return false;
        }
        sum += r->lines[k].x0;
        cross += r->lines[k].x1;
        worst = base_max(worst, r->lines[k].error0);
    }
    const float per  = 1.0f / (float)COMMISSION_ANGLES;
    const float mean = sum * per;
    for (int16_t k = 0; k < COMMISSION_ANGLES; k++) {
        sum2 += (r->lines[k].x0 - mean) * (r->lines[k].x0 - mean);
    }
    found->r_Ohm.value    = mean;
    found->r_Ohm.error    = (2.0f * sqrtf(0.5f * sum2 * per)) + worst;
    found->v_loss_V.value = base_max(0.75f * cross * per, 0.0f); /* EQ-COMMISSION-8 */
    found->v_loss_V.error = 0.75f * r->lines[0].error1;
    found->half_swing_s   = r->half_swing_s;
    return mean > 0.0f;
}

/* Largest mean voltage along the vector of a healthy motor. */
static float healthy_most_V(const commission_resistance_t *r, const commission_config_t *c,
                            const commission_result_t *known)
{
    const commission_fitted_t *line   = &r->lines[0];
    const float                ratio  = (r->level == 0) ? FIRST_RATIO : LEVEL_RATIO;
    const float                next_A = c->current_max_A * LEVEL_SHARE * (float)(r->level + 1);
    float                      most_V = PULL_RATIO * known->odd_V;

    if (r->angle > 0) {
        const float most_A = r->vector.length_A + (KNOWN_SHARE * c->current_max_A);
        most_V             = (line->x0 * most_A) + base_max(line->x1, 0.0f);
    } else if (r->level >= 0) {
        const float rise_A = (r->vector.length_A - r->before_A) + (RISING_SHARE * c->current_max_A);
        const float line_V = r->before_V + (r->slope_Ohm * rise_A);
        const float most   = ratio * r->before_V * next_A / base_max(r->before_A, LEAST_STEP_A);
        most_V = ((r->level > 0) && (r->slope_Ohm > 0.0f)) ? base_min(most, line_V) : most;
    } else {
        /* the rotor aligns */
    }
    return most_V;
}

/* The same while the shaft stands. */
static float standing_most_V(const commission_resistance_t *r, const commission_config_t *c,
                             const commission_result_t *known)
{
    const commission_fitted_t *line   = &r->lines[0];
    const float                i_A    = r->vector.length_A;
    const float                over_A = STAND_SHARE * c->current_max_A;
    const float                far    = base_max(i_A / base_max(r->before_A, LEAST_STEP_A), 1.0f);
    float                      most_V = STAND_PULL * known->odd_V;

    if (r->angle > 0) {
        most_V = (line->x0 * (i_A + over_A)) + base_max(line->x1, 0.0f);
    } else if ((r->level > 0) && (r->slope_Ohm > 0.0f)) {
        most_V = r->before_V + (r->slope_Ohm * ((i_A - r->before_A) + over_A));
    } else if (r->level >= 0) {
        most_V = STAND_FIRST * r->before_V * far;
    } else {
        /* the rotor aligns */
    }
    return most_V;
}

bool commission_resistance_follows(const commission_resistance_t *r, const commission_config_t *c,
                                   const commission_result_t *known)
{
    const bool  done     = r->angle >= COMMISSION_ANGLES; /* the results are next */
    const bool  snaps    = (r->angle == 0) && (r->level > 0);
    const float share    = snaps ? SNAP_SHARE : BEHIND_SHARE;
    const float across_A = c->current_max_A * (snaps ? SNAP_ACROSS_SHARE : ACROSS_SHARE);
    return done || (base_within(r->vector.cross_A, across_A) &&
                    (r->vector.mean_V >= (-AGAINST_RATIO * known->odd_V)) &&
                    commission_vector_follows(&r->vector, share * c->current_max_A,
                                              healthy_most_V(r, c, known)) &&
                    commission_vector_stands(&r->vector, standing_most_V(r, c, known)));
}

commission_answer_t commission_resistance_tick(commission_resistance_t   *r,
                                               const commission_config_t *c,
                                               const commission_signal_t *s,
                                               commission_result_t       *found)
{
    if (r->angle >= COMMISSION_ANGLES) {
        return commission_rest(set_result(r, found) ? COMMISSION_DONE : COMMISSION_FAILED);
    }
    const bool  pulls = r->level < 0;
    const float length_A =
        c->current_max_A * (pulls ? PULL_SHARE : (LEVEL_SHARE * (float)(r->level + 1)));
    const float theta = frames_wrap(BASE_TWO_PI * (float)r->at_angle / (float)COMMISSION_ANGLES);
    const commission_vector_out_t out =
        commission_vector_tick(&r->vector, s, theta, 0.0f, length_A);
    const bool ramped = fabsf(out.length_A - length_A) <= (0.01f * length_A);

    if (ramped && (r->at_angle != r->angle)) {
        r->at_angle = r->angle; /* the vector turns at a small current only */
        r->ticks    = 0L;
    } else if (ramped) {
        r->ticks++;
    } else {
        /* the current ramps to the level */
    }
    const bool still = commission_vector_still(&r->vector, STILL_s);
    const bool late  = r->ticks > commission_ticks(PATIENCE_s, c->ts_s);
    if (pulls) {
        r->half_swing_s = r->vector.half_swing_s;
    }
    if (r->mean_ticks > 0L) {
        if (r->ticks > commission_ticks(QUIET_s, c->ts_s)) {
            add_to_mean(r, &out);
        }
    } else if ((r->ticks > commission_ticks(SETTLE_s, c->ts_s)) && (still || late)) {
        if (pulls) {
            next_level(r);
        } else {
            r->mean_ticks = commission_ticks(still ? MEAN_s : LONG_MEAN_s, c->ts_s);
            r->ticks      = 0L;
        }
    } else {
        /* current and rotor settle */
    }
    commission_answer_t answer = commission_rest(COMMISSION_BUSY);
    answer.v_V                 = out.out_V;
    return answer;
}
