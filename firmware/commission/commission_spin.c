/* SPDX-License-Identifier: MIT */
#include "commission_spin.h"

#include "commission_current.h"

/* Chosen: shares of the current limit. */
#define TRY_SHARE   0.1f
#define USUAL_SHARE 0.3f
#define MOST_SHARE  0.6f
#define LEAST_SHARE 0.05f
/* Chosen: the trial ends after two electrical turns or after TRY_s. */
#define TRY_TURNS      2.0f
#define LEAST_TURNS    0.25f
#define TRY_s          1.5f
#define REST_s         0.2f
#define PATIENCE_s     5.0f
#define STANDING_radps 3.0f
/* Chosen: largest speed, as shares of the speed limit and of the voltage limit. */
#define SPEED_SHARE   0.85f
#define VOLTAGE_SHARE 0.55f
/* Chosen: duration of an acceleration within the limits; long beside the rise time of the
 * current. */
#define QUICKEST_s 0.3f
#define SLOWEST_s  2.5f
/* Chosen: coasting ends below this share of its initial speed, or after the time limit. */
#define COAST_SHARE   0.4f
#define COAST_PER_WAY 6.0f
#define COAST_s       8.0f
#define LOW_SHARE     0.3f
#define DRIVE_WINDOWS 10
#define COAST_WINDOWS 8
/* Periods in which a current with bandwidth w_c settles, with ample margin. */
#define SETTLE_TICKS 60L

enum { REST = 0, TRIAL, UP, COAST_UP, DOWN, COAST_DOWN, LOW, COAST_LOW, STOP, SOLVE, SOLVED };

void commission_spin_start(commission_spin_t *p, const commission_config_t *c,
                           const commission_signal_t *s, const commission_result_t *known)
{
    const commission_emf_t none = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const dq_t             zero = {0.0f, 0.0f};

    commission_angle_start(&p->angle, commission_angle_rad(known, s->position_cnt));
    commission_motion_start(&p->motion);
    p->emf[0]       = none;
    p->emf[1]       = none;
    p->integral_V   = zero;
    p->part         = REST;
    p->ticks        = 0L;
    p->start_cnt    = s->position_cnt;
    p->coast_ticks  = 0L;
    p->window_ticks = 0L;
    p->current_A    = TRY_SHARE * c->current_max_A;
    p->top_radps    = 0.0f;
    p->begun_radps  = 0.0f;
}

static bool coasts(const commission_spin_t *p)
{
    return (p->part == COAST_UP) || (p->part == COAST_DOWN) || (p->part == COAST_LOW);
}

static dq_t wanted_A(const commission_spin_t *p, const commission_result_t *known)
{
    const dq_t none = {0.0f, 0.0f};

    const float w = p->angle.omega_e_radps;

    switch (p->part) {
    case REST:
        return base_within(w, STANDING_radps)
                   ? none
                   : commission_current_of(known, p->current_A, (w > 0.0f) ? -1.0f : 1.0f);
    case TRIAL:
    case UP:
    case LOW:
        return commission_current_of(known, p->current_A, 1.0f);
    case DOWN:
        return commission_current_of(known, p->current_A, -1.0f);
    case STOP:
        return commission_current_of(known, p->current_A, (p->begun_radps > 0.0f) ? -1.0f : 1.0f);
    default:
        return none;
    }
}

/* Largest electrical speed at a current, by the speed limit and the dc link. */
static float top_speed(const commission_config_t *c, const commission_result_t *known,
                       float dc_link_V, float size_A)
{
    const dq_t  i_A   = commission_current_of(known, size_A, 1.0f);
    const float psi_d = known->flux_Wb.value + (known->ld_H.value * i_A.d);
    const float psi_q = known->lq_H.value * i_A.q;
    const float psi   = sqrtf((psi_d * psi_d) + (psi_q * psi_q));
    const float v_V   = (VOLTAGE_SHARE * dc_link_V * BASE_1_SQRT3) - (known->r_Ohm.value * size_A);
    const float bound = SPEED_SHARE * c->speed_max_m_radps * (float)known->pole_pairs;
    return base_min(bound, base_max(v_V, 0.0f) / base_max(psi, 1.0e-9f));
}

static float torque_of(const commission_result_t *known, float size_A)
{
    const dq_t i_A = commission_current_of(known, size_A, 1.0f);
    return commission_motion_torque(known, i_A.q, i_A.d * i_A.q);
}

/* Plans current, speed and times of the run from the acceleration of the trial. */
static void plan(commission_spin_t *p, const commission_config_t *c, const commission_signal_t *s,
                 const commission_result_t *known, float accel_radps2)
{
    const float per_Nm = accel_radps2 / base_max(torque_of(known, p->current_A), 1.0e-12f);
    float       size_A = USUAL_SHARE * c->current_max_A;
    float       top    = top_speed(c, known, s->dc_link_V, size_A);
    float       way_s  = top / (per_Nm * torque_of(known, size_A));

    if (way_s < QUICKEST_s) {
        const float less = way_s / QUICKEST_s;
        size_A *= known->reluctance ? sqrtf(less) : less;
        size_A = base_max(size_A, LEAST_SHARE * c->current_max_A);
    } else if (way_s > SLOWEST_s) {
        size_A = MOST_SHARE * c->current_max_A;
    } else {
        /* the plan stays */
    }
    const float accel = per_Nm * torque_of(known, size_A);
    top               = base_min(top_speed(c, known, s->dc_link_V, size_A), SLOWEST_s * accel);
    way_s             = top / accel;
    p->current_A      = size_A;
    p->top_radps      = top;
    p->window_ticks   = commission_ticks(way_s / (float)DRIVE_WINDOWS, c->ts_s);
    p->coast_ticks    = commission_ticks(base_min(COAST_PER_WAY * way_s, COAST_s), c->ts_s);
}

static void begin_part(commission_spin_t *p, int16_t part, const commission_signal_t *s)
{
    p->part        = part;
    p->ticks       = 0L;
    p->start_cnt   = s->position_cnt;
    p->begun_radps = p->angle.omega_e_radps;
    if (part == TRIAL) {
        const dq_t zero = {0.0f, 0.0f};
        p->integral_V   = zero;
    } else if (coasts(p)) {
        commission_motion_begin(&p->motion, false, p->coast_ticks / COAST_WINDOWS, SETTLE_TICKS);
    } else {
        commission_motion_begin(&p->motion, part != STOP, p->window_ticks, SETTLE_TICKS);
    }
}

/* True when the shaft is at rest: the waves of MAP may have left some speed. */
static bool rests(const commission_spin_t *p, const commission_config_t *c)
{
    const float time_s = (float)p->ticks * c->ts_s;
    return ((time_s > REST_s) && base_within(p->angle.omega_e_radps, STANDING_radps)) ||
           (time_s > PATIENCE_s);
}

/* Trial: ends after two electrical turns. If the rotor does not move, doubles the current. */
static commission_step_t trial(commission_spin_t *p, const commission_config_t *c,
                               const commission_signal_t *s, const commission_result_t *found)
{
    const float time_s = (float)p->ticks * c->ts_s;
    const float turned = (float)found->direction * (float)found->pole_pairs *
                         (float)commission_moved_cnt(s->position_cnt, p->start_cnt) /
                         (float)found->counts_per_turn;
    const float half_top = 0.5f * top_speed(c, found, s->dc_link_V, p->current_A);
    const float gained   = p->angle.omega_e_radps - p->begun_radps;
    const bool  fast     = fabsf(p->angle.omega_e_radps) > half_top;

    if ((fabsf(turned) > TRY_TURNS) || fast ||
        ((time_s > TRY_s) && (fabsf(turned) > LEAST_TURNS))) {
        if (!(gained > 0.0f)) {
            return COMMISSION_FAILED;
        }
        plan(p, c, s, found, gained / time_s);
        begin_part(p, UP, s);
    } else if (time_s > TRY_s) {
        if (p->current_A >= (MOST_SHARE * c->current_max_A)) {
            return COMMISSION_FAILED;
        }
        p->current_A = base_min(2.0f * p->current_A, MOST_SHARE * c->current_max_A);
        begin_part(p, TRIAL, s);
    } else {
        /* the trial continues */
    }
    return COMMISSION_BUSY;
}

/* A part of the solution in each period, and the last one alone: the next stage begins after it. */
static commission_step_t solve(commission_spin_t *p, const commission_signal_t *s,
                               commission_result_t *found)
{
    const commission_step_t step = commission_motion_solve(&p->motion, p->ticks - 1L, found);

    if (step == COMMISSION_DONE) {
        begin_part(p, SOLVED, s);
    }
    return (step == COMMISSION_FAILED) ? COMMISSION_FAILED : COMMISSION_BUSY;
}

static commission_step_t next_part(commission_spin_t *p, const commission_config_t *c,
                                   const commission_signal_t *s, commission_result_t *found)
{
    const float w    = p->angle.omega_e_radps;
    const bool  late = (p->part != REST) && (p->ticks > (20L * p->coast_ticks));
    bool        ends = false;

    switch (p->part) {
    case REST:
        ends = rests(p, c);
        break;
    case TRIAL:
        return trial(p, c, s, found);
    case UP:
        ends = w >= p->top_radps;
        break;
    case DOWN:
        ends = w <= -p->top_radps;
        break;
    case LOW:
        ends = w >= (LOW_SHARE * p->top_radps);
        break;
    case STOP:
        ends = (w * p->begun_radps) <= 0.0f;
        if (ends) {
            commission_emf_solve(p->emf, p->top_radps, s->dc_link_V, found);
        }
        break;
    case SOLVE:
        return solve(p, s, found);
    case SOLVED:
        return COMMISSION_DONE;
    default:
        ends = (p->ticks >= p->coast_ticks) || (fabsf(w) < (COAST_SHARE * fabsf(p->begun_radps)));
        break;
    }
    if (ends) {
        begin_part(p, (int16_t)(p->part + 1), s);
    }
    return (late && !ends) ? COMMISSION_FAILED : COMMISSION_BUSY;
}

commission_answer_t commission_spin_tick(commission_spin_t *p, const commission_config_t *c,
                                         const commission_signal_t *s, commission_result_t *found)
{
    commission_answer_t  answer = commission_rest(COMMISSION_BUSY);
    const float          theta  = commission_angle_rad(found, s->position_cnt);
    const float          w      = commission_angle_tick(&p->angle, theta, c->ts_s);
    const frames_angle_t now    = frames_angle(theta);
    const frames_angle_t before = frames_angle(theta - (0.5f * w * c->ts_s));
    const frames_angle_t then   = frames_angle(theta + (1.5f * w * c->ts_s));
    const dq_t           i_A    = frames_park(s->i_A, now);

    if (coasts(p) && (p->ticks > SETTLE_TICKS)) {
        commission_emf_add(p->emf, found, p->angle.prompt_e_radps, frames_park(s->v_V, before),
                           i_A);
    }
    if ((p->part > TRIAL) && (p->part < SOLVE)) {
        commission_motion_tick(&p->motion, c, found, s->position_cnt, i_A);
    }
    p->ticks++;
    const dq_t                 ref_A = wanted_A(p, found);
    const commission_current_t loop  = {i_A, ref_A, p->angle.omega_e_radps, 0.5f * s->dc_link_V};
    const dq_t                 v_V   = commission_current_V(&p->integral_V, c, found, &loop);
    answer.v_V                       = frames_inverse_park(v_V, then);
    answer.i_A                       = frames_inverse_park(ref_A, then);
    answer.step                      = next_part(p, c, s, found);
    return answer;
}
