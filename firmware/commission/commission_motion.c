/* SPDX-License-Identifier: MIT */
#include "commission_motion.h"

#include "commission_fit.h"

/* Chosen: largest relative error of an inertia that is accepted. */
#define WORST 0.25f
/* Fewer windows without current cannot separate the two kinds of friction from noise. */
#define LEAST_COASTING 4

void commission_motion_start(commission_motion_t *m)
{
    m->count        = 0;
    m->length_ticks = 0L;
    m->have_last    = false;
}

void commission_motion_begin(commission_motion_t *m, bool driven, int32_t length_ticks,
                             int32_t settle_ticks)
{
    m->driven       = driven;
    m->length_ticks = (length_ticks < 8L) ? 8L : length_ticks;
    m->around_ticks = m->length_ticks / 4L;
    m->ticks        = -(settle_ticks + m->around_ticks);
    m->iq_As        = 0.0f;
    m->idiq_A2s     = 0.0f;
    m->have_last    = false;
}

static float rad_per_cnt(const commission_result_t *known)
{
    return (float)known->direction * BASE_TWO_PI / (float)known->counts_per_turn;
}

/* Closes the window that ends at the instant; its speed is now known. */
static void close_window(commission_motion_t *m, const commission_config_t *c,
                         const commission_result_t *known, int32_t position_cnt)
{
    const float per    = rad_per_cnt(known);
    const float turned = per * (float)commission_moved_cnt(position_cnt, m->early_cnt);
    const float speed  = turned / (2.0f * (float)m->around_ticks * c->ts_s);

    if (m->have_last && ((speed * m->last_radps) > 0.0f) && (m->count < COMMISSION_WINDOWS)) {
        const float          time_s = (float)m->length_ticks * c->ts_s;
        commission_window_t *w      = &m->windows[m->count];
        w->speed_radps              = speed - m->last_radps;
        w->way_rad                  = per * (float)commission_moved_cnt(m->mark_cnt, m->last_cnt);
        w->time_s                   = (speed > 0.0f) ? time_s : -time_s;
        w->iq_As                    = m->closed_iq_As;
        w->idiq_A2s                 = m->closed_idiq_A2s;
        w->driven                   = m->driven;
        m->count++;
    }
    m->last_radps = speed;
    m->last_cnt   = m->mark_cnt;
    m->have_last  = true;
}

void commission_motion_tick(commission_motion_t *m, const commission_config_t *c,
                            const commission_result_t *known, int32_t position_cnt, dq_t i_A)
{
    if (m->length_ticks == 0L) {
        return;
    }
    if (m->ticks == -m->around_ticks) {
        m->early_cnt = position_cnt;
    }
    if (m->ticks == 0L) {
        m->mark_cnt        = position_cnt;
        m->closed_iq_As    = m->iq_As;
        m->closed_idiq_A2s = m->idiq_A2s;
        m->iq_As           = 0.0f;
        m->idiq_A2s        = 0.0f;
    }
    if (m->ticks == m->around_ticks) {
        close_window(m, c, known, position_cnt);
        m->ticks = m->around_ticks - m->length_ticks;
    }
    m->ticks++;
    m->iq_As += i_A.q * c->ts_s;
    m->idiq_A2s += i_A.d * i_A.q * c->ts_s;
}

float commission_motion_torque(const commission_result_t *known, float iq, float idiq)
{
    const float saliency = known->ld_H.value - known->lq_H.value;
    return 1.5f * (float)known->pole_pairs * ((known->flux_Wb.value * iq) + (saliency * idiq));
}

/* Inertia from the driven windows and the deceleration by both kinds of friction, B / J and C / J.
 */
static commission_value_t inertia_of(const commission_motion_t *m, const commission_result_t *known,
                                     float rate_1ps, float rate_radps2)
{
    commission_value_t j  = {0.0f, 0.0f};
    float              xx = 0.0f;
    float              xy = 0.0f;
    float              yy = 0.0f;
    float              n  = 0.0f;
    for (int16_t k = 0; k < m->count; k++) {
        const commission_window_t *w = &m->windows[k];
        if (w->driven) {
            const float x = w->speed_radps + (rate_1ps * w->way_rad) + (rate_radps2 * w->time_s);
            const float y = commission_motion_torque(known, w->iq_As, w->idiq_A2s);
            xx += x * x;
            xy += x * y;
            yy += y * y;
            n += 1.0f;
        }
    }
    if ((n > 1.5f) && (xx > 0.0f)) {
        j.value = xy / xx;
        j.error = 2.0f * sqrtf(base_max(yy - (j.value * xy), 0.0f) / ((n - 1.0f) * xx));
    }
    return j;
}

/* Makes both coefficients non-negative: if one is negative, refits the other one alone. */
static void keep_braking(commission_result_t *found, const commission_fit_t *f)
{
    float *const rate_1ps    = &found->friction_Nms.value;
    float *const rate_radps2 = &found->coulomb_Nm.value;

    if ((*rate_1ps < 0.0f) && (f->bb > 0.0f)) {
        *rate_1ps    = 0.0f;
        *rate_radps2 = f->by / f->bb;
    } else if ((*rate_radps2 < 0.0f) && (f->aa > 0.0f)) {
        *rate_radps2 = 0.0f;
        *rate_1ps    = f->ay / f->aa;
    } else {
        /* both are non-negative, or a refit is impossible */
    }
    *rate_1ps    = base_max(*rate_1ps, 0.0f);
    *rate_radps2 = base_max(*rate_radps2, 0.0f);
}

/* Deceleration from the coasting windows: B / J and C / J take the places of B and C.
 * @return false: the shaft did not coast long enough. */
static bool slowing_of(const commission_motion_t *m, commission_result_t *found)
{
    const float      per_inertia = 1.0f / base_max(found->inertia_kgm2.value, 1.0e-12f);
    commission_fit_t fit;

    commission_fit_reset(&fit);
    for (int16_t k = 0; k < m->count; k++) {
        const commission_window_t *w = &m->windows[k];
        if (!w->driven) {
            const float pull = per_inertia * commission_motion_torque(found, w->iq_As, w->idiq_A2s);
            commission_fit_add(&fit, w->way_rad, w->time_s, pull - w->speed_radps);
        }
    }
    const commission_fitted_t f           = commission_fit_solve(&fit);
    const bool                long_enough = f.valid && (fit.n >= LEAST_COASTING);
    if (long_enough) {
        found->friction_Nms.value = f.x0;
        found->friction_Nms.error = f.error0;
        found->coulomb_Nm.value   = f.x1;
        found->coulomb_Nm.error   = f.error1;
        keep_braking(found, &fit);
    }
    return long_enough;
}

/* Relative torque error: that of the flux, or of Lq - Ld in a reluctance motor. */
static float relative_torque_error(const commission_result_t *r)
{
    const float flux = r->flux_Wb.error / base_max(r->flux_Wb.value, 1.0e-9f);
    const float l =
        (r->lq_H.error + r->ld_H.error) / base_max(r->lq_H.value - r->ld_H.value, 1.0e-9f);
    return r->reluctance ? base_min(l, 1.0f) : base_min(flux, 1.0f);
}

/* For a shaft that stops too early to coast. Windows with torque in both directions separate J from
 * dry friction. Dry and viscous friction cannot be separated. */
static bool solve_driven(const commission_motion_t *m, commission_result_t *found)
{
    commission_fit_t fit;
    float            fastest = 0.0f;

    commission_fit_reset(&fit);
    for (int16_t k = 0; k < m->count; k++) {
        const commission_window_t *w = &m->windows[k];
        if (w->driven) {
            commission_fit_add(&fit, w->speed_radps, w->time_s,
                               commission_motion_torque(found, w->iq_As, w->idiq_A2s));
            fastest = base_max(fastest, fabsf(w->way_rad) / base_max(fabsf(w->time_s), 1.0e-9f));
        }
    }
    const commission_fitted_t f = commission_fit_solve(&fit);
    if (!f.valid || !(f.x0 > 0.0f) || !(fastest > 0.0f)) {
        return false;
    }
    found->inertia_kgm2.value = f.x0;
    found->inertia_kgm2.error = f.error0 + (relative_torque_error(found) * f.x0);
    found->coulomb_Nm.value   = base_max(f.x1, 0.0f);
    found->friction_Nms.value = 0.0f;
    found->friction_Nms.error = found->coulomb_Nm.value / fastest;
    found->coulomb_Nm.error   = f.error1 + found->coulomb_Nm.value;
    return found->inertia_kgm2.error < (WORST * f.x0);
}

/* Turns a friction per inertia into the friction. */
static commission_value_t times_inertia(commission_value_t rate, commission_value_t j)
{
    const commission_value_t x = {rate.value * j.value,
                                  (rate.error * j.value) + (rate.value * j.error)};
    return x;
}

static commission_step_t step_of(bool good, commission_step_t next)
{
    return good ? next : COMMISSION_FAILED;
}

commission_step_t commission_motion_solve(const commission_motion_t *m, int32_t part,
                                          commission_result_t *found)
{
    commission_step_t step = COMMISSION_BUSY;

    if (part == COMMISSION_MOTION_ROUGH) {
        found->inertia_kgm2 = inertia_of(m, found, 0.0f, 0.0f);
        step                = step_of(found->inertia_kgm2.value > 0.0f, COMMISSION_BUSY);
    } else if (part == COMMISSION_MOTION_SLOWING) {
        if (!slowing_of(m, found)) { /* EQ-COMMISSION-11 */
            step = step_of(solve_driven(m, found), COMMISSION_DONE);
        }
    } else {
        commission_value_t j =
            inertia_of(m, found, found->friction_Nms.value, found->coulomb_Nm.value);
        j.error += relative_torque_error(found) * j.value;
        found->inertia_kgm2 = j;
        found->friction_Nms = times_inertia(found->friction_Nms, j);
        found->coulomb_Nm   = times_inertia(found->coulomb_Nm, j);
        step                = step_of(j.value > 0.0f, COMMISSION_DONE);
    }
    return step;
}
