/* SPDX-License-Identifier: MIT */
#include "commission_guard.h"

#include "commission_angle.h"

/* Chosen: longer than the delay of the loop, shorter than a swing of the rotor. */
#define FORGET 0.0625f
/* Chosen: R, L and the angle are known; twice as long. */
#define ROTOR_FORGET 0.0416667f
/* Chosen: R I on its ramp and the induced voltage of a swing are slower. */
#define SLOW 0.015625f

/* Chosen: twice the largest of eleven healthy motors, as shares of the current bound. */
#define LOOK_SHARE   0.85f
#define VECTOR_SHARE 0.85f
#define ROTOR_SHARE  0.5f
/* Chosen: DRAG's angle error of a salient rotor shows as much; SPIN corrects it. */
#define ANGLE_rad 0.2f
/* Chosen: time of the mean voltage that R and the induced voltage do not explain. */
#define MEAN_s 0.1f
/* Chosen: admittance of LOOK to that of the check; healthy 0.8 to 1.3. */
#define LEAST_RATIO 0.6f
#define MOST_RATIO  1.7f

void commission_guard_start(commission_guard_t *g)
{
    const commission_guard_t fresh = {.begun = false};
    *g                             = fresh;
}

/* EQ-COMMISSION-16: adds one period to a leaky sum. */
static void add_leaky(ab_t *sum_Wb, ab_t step_Wb, float forget)
{
    sum_Wb->alpha = ((1.0f - forget) * sum_Wb->alpha) + step_Wb.alpha;
    sum_Wb->beta  = ((1.0f - forget) * sum_Wb->beta) + step_Wb.beta;
}

/* False for what is not a number. */
static bool is_shorter(ab_t x, float most)
{
    return ((x.alpha * x.alpha) + (x.beta * x.beta)) <= (most * most);
}

/* Flux that the voltage brought and the measured current does not show. */
static ab_t unexplained(commission_guard_t *g, ab_t linkage_Wb, ab_t v_V, float ts_s)
{
    const ab_t none    = {0.0f, 0.0f};
    const ab_t step_Wb = {(ts_s * v_V.alpha) - (linkage_Wb.alpha - g->linkage_Wb.alpha),
                          (ts_s * v_V.beta) - (linkage_Wb.beta - g->linkage_Wb.beta)};
    const bool begun   = g->begun;
    g->linkage_Wb      = linkage_Wb;
    g->begun           = true;
    return begun ? step_Wb : none;
}

bool commission_guard_look(commission_guard_t *g, const commission_config_t *c,
                           const commission_signal_t *s, const commission_admittance_t *y)
{
    const float per        = 1.0f / ((y->aa * y->bb) - (y->ab * y->ab)); /* > 0 after the check */
    const ab_t  linkage_Wb = {per * ((y->bb * s->i_A.alpha) - (y->ab * s->i_A.beta)),
                              per * ((y->aa * s->i_A.beta) - (y->ab * s->i_A.alpha))};
    const float mean_H     = 0.5f * per * (y->aa + y->bb);
    add_leaky(&g->error_Wb, unexplained(g, linkage_Wb, s->v_V, c->ts_s), FORGET);
    return is_shorter(g->error_Wb, LOOK_SHARE * mean_H * c->current_max_A);
}

bool commission_guard_vector(commission_guard_t *g, const commission_config_t *c,
                             const commission_signal_t *s, const commission_result_t *known)
{
    const float ld_H       = known->ld_H.value;
    const ab_t  linkage_Wb = {ld_H * s->i_A.alpha, ld_H * s->i_A.beta};

    g->slow_V.alpha += SLOW * (s->v_V.alpha - g->slow_V.alpha);
    g->slow_V.beta += SLOW * (s->v_V.beta - g->slow_V.beta);
    const ab_t quick_V = {s->v_V.alpha - g->slow_V.alpha, s->v_V.beta - g->slow_V.beta};
    add_leaky(&g->error_Wb, unexplained(g, linkage_Wb, quick_V, c->ts_s), FORGET);
    return is_shorter(g->error_Wb, VECTOR_SHARE * known->lq_H.value * c->current_max_A);
}

bool commission_guard_rotor(commission_guard_t *g, const commission_config_t *c,
                            const commission_signal_t *s, const commission_result_t *known,
                            float mean_share)
{
    const float          r     = known->r_Ohm.value;
    const frames_angle_t angle = frames_angle(commission_angle_rad(known, s->position_cnt));
    const dq_t           i_A   = frames_park(s->i_A, angle);
    const dq_t           psi   = {(known->ld_H.value * i_A.d) + known->flux_Wb.value,
                                  known->lq_H.value * i_A.q};
    const ab_t           v_V = {s->v_V.alpha - (r * s->i_A.alpha), s->v_V.beta - (r * s->i_A.beta)};
    const ab_t           step = unexplained(g, frames_inverse_park(psi, angle), v_V, c->ts_s);
    add_leaky(&g->error_Wb, step, ROTOR_FORGET);
    add_leaky(&g->mean_Wb, step, base_min(c->ts_s / MEAN_s, 1.0f));
    const float turned_H = ANGLE_rad * (known->lq_H.value - known->ld_H.value);
    const float most_H   = (ROTOR_SHARE * known->ld_H.value) + base_max(turned_H, 0.0f);
    return is_shorter(g->error_Wb, most_H * c->current_max_A) &&
           is_shorter(g->mean_Wb, mean_share * MEAN_s * r * c->current_max_A);
}

bool commission_guard_agrees(const commission_admittance_t *y, const commission_result_t *known)
{
    const float ld_H = known->ld_H.value;
    const float lq_H = known->lq_H.value;
    const float at_1 = ld_H * lq_H * (y->aa + y->bb); /* ld + lq at a ratio of 1 */
    return (ld_H > 0.0f) && (lq_H > 0.0f) &&
           base_in_range(ld_H + lq_H, LEAST_RATIO * at_1, MOST_RATIO * at_1);
}
