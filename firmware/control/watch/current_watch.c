/* SPDX-License-Identifier: MIT */
#include "current_watch.h"

/* Chosen by simulation of 500 motors: +-50 % of resistance, inductance and flux, x0.5 .. x3 of
 * inertia, and sensors that fail at 0 .. 800 rad/s. Healthy sensors stay below 0.28 i_max. They
 * exceed 0.15 i_max for at most 3 ms. */
#define FORGET_1ps 200.0f /* 1 / tau */
#define SLOW_1ps   400.0f
#define LIES_share 0.375f
#define LIES_jump  0.875f /* six periods, enough for the observers of all motors */
#define LONG_jump  0.375f
#define LONG_share 0.15f
#define LONG_s     6.0e-3f
/* Chosen by simulation of 2,016 drifts and 800 motors: 400 as above, 400 within +-20 %. In the
 * scenario of random motors, S stays below 0.18 i_max. A zero that has moved by a tenth of i_max
 * gives up to 0.13 i_max with DRIFT_carries, and 0.25 i_max without it. */
#define DRIFT_FORGET_1prad    0.2f
#define DRIFT_FORGET_MOST_1ps 60.0f
#define DRIFT_share           0.25f
#define DRIFT_jump            0.63f
#define DRIFT_e_radps         60.0f
#define DRIFT_carries         0.31f
/* An inductance error of 50 % leaves a residual of half the change of the current. */
#define EXPLAINED 0.6f
#define RECOVERS  0.25f

/* Eight times the noise of the shipped board, and twice that. A tenth of the rated torque needs
 * 0.06 i_max. */
#define NONE_share     0.02f
#define ASKED_per_none 2.0f
#define OPEN_MIN_s     10.0e-3f
#define OPEN_MAX_s     1.0f
/* Chosen by simulation of a pump with 1024 counts at standstill with half of its torque. A time of
 * 30 ms trips one run in twenty, 58 ms none. */
#define OPEN_per_way 4.0f

CTL_PART float current_watch_open_s(float count_rad, float accel_max_radps2)
{
    if (!(accel_max_radps2 > (count_rad * OPEN_per_way * OPEN_per_way))) {
        return OPEN_MAX_s;
    }
    return base_max(OPEN_per_way * sqrtf(count_rad / accel_max_radps2), OPEN_MIN_s);
}

CTL_PART void current_watch_reset(current_watch_t *w)
{
    const current_watch_t start = {.models = false};

    *w = start;
}

CTL_PART void current_watch_start(current_watch_t *w, float ia_A, float ib_A)
{
    w->phase[0].slow_A = ia_A;
    w->phase[1].slow_A = ib_A;
}

/* Rotates back by a small angle, to first order. */
static ab_t turned_back(ab_t x, float by_rad)
{
    const ab_t y = {.alpha = x.alpha + (by_rad * x.beta), .beta = x.beta - (by_rad * x.alpha)};
    return y;
}

CTL_PART void current_watch_expect(current_watch_t *w, const current_watch_expected_t *e,
                                   float ts_s)
{
    const dq_t  sudden_A = {.d = ts_s * (e->d_Aps.d - w->d_slow_Aps.d),
                            .q = ts_s * (e->d_Aps.q - w->d_slow_Aps.q)};
    const ab_t  step_A   = frames_inverse_park(sudden_A, e->angle);
    const ab_t  model_A  = {.alpha = e->i_A.alpha - step_A.alpha,
                            .beta  = e->i_A.beta - step_A.beta}; /* EQ-CURRENT-WATCH-1 */
    const abc_t model    = frames_inverse_clarke(turned_back(model_A, e->ahead_rad));

    w->d_slow_Aps.d += SLOW_1ps * sudden_A.d;
    w->d_slow_Aps.q += SLOW_1ps * sudden_A.q;
    w->drift_A.alpha += step_A.alpha;
    w->drift_A.beta += step_A.beta;
    w->phase[0].model_A = model.a;
    w->phase[1].model_A = model.b;
    w->models           = e->predicted;
}

/* Bounds of both phases. */
typedef struct {
    float forget; /* Ts / tau */
    float long_A; /* beyond it for LONG_s */
} bounds_t;

static bounds_t bounds_of(const current_watch_scale_t *scale)
{
    const bounds_t bounds = {
        .forget = FORGET_1ps * scale->ts_s,
        .long_A = base_max(LONG_share * scale->current_max_A, LONG_jump * scale->jump_A)};
    return bounds;
}

/* Beyond long_A: too far, or for too long. */
static bool goes_on(current_watch_phase_t *p, float beyond_A, const current_watch_scale_t *scale)
{
    const float most_A = base_max(LIES_share * scale->current_max_A, LIES_jump * scale->jump_A);

    p->lying_s += scale->ts_s;
    return !(beyond_A <= most_A) || (p->lying_s > LONG_s);
}

/* EQ-CURRENT-WATCH-2, 3 without the jump. */
static inline bool lies(current_watch_phase_t *p, float i_A, const bounds_t *bounds,
                        const current_watch_scale_t *scale)
{
    const float change_A   = i_A - p->slow_A;
    const float residual_A = i_A - p->model_A;
    const float sum_A      = p->residual_A + (residual_A - (bounds->forget * p->residual_A));
    const float beyond_A   = fabsf(sum_A) - (EXPLAINED * fabsf(change_A));

    p->slow_A += bounds->forget * change_A;
    p->residual_A = sum_A;
    if (!(beyond_A <= bounds->long_A)) {
        return goes_on(p, beyond_A, scale);
    }
    p->lying_s = base_max(p->lying_s - (RECOVERS * scale->ts_s), 0.0f);
    return false;
}

CTL_PART current_watch_verdict_t current_watch_judge(current_watch_t *w, float ia_A, float ib_A,
                                                     const current_watch_scale_t *scale)
{
    if (!w->models) {
        return CURRENT_WATCH_GOOD;
    }
    const bounds_t bounds = bounds_of(scale);
    /* A residual that is no number makes a sum that lies. */
    const float jump_A =
        base_max(fabsf(ia_A - w->phase[0].model_A), fabsf(ib_A - w->phase[1].model_A));
    const bool a_lies = lies(&w->phase[0], ia_A, &bounds, scale);
    const bool b_lies = lies(&w->phase[1], ib_A, &bounds, scale);
    return (a_lies || b_lies || !(jump_A <= scale->jump_A)) ? CURRENT_WATCH_SENSOR
                                                            : CURRENT_WATCH_GOOD;
}

/* Negative in a phase without current that needs some. */
static inline float lack_A(float i_A, float ref_A, float none_A)
{
    return base_max(i_A - none_A, (ASKED_per_none * none_A) - fabsf(ref_A));
}

/* EQ-CURRENT-WATCH-4: the time that one phase is empty. */
static void time_empty(current_watch_t *w, const abc_t *i_A, float step_s,
                       const current_watch_scale_t *scale)
{
    const float none_A = NONE_share * scale->current_max_A;
    const abc_t ref_A  = frames_inverse_clarke(w->ref_A);
    const float a      = lack_A(i_A->a, ref_A.a, none_A);
    const float b      = lack_A(i_A->b, ref_A.b, none_A);
    const float c      = lack_A(i_A->c, ref_A.c, none_A);

    if (base_min(base_min(a, b), c) < 0.0f) {
        int16_t phase = 3;
        if (b < 0.0f) {
            phase = 2;
        }
        if (a < 0.0f) {
            phase = 1;
        }
        w->empty_s = (phase == w->empty) ? (w->empty_s + step_s) : step_s;
        w->empty   = phase;
    } else {
        w->empty_s = 0.0f;
    }
}

/* EQ-CURRENT-WATCH-5, 6 */
static bool drifts(current_watch_t *w, const abc_t *i_A, float omega_e_radps, float step_s,
                   const current_watch_scale_t *scale)
{
    static const ab_t nothing = {.alpha = 0.0f, .beta = 0.0f};
    const float       speed   = fabsf(omega_e_radps);

    if (!w->models || (speed < DRIFT_e_radps)) {
        w->drift_A = nothing;
        return false;
    }
    const float forget_1ps = base_min(DRIFT_FORGET_1prad * speed, DRIFT_FORGET_MOST_1ps);
    const float keep       = 1.0f - (forget_1ps * step_s);
    const ab_t  sum_A      = {.alpha = keep * w->drift_A.alpha, .beta = keep * w->drift_A.beta};
    const float sum_A2     = (sum_A.alpha * sum_A.alpha) + (sum_A.beta * sum_A.beta);
    const float most_A = base_max(DRIFT_share * scale->current_max_A, DRIFT_jump * scale->jump_A);

    w->drift_A = sum_A;
    return !(sum_A2 <= (most_A * most_A)) &&
           (base_max(base_max(i_A->a, i_A->b), i_A->c) > (DRIFT_carries * scale->current_max_A));
}

CTL_PART current_watch_verdict_t current_watch_look(current_watch_t *w, float ia_A, float ib_A,
                                                    float omega_e_radps, float step_s,
                                                    const current_watch_scale_t *scale)
{
    /* c but for its sign */
    const abc_t i_A = {.a = fabsf(ia_A), .b = fabsf(ib_A), .c = fabsf(ia_A + ib_A)};

    time_empty(w, &i_A, step_s, scale);
    if (w->empty_s > scale->open_s) {
        return CURRENT_WATCH_OPEN;
    }
    return drifts(w, &i_A, omega_e_radps, step_s, scale) ? CURRENT_WATCH_SENSOR
                                                         : CURRENT_WATCH_GOOD;
}
