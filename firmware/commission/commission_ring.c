/* SPDX-License-Identifier: MIT */
#include "commission_ring.h"

#include "commission_current.h"
#include "commission_motion.h"

/* Upper end of the same range; an oscillation has eight periods at least. */
#define TO_Hz     600.0f
#define TO_PER_TS 0.121f
/* Chosen: a damping ratio of 0.02 is 4 % wide. */
#define RATIO       1.05f
#define CLOSER      0.015f
#define CLOSER_HALF 6
/* Chosen: a block is 40 ms at least. Blocks that settle, in four of which the amplitude may
 * change, and blocks that count. 10 blocks are 2.5 time constants of 40 Hz with a damping ratio
 * of 0.02. */
#define BLOCK_s        0.04f
#define SEARCH_SETTLES 3
#define CLOSER_SETTLES 12
#define ADAPTS         4
#define SEARCH_COUNTS  6
#define CLOSER_COUNTS  4
/* Chosen: slow speed, of its bound and of the voltage; largest swing of the speed, of the slow
 * one. */
#define SLOW_SHARE    0.1f
#define VOLTAGE_SHARE 0.1f
/* Chosen: multiples of 0.38 stay away from whole numbers up to the fourth. */
#define COUNTS_PER_TS 0.38f
#define SWING_SHARE   0.7f
/* Chosen: amplitude of the oscillating current: at most, at the first block of a frequency, and
 * least. */
#define MOST_SHARE  0.5f
#define FIRST_SHARE 0.1f
#define LEAST_SHARE 0.002f
/* On a resonance, two cycles swing the motor 2 pi times the ratio of both inertias as far. */
#define FIRST_GAIN 6.0f
/* Chosen: torque of the inertia's oscillation, of the torque at the bound: wanted, and at most. */
#define TORQUE_SHARE 0.5f
#define TORQUE_MOST  2.0f
/* Chosen: amplitudes of the angle. Noise of one block is 0.03 counts, a beat 0.3 at most. */
#define NOISE_CNT 0.1f
#define SEEN_CNT  1.0f
#define LESS      0.25f
/* Chosen: share of the phase voltage for the oscillating current. */
#define DRIVE_VOLTAGE 0.7f
/* Chosen: gains of the speed controller, once a block: slow beside the resonances, and beside
 * friction. */
#define SPEED_GAIN     0.1f
#define SPEED_INTEGRAL 0.01f
#define UP_GAIN        3.0f
#define DC_SHARE       0.3f
#define NEAR_SHARE     0.1f
#define PATIENCE_s     10.0f
/* Chosen: an imaginary part is significant beyond five times its standard deviation. It also has to
 * exceed what errors of J and torque make. More noise than MOST_NOISE hides a resonance. */
#define SIGNIFICANT 5.0f
#define LEAST_PEAK  0.3f
#define MOST_NOISE  0.7f
#define HIDDEN      3
/* Chosen: real parts of y that tell a resonance outside the range: above it the load is not
 * felt, below it more and more. */
#define BELOW_REAL 0.2f
#define ABOVE_REAL -0.4f
#define LAST_SHARE 0.78f
#define FLOOR2     0.01f
/* Chosen: what the closer look must confirm. */
#define MOST_ERROR   0.1f
#define LEAST_LOAD   0.02f
#define MOST_DAMPING 0.5f
#define SURE         0.3f

enum { UP = 0, SEARCH, LOOK_CLOSER, STOP };

static float top_Hz(const commission_config_t *c)
{
    return base_min(TO_Hz, TO_PER_TS / c->ts_s);
}

static float torque_per_A(const commission_config_t *c, const commission_result_t *known)
{
    const dq_t i_A = commission_current_of(known, c->current_max_A, 1.0f);
    return base_max(commission_motion_torque(known, i_A.q, i_A.d * i_A.q) / c->current_max_A,
                    1.0e-12f);
}

/* Slow mechanical speed, by its bound and the voltage. The steps of the count then alternate fast.
 * A whole number of counts in a period would beat within the range of the search. */
static float slow_speed(const commission_config_t *c, const commission_signal_t *s,
                        const commission_result_t *known)
{
    const float psi_Wb  = base_max(known->flux_Wb.value, known->lq_H.value * c->current_max_A);
    const float e_radps = VOLTAGE_SHARE * s->dc_link_V / base_max(psi_Wb, 1.0e-9f);
    const float most    = base_min(SLOW_SHARE * c->speed_max_m_radps,
                                   e_radps / base_max((float)known->pole_pairs, 1.0f));
    const float per_cnt = BASE_TWO_PI / (base_max((float)known->counts_per_turn, 1.0f) * c->ts_s);
    const float counts  = base_clamp((most / per_cnt) - COUNTS_PER_TS, 0.0f, 1.0e6f);
    return base_min(most, ((float)(int32_t)counts + COUNTS_PER_TS) * per_cnt);
}

static void begin_block(commission_ring_t *r, const commission_config_t *c)
{
    commission_block_start(&r->block, c->ts_s, r->wanted_Hz, BLOCK_s);
}

/* Amplitude of the first block at a frequency: even on a resonance its speed stays within the
 * swing. */
static float first_A(const commission_ring_t *r, const commission_config_t *c,
                     const commission_result_t *known)
{
    const float rigid_A = SWING_SHARE * r->slow_m_radps * known->inertia_kgm2.value * BASE_TWO_PI *
                          r->wanted_Hz / torque_per_A(c, known);
    return base_min(FIRST_SHARE * c->current_max_A, rigid_A / FIRST_GAIN);
}

static void begin_step(commission_ring_t *r, const commission_config_t *c,
                       const commission_result_t *known)
{
    const commission_ring_mean_t none = {.n = 0};

    r->mean    = none;
    r->blocks  = 0;
    r->swing_A = base_min(r->swing_A, first_A(r, c, known));
    begin_block(r, c);
}

static void begin_part(commission_ring_t *r, const commission_config_t *c,
                       const commission_result_t *known, int16_t part, float wanted_Hz)
{
    r->part      = part;
    r->step      = 0;
    r->ticks     = 0L;
    r->wanted_Hz = wanted_Hz;
    r->swing_A =
        ((part == SEARCH) || (part == LOOK_CLOSER)) ? FIRST_SHARE * c->current_max_A : 0.0f;
    begin_step(r, c, known);
}

void commission_ring_start(commission_ring_t *r, const commission_config_t *c,
                           const commission_signal_t *s, const commission_result_t *known)
{
    const commission_ring_t fresh = {.last_cnt     = s->position_cnt,
                                     .slow_m_radps = slow_speed(c, s, known)};

    *r = fresh;
    commission_angle_start(&r->angle, commission_angle_rad(known, s->position_cnt));
    begin_part(r, c, known, UP, COMMISSION_RING_FROM_Hz);
}

/* Once a block: the current that keeps the speed. Within a block it is constant, and disturbs no
 * answer. */
static void keep_speed(commission_ring_t *r, const commission_config_t *c,
                       const commission_result_t *known, float mean_m_radps)
{
    const float time_s  = (float)r->block.samples * c->ts_s;
    const float most_A  = DC_SHARE * c->current_max_A;
    const float per     = known->inertia_kgm2.value / (time_s * torque_per_A(c, known));
    const float wanted  = (r->part == STOP) ? 0.0f : r->slow_m_radps;
    const float error_A = per * (wanted - mean_m_radps);
    const float drag_Nm = known->coulomb_Nm.value + (known->friction_Nms.value * wanted);
    const float drag_A  = (r->part == STOP) ? 0.0f : (drag_Nm / torque_per_A(c, known));
    const float more    = (r->part == UP) ? UP_GAIN : 1.0f;

    r->held_A = base_clamp(r->held_A + (more * SPEED_INTEGRAL * error_A), -most_A, most_A);
    r->dc_A   = base_clamp(drag_A + r->held_A + (more * SPEED_GAIN * error_A), -most_A, most_A);
}

/* Amplitude for the next block, from the answer to the present one. */
static void adapt(commission_ring_t *r, const commission_config_t *c, const commission_signal_t *s,
                  const commission_result_t *known, const commission_response_t *a)
{
    const float torque_Nm = TORQUE_SHARE * torque_per_A(c, known) * c->current_max_A;
    const float loop_Ohm  = COMMISSION_CURRENT_BANDWIDTH * known->lq_H.value / c->ts_s;
    const float drive_A = DRIVE_VOLTAGE * BASE_1_SQRT3 * s->dc_link_V / base_max(loop_Ohm, 1.0e-9f);
    const float seen_Nm =
        a->j_Nm * base_max(1.0f - (NOISE_CNT / base_max(a->cnt, NOISE_CNT)), 0.0f);
    const float by_torque = torque_Nm / base_max(seen_Nm, 1.0e-12f);
    const float by_speed  = SWING_SHARE * r->slow_m_radps / base_max(a->m_radps, 1.0e-12f);

    r->swing_A =
        base_clamp(r->swing_A * base_min(by_torque, by_speed), LEAST_SHARE * c->current_max_A,
                   base_min(MOST_SHARE * c->current_max_A, drive_A));
}

/* Adds a block to the mean of its frequency. */
static void add_answer(commission_ring_mean_t *m, commission_phasor_t y)
{
    m->sum.re += y.re;
    m->sum.im += y.im;
    m->squares += (y.re * y.re) + (y.im * y.im);
    m->n++;
}

/* Variance of the mean, both parts together. */
static float variance_of(const commission_ring_mean_t *m, commission_phasor_t y)
{
    const float n    = (float)m->n;
    const float rest = (m->squares / n) - ((y.re * y.re) + (y.im * y.im));
    return base_max(rest, 0.0f) / (n - 1.0f);
}

/* A frequency of the search has its answer. */
static void note(commission_ring_seen_t *seen, float hz, float top, commission_phasor_t y,
                 float variance)
{
    const float length2 = ((y.re + 1.0f) * (y.re + 1.0f)) + (y.im * y.im);
    const float most    = MOST_NOISE * MOST_NOISE * base_max(length2, 1.0f);
    const float weight  = 1.0f / (variance + FLOOR2);
    const bool  shows =
        (y.im > LEAST_PEAK) && ((y.im * y.im) > (SIGNIFICANT * SIGNIFICANT * 0.5f * variance));

    if (shows && (y.im > seen->peak)) {
        seen->peak    = y.im;
        seen->peak_Hz = hz;
    }
    seen->all += weight * y.re;
    seen->all_w += weight;
    if (hz > (LAST_SHARE * top)) {
        seen->last += weight * y.re;
        seen->last_w += weight;
    }
    if (variance < most) {
        seen->hidden = 0;
    } else {
        seen->hidden++;
    }
    if (seen->hidden == 0) {
        seen->clear_Hz = hz;
    }
}

static void clear_values(commission_result_t *found)
{
    const commission_value_t none = {0.0f, 0.0f};
    found->resonance_Hz           = none;
    found->damping                = none;
    found->load_share             = none;
}

/* Without a peak, or with one that is none: what the real parts say. */
static commission_coupling_t without_peak(const commission_ring_seen_t *seen)
{
    if ((seen->all_w > 0.0f) && (seen->all > (BELOW_REAL * seen->all_w))) {
        return COMMISSION_COUPLING_BELOW;
    }
    if ((seen->last_w > 0.0f) && (seen->last < (ABOVE_REAL * seen->last_w))) {
        return COMMISSION_COUPLING_ABOVE;
    }
    return (seen->clear_Hz > 0.0f) ? COMMISSION_COUPLING_RIGID : COMMISSION_COUPLING_UNKNOWN;
}

/* The closer look has ended. */
static commission_coupling_t judge(const commission_ring_t *r, const commission_config_t *c,
                                   commission_result_t *found)
{
    if (!commission_ring_fit_solve(&r->fit, found)) {
        return without_peak(&r->seen);
    }
    const float hz = found->resonance_Hz.value;
    if (hz < COMMISSION_RING_FROM_Hz) {
        return COMMISSION_COUPLING_BELOW;
    }
    if (hz > top_Hz(c)) {
        return COMMISSION_COUPLING_ABOVE;
    }
    const bool sure =
        (found->resonance_Hz.error < (MOST_ERROR * hz)) && (found->load_share.value > LEAST_LOAD) &&
        (found->load_share.error < (SURE * found->load_share.value)) &&
        (found->damping.error < (SURE * found->damping.value)) &&
        (found->damping.value < MOST_DAMPING) && base_within(hz - r->fit.at_Hz, MOST_ERROR * hz);
    return sure ? COMMISSION_COUPLING_ELASTIC : without_peak(&r->seen);
}

static void conclude(commission_ring_t *r, const commission_config_t *c, commission_result_t *found,
                     commission_coupling_t coupling)
{
    found->coupling    = coupling;
    found->searched_Hz = r->seen.clear_Hz;
    if (coupling != COMMISSION_COUPLING_ELASTIC) {
        clear_values(found);
    }
    begin_part(r, c, found, STOP, COMMISSION_RING_FROM_Hz);
}

/* The search continues, or knows where to look closer. */
static void search_on(commission_ring_t *r, const commission_config_t *c,
                      commission_result_t *found)
{
    const float top = top_Hz(c);

    if ((r->wanted_Hz < top) && (r->seen.hidden < HIDDEN)) {
        r->wanted_Hz = base_min(RATIO * r->wanted_Hz, top);
        begin_step(r, c, found);
    } else if (r->seen.peak_Hz > 0.0f) {
        commission_ring_fit_start(&r->fit, r->seen.peak_Hz);
        begin_part(r, c, found, LOOK_CLOSER,
                   r->seen.peak_Hz * (1.0f - (CLOSER * (float)CLOSER_HALF)));
    } else {
        conclude(r, c, found, without_peak(&r->seen));
    }
}

/* The answers at a frequency are complete. */
static void end_step(commission_ring_t *r, const commission_config_t *c, commission_result_t *found)
{
    const float               hz = commission_block_Hz(&r->block, c->ts_s);
    const float               n  = (float)r->mean.n;
    const commission_phasor_t y  = {r->mean.sum.re / n, r->mean.sum.im / n};

    r->step++;
    if (r->part == SEARCH) {
        note(&r->seen, hz, top_Hz(c), y, variance_of(&r->mean, y));
        search_on(r, c, found);
        return;
    }
    commission_ring_fit_add(&r->fit, hz, y);
    if (r->step > (2 * CLOSER_HALF)) {
        conclude(r, c, found, judge(r, c, found));
    } else {
        r->wanted_Hz = r->seen.peak_Hz * (1.0f + (CLOSER * (float)(r->step - CLOSER_HALF)));
        begin_step(r, c, found);
    }
}

/* A block with an oscillating current has ended. */
static commission_step_t end_block(commission_ring_t *r, const commission_config_t *c,
                                   const commission_signal_t *s, commission_result_t *found)
{
    const commission_response_t a       = commission_block_response(&r->block, c, found);
    const bool                  search  = r->part == SEARCH;
    const int16_t               settles = search ? SEARCH_SETTLES : CLOSER_SETTLES;
    const int16_t               counts  = search ? SEARCH_COUNTS : CLOSER_COUNTS;

    if ((a.cnt > SEEN_CNT) &&
        (a.j_Nm > (TORQUE_MOST * torque_per_A(c, found) * c->current_max_A))) {
        r->rings = r->swing_A < (LEAST_SHARE * c->current_max_A);
        r->swing_A *= LESS;
        begin_step(r, c, found);
        return r->rings ? COMMISSION_FAILED : COMMISSION_BUSY;
    }
    if (r->blocks >= settles) {
        add_answer(&r->mean, a.y);
    } else if (r->blocks < ADAPTS) {
        adapt(r, c, s, found, &a);
    } else {
        /* it settles */
    }
    r->blocks++;
    if (r->mean.n >= counts) {
        end_step(r, c, found);
    } else {
        begin_block(r, c);
    }
    return COMMISSION_BUSY;
}

/* A block without: the shaft comes to its slow speed, or to rest. */
static commission_step_t end_quiet(commission_ring_t *r, const commission_config_t *c,
                                   const commission_result_t *known, float mean_m_radps)
{
    const float wanted = (r->part == STOP) ? 0.0f : r->slow_m_radps;
    const bool  there  = base_within(mean_m_radps - wanted, NEAR_SHARE * r->slow_m_radps);
    const bool  late   = r->ticks > commission_ticks(PATIENCE_s, c->ts_s);

    if (r->part == STOP) {
        begin_block(r, c);
        return (there || late) ? COMMISSION_DONE : COMMISSION_BUSY;
    }
    if (there) {
        begin_part(r, c, known, SEARCH, COMMISSION_RING_FROM_Hz);
    } else {
        begin_block(r, c);
    }
    return (late && !there) ? COMMISSION_FAILED : COMMISSION_BUSY;
}

/* The block is whole. */
static commission_step_t next_block(commission_ring_t *r, const commission_config_t *c,
                                    const commission_signal_t *s, commission_result_t *found)
{
    const float per    = (float)found->direction * BASE_TWO_PI / (float)found->counts_per_turn;
    const float time_s = (float)r->block.samples * c->ts_s;
    const float mean   = per * (float)r->block.turned_cnt / time_s;

    keep_speed(r, c, found, mean);
    return ((r->part == SEARCH) || (r->part == LOOK_CLOSER)) ? end_block(r, c, s, found)
                                                             : end_quiet(r, c, found, mean);
}

/* Reference of the currents: a reluctance motor keeps its d current, so that the torque follows
 * iq. */
static dq_t wanted_A(const commission_ring_t *r, const commission_config_t *c,
                     const commission_result_t *known)
{
    const float iq_A   = r->dc_A + (r->swing_A * commission_block_wave(&r->block));
    const dq_t  wanted = {known->reluctance ? -MOST_SHARE * c->current_max_A : 0.0f, iq_A};
    return wanted;
}

commission_answer_t commission_ring_tick(commission_ring_t *r, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found)
{
    commission_answer_t  answer = commission_rest(COMMISSION_BUSY);
    const float          theta  = commission_angle_rad(found, s->position_cnt);
    const float          w      = commission_angle_tick(&r->angle, theta, c->ts_s);
    const frames_angle_t then   = frames_angle(theta + (1.5f * w * c->ts_s));
    const dq_t           i_A    = frames_park(s->i_A, frames_angle(theta));
    const int32_t        step   = commission_moved_cnt(s->position_cnt, r->last_cnt);

    if (!(top_Hz(c) > (RATIO * COMMISSION_RING_FROM_Hz)) || !(found->inertia_kgm2.value > 0.0f)) {
        found->coupling = COMMISSION_COUPLING_UNKNOWN;
        answer.step     = COMMISSION_DONE;
        return answer;
    }
    r->last_cnt = s->position_cnt;
    r->ticks++;
    if (commission_block_add(&r->block, step,
                             commission_motion_torque(found, i_A.q, i_A.d * i_A.q))) {
        answer.step = next_block(r, c, s, found);
    }
    const commission_current_t loop = {i_A, wanted_A(r, c, found), w, 0.5f * s->dc_link_V};
    const dq_t                 v_V  = commission_current_V(&r->integral_V, c, found, &loop);
    answer.v_V                      = frames_inverse_park(v_V, then);
    answer.i_A                      = frames_inverse_park(loop.ref_A, then);
    return answer;
}
