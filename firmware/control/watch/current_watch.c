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
/* An inductance error of 50 % leaves a residual of half the change of the current. */
#define EXPLAINED 0.6f
#define RECOVERS  0.25f

/* Eight times the noise of the shipped board, and twice that. A tenth of the rated torque needs
 * 0.06 i_max. */
#define NONE_share  0.02f
#define ASKED_share 0.04f
#define OPEN_MIN_s  10.0e-3f
#define OPEN_MAX_s  1.0f
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
    const current_watch_t start = {.expects = false};

    *w = start;
}

CTL_PART void current_watch_start(current_watch_t *w, float ia_A, float ib_A)
{
    w->phase[0].slow_A = ia_A;
    w->phase[1].slow_A = ib_A;
}

/* Rotates back by a small angle, to first order. */
static dq_t turned_back(dq_t x, float by_rad)
{
    const dq_t y = {.d = x.d + (by_rad * x.q), .q = x.q - (by_rad * x.d)};
    return y;
}

CTL_PART void current_watch_expect(current_watch_t *w, const current_watch_expected_t *e,
                                   float ts_s)
{
    const dq_t  sudden_Aps = {.d = e->d_Aps.d - w->d_slow_Aps.d, .q = e->d_Aps.q - w->d_slow_Aps.q};
    const dq_t  model_A    = {.d = e->i_A.d - (ts_s * sudden_Aps.d),
                              .q = e->i_A.q - (ts_s * sudden_Aps.q)}; /* EQ-CURRENT-WATCH-1 */
    const dq_t  at_sample  = turned_back(model_A, e->ahead_rad);
    const abc_t model      = frames_inverse_clarke(frames_inverse_park(at_sample, e->angle));

    w->d_slow_Aps.d += SLOW_1ps * ts_s * sudden_Aps.d;
    w->d_slow_Aps.q += SLOW_1ps * ts_s * sudden_Aps.q;
    w->phase[0].model_A = model.a;
    w->phase[1].model_A = model.b;
    w->ref_A            = frames_inverse_clarke(frames_inverse_park(e->i_ref_A, e->angle));
    w->expects          = true;
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

/* EQ-CURRENT-WATCH-2, 3 */
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
        return goes_on(p, beyond_A, scale) || !base_within(residual_A, scale->jump_A);
    }
    p->lying_s = base_max(p->lying_s - (RECOVERS * scale->ts_s), 0.0f);
    return !base_within(residual_A, scale->jump_A);
}

/* EQ-CURRENT-WATCH-4 */
static inline void time_empty(float *empty_s, float i_A, float ref_A,
                              const current_watch_scale_t *scale)
{
    const bool without = base_within(i_A, NONE_share * scale->current_max_A) &&
                         !base_within(ref_A, ASKED_share * scale->current_max_A);

    *empty_s = without ? (*empty_s + scale->ts_s) : 0.0f;
}

CTL_PART current_watch_verdict_t current_watch_judge(current_watch_t *w, float ia_A, float ib_A,
                                                     const current_watch_scale_t *scale)
{
    if (!w->expects) {
        return CURRENT_WATCH_GOOD;
    }
    time_empty(&w->empty_s[0], ia_A, w->ref_A.a, scale);
    time_empty(&w->empty_s[1], ib_A, w->ref_A.b, scale);
    time_empty(&w->empty_s[2], ia_A + ib_A, w->ref_A.c, scale); /* but for its sign */
    if (base_max(base_max(w->empty_s[0], w->empty_s[1]), w->empty_s[2]) > scale->open_s) {
        return CURRENT_WATCH_OPEN;
    }
    if (!w->models) {
        return CURRENT_WATCH_GOOD;
    }
    const bounds_t bounds = bounds_of(scale);
    const bool     a_lies = lies(&w->phase[0], ia_A, &bounds, scale);
    const bool     b_lies = lies(&w->phase[1], ib_A, &bounds, scale);
    return (a_lies || b_lies) ? CURRENT_WATCH_SENSOR : CURRENT_WATCH_GOOD;
}
