/* SPDX-License-Identifier: MIT */
#include "commission_vector.h"

#define BANDWIDTH_PER_TS 0.2f
#define INTEGRAL_SHARE   0.05f
/* Chosen: limit of the integral; a winding at standstill needs less. */
#define MOST_SHARE 0.5f
/* Chosen: share of the current limit. With a vector of 0.6, the sum uses two thirds of the
 * limit. */
#define CROSS_SHARE 0.3f
/* Without a limit. */
#define DAMP_MOST_V 1.0e6f
/* Chosen: a rotor that snaps into place takes more voltage for a shorter time. */
#define MEAN_s 0.05f
/* Chosen: a shaft that stays within a count for STAND_s induces nothing; the mean is shorter. */
#define STAND_s 0.05f
#define BRISK_s 0.02f
/* Chosen: shares of the limit that make the probe ask the sensors, and their mean of 16 periods. */
#define STRAY_SHARE 0.02f
#define CROSS_STRAY 0.12f
#define QUICK       0.0625f
/* Chosen: counts back from the extreme position that are a reversal; edge errors are smaller. */
#define REVERSAL_CNT 6L

void commission_vector_start(commission_vector_t *v, const commission_config_t *c,
                             const commission_result_t *known, float ramp_s)
{
    const float         w_radps = BANDWIDTH_PER_TS / c->ts_s;
    const float         kp      = w_radps * known->ld_H.value;
    commission_vector_t fresh   = {.ts_s   = c->ts_s,
                                   .kp_VpA = kp,
                                   .ki_VpA = INTEGRAL_SHARE * w_radps * kp * c->ts_s,
                                   .lq_H   = known->lq_H.value,
                                   .r_Ohm  = known->r_Ohm.value,
                                   .ramp_A = c->current_max_A * c->ts_s / ramp_s};
    fresh.cross_max_A           = CROSS_SHARE * c->current_max_A;
    fresh.half_swing_s          = known->half_swing_s;
    fresh.error_max_A           = c->current_max_A;
    fresh.damp_max_V            = DAMP_MOST_V;
    fresh.behind_share          = 1.0f;
    fresh.mean_share            = base_min(c->ts_s / MEAN_s, 1.0f);
    fresh.brisk_share           = base_min(c->ts_s / BRISK_s, 1.0f);
    fresh.stray_A.d             = STRAY_SHARE * c->current_max_A;
    fresh.stray_A.q             = CROSS_STRAY * c->current_max_A;
    *v                          = fresh;
}

void commission_vector_allow(commission_vector_t *v, float error_A, float damp_V, float follow_s)
{
    v->error_max_A  = error_A;
    v->damp_max_V   = damp_V;
    v->behind_share = base_min(v->ts_s / follow_s, 1.0f);
}

static void watch_shaft(commission_vector_t *v, int32_t position_cnt)
{
    const int32_t moved = commission_moved_cnt(position_cnt, v->still_cnt);

    if ((moved > 1L) || (moved < -1L)) {
        v->still_cnt   = position_cnt;
        v->still_ticks = 0L;
    } else if (v->still_ticks < INT32_MAX) {
        v->still_ticks++;
    }

    const int32_t beyond = commission_moved_cnt(position_cnt, v->extreme_cnt);
    if (v->swing_ticks < INT32_MAX) {
        v->swing_ticks++;
    }
    if (v->way == 0) {
        v->way         = (beyond > REVERSAL_CNT) ? 1 : ((beyond < -REVERSAL_CNT) ? -1 : 0);
        v->swing_ticks = 0L;
    } else if (((v->way > 0) && (beyond > 0L)) || ((v->way < 0) && (beyond < 0L))) {
        v->extreme_cnt = position_cnt;
    } else if ((beyond > REVERSAL_CNT) || (beyond < -REVERSAL_CNT)) {
        v->half_swing_s = (float)v->swing_ticks * v->ts_s;
        v->way          = (v->way > 0) ? -1 : 1;
        v->extreme_cnt  = position_cnt;
        v->swing_ticks  = 0L;
    } else {
        /* not yet a reversal */
    }
}

/* Added resistance: the sum equals the reactance at the oscillation frequency. */
static float damping_Ohm(const commission_vector_t *v)
{
    if (!(v->half_swing_s > 0.0f)) {
        return 0.0f;
    }
    const float wanted = BASE_PI * v->lq_H / v->half_swing_s;
    return base_clamp(wanted - v->r_Ohm, 0.0f, v->kp_VpA);
}

commission_vector_out_t commission_vector_tick(commission_vector_t *v, const commission_signal_t *s,
                                               float theta_rad, float turned_rad, float length_A)
{
    const frames_angle_t    now    = frames_angle(theta_rad);
    const frames_angle_t    then   = frames_angle(theta_rad + turned_rad);
    const float             most_V = MOST_SHARE * s->dc_link_V;
    commission_vector_out_t out    = {.i_A = frames_park(s->i_A, now),
                                      .v_V = frames_park(s->v_V, now)};

    watch_shaft(v, s->position_cnt);
    v->length_A = base_clamp(length_A, v->length_A - v->ramp_A, v->length_A + v->ramp_A);

    const float behind_A = v->length_A - out.i_A.d;
    const float error_A  = base_clamp(behind_A, -v->error_max_A, v->error_max_A);
    v->behind_A += v->behind_share * (behind_A - v->behind_A);
    v->quick_A.d += QUICK * (behind_A - v->quick_A.d);
    v->quick_A.q += QUICK * (out.i_A.q - v->quick_A.q);
    v->mean_V += v->mean_share * (out.v_V.d - v->mean_V);
    v->cross_A += v->mean_share * (out.i_A.q - v->cross_A);
    v->brisk_V += v->brisk_share * (out.v_V.d - v->brisk_V);
    v->integral_V        = base_clamp(v->integral_V + (v->ki_VpA * error_A), -most_V, most_V);
    const float beyond_A = out.i_A.q - base_clamp(out.i_A.q, -v->cross_max_A, v->cross_max_A);
    const float over_A   = base_clamp(beyond_A, -v->error_max_A, v->error_max_A);
    const float damp_V   = damping_Ohm(v) * out.i_A.q;
    const dq_t  v_V      = {/* EQ-COMMISSION-3 */
                      v->integral_V + (v->kp_VpA * error_A),
                      -base_clamp(damp_V, -v->damp_max_V, v->damp_max_V) - (v->kp_VpA * over_A)};
    out.out_V            = frames_inverse_park(v_V, then);
    out.length_A         = v->length_A;
    return out;
}

bool commission_vector_still(const commission_vector_t *v, float time_s)
{
    return ((float)v->still_ticks * v->ts_s) >= time_s;
}

bool commission_vector_follows(const commission_vector_t *v, float most_A, float most_V)
{
    return base_within(v->behind_A, most_A) && base_within(v->mean_V, most_V);
}

bool commission_vector_stands(const commission_vector_t *v, float most_V)
{
    return !commission_vector_still(v, STAND_s) || base_within(v->brisk_V, most_V);
}

bool commission_vector_strays(const commission_vector_t *v)
{
    return !base_within(v->quick_A.d, v->stray_A.d) || !base_within(v->quick_A.q, v->stray_A.q);
}
