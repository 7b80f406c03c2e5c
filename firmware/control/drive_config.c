/* SPDX-License-Identifier: MIT */
#include "drive_config.h"

#include <math.h>
#include <stddef.h>

/* Beyond any physical constant of a drive, and far enough from FLT_MAX that products stay finite. */
#define LARGEST 1.0e12f
/* Harmonics beyond this have no angle left at any speed that a drive runs at. */
#define ORDER_MAX 1.0e3f

static bool is_positive(float x)
{
    return base_in_range(x, 1.0e-12f, LARGEST);
}

static bool all_finite(const float *x, int16_t count)
{
    for (int16_t i = 0; i < count; i++) {
        if (!base_in_range(x[i], -LARGEST, LARGEST)) {
            return false;
        }
    }
    return true;
}

static bool motor_ok(const motor_reduced_t *m)
{
    return is_positive(m->l1) && base_in_range(m->l2, 0.0f, LARGEST) && is_positive(m->l3) &&
           is_positive(m->l4) && is_positive(m->l5) && is_positive(m->l6) && is_positive(m->l7) &&
           is_positive(m->l8) && is_positive(m->l9) && is_positive(m->l10) &&
           base_in_range(m->l11, -LARGEST, 0.0f) && is_positive(m->inv_l6) &&
           is_positive(m->inv_l8);
}

static bool current_ref_ok(const current_ref_config_t *c)
{
    return is_positive(c->current_max_A) && is_positive(c->iq_max_A) &&
           (c->iq_max_A <= c->current_max_A) && is_positive(c->mtpa_A) &&
           base_in_range(c->voltage_share, 1.0e-3f, 1.0f) &&
           base_in_range(c->torque_share, 1.0e-3f, 1.0f) && is_positive(c->near_e_radps) &&
           is_positive(c->l1_min) && base_in_range(c->filter_per_period, 1.0e-6f, 1.0f) &&
           is_positive(c->filter_1ps) && base_in_range(c->regen_max_W_norm, 0.0f, LARGEST) &&
           is_positive(c->regen_start_V) && is_positive(c->regen_per_V);
}

static bool nosc_ok(const nosc_gains_t *g)
{
    if (!is_positive(g->iq_error_max_A) || !is_positive(g->iq_speed_max_A) || (g->order < 0) ||
        (g->order > NOSC_ORDER_MAX)) {
        return false;
    }
    for (int16_t n = 0; n <= g->order; n++) {
        for (int16_t row = 0; row < NOSC_N_U; row++) {
            if (!all_finite(g->lambda[n][row], NOSC_N_E)) {
                return false;
            }
        }
    }
    return is_positive(g->lambda[0][0][1]); /* EQ-NOSC-3 divides by k_iq */
}

static bool nodo_ok(const nodo_gains_t *g)
{
    if (!is_positive(g->iq_max_A) || !base_in_range(g->iq_certified_A, g->iq_max_A, LARGEST) ||
        (g->order < 0) || (g->order > NODO_ORDER_MAX)) {
        return false;
    }
    for (int16_t n = 0; n <= g->order; n++) {
        for (int16_t row = 0; row < NODO_N_X; row++) {
            if (!all_finite(g->gain[n][row], NODO_N_Y)) {
                return false;
            }
        }
    }
    return true;
}

static bool nodo_encoder_ok(const nodo_encoder_gains_t *g)
{
    if (!is_positive(g->iq_max_A) || (g->order < 0) || (g->order > NODO_ORDER_MAX)) {
        return false;
    }
    for (int16_t n = 0; n <= g->order; n++) {
        for (int16_t row = 0; row < NODO_ENCODER_N_X; row++) {
            if (!all_finite(g->gain[n][row], NODO_ENCODER_N_Y)) {
                return false;
            }
        }
    }
    return true;
}

static bool nodo_harmonic_ok(const nodo_harmonic_gains_t *g)
{
    if ((g == NULL) || (g->n_pairs < 0) || (g->n_pairs > NODO_HARMONIC_PAIRS_MAX) ||
        (g->n_nodes < 2) || (g->n_nodes > NODO_HARMONIC_NODES_MAX)) {
        return false;
    }
    const int16_t rows = (int16_t)(NODO_HARMONIC_N_BASE + (2 * g->n_pairs));
    for (int16_t node = 0; node < g->n_nodes; node++) {
        for (int16_t row = 0; row < rows; row++) {
            if (!all_finite(g->gain[node][row], NODO_HARMONIC_N_G)) {
                return false;
            }
        }
    }
    for (int16_t i = 0; i < g->n_pairs; i++) {
        if (!base_in_range(fabsf(g->pair[i].order), 0.0f, ORDER_MAX)) {
            return false;
        }
    }
    return is_positive(g->iq_max_A) && is_positive(g->nodes_per_root) && is_positive(g->keep) &&
           (g->keep <= 1.0f) && is_positive(g->keep_fast) && (g->keep_fast <= 1.0f);
}

static bool dobc_ok(const dobc_config_t *c)
{
    if ((c->n_x < 1) || (c->n_x > DOBC_N_X_MAX)) {
        return false;
    }
    for (int16_t row = 0; row < c->n_x; row++) {
        if (!all_finite(c->m[row], c->n_x)) {
            return false;
        }
    }
    return is_positive(c->direct_Vs) && is_positive(c->ld_H) && is_positive(c->k_omega_Vs) &&
           all_finite(c->k_x, c->n_x) && all_finite(c->g, c->n_x) && all_finite(c->h, c->n_x);
}

static bool pid_ok(const pid_law_config_t *c)
{
    return is_positive(c->kp) && base_in_range(c->ki_per_tick, 0.0f, LARGEST) &&
           base_in_range(c->kd_tick, 0.0f, LARGEST);
}

static bool servo_ok(const servo_law_config_t *c)
{
    const bool speed_ok = ((c->kind == SERVO_LAW_DOBC) && dobc_ok(&c->dobc)) ||
                          ((c->kind == SERVO_LAW_PID) && pid_ok(&c->pid));

    return speed_ok && pid_ok(&c->id_pi);
}

static bool order_ok(int16_t order)
{
    return (order >= 0) && (order <= DOUBLE_SERIES_ORDER_MAX);
}

static bool rows_ok(const float row[][DOUBLE_SERIES_COLUMNS], int16_t rows, int16_t order)
{
    const int16_t count = (int16_t)(rows * (double_series_index(0, order) + 1));

    for (int16_t i = 0; i < count; i++) {
        if (!all_finite(row[i], DOUBLE_SERIES_COLUMNS)) {
            return false;
        }
    }
    return true;
}

static bool conventional_ok(const drive_config_t *c)
{
    const conventional_gains_t *g = &c->conventional;

    return (c->form == DRIVE_FORM_SPEED) && current_ref_ok(&c->current_ref) && nosc_ok(&c->nosc) &&
           order_ok(g->nosc_order) && order_ok(g->nodo_order) && is_positive(g->i_error_max_A) &&
           is_positive(g->i_max_A) && base_in_range(g->i_certified_A, g->i_max_A, LARGEST) &&
           rows_ok(g->lambda, NOSC_N_U, g->nosc_order) && rows_ok(g->gain, NODO_N_X, g->nodo_order);
}

static bool noc_ok(const drive_config_t *c)
{
    const bool observer_ok = ((c->form == DRIVE_FORM_SPEED) && nodo_ok(&c->nodo)) ||
                             ((c->form == DRIVE_FORM_ENCODER) && nodo_encoder_ok(&c->nodo_encoder));

    return current_ref_ok(&c->current_ref) && nosc_ok(&c->nosc) && observer_ok;
}

static bool noc_h_ok(const drive_config_t *c)
{
    return current_ref_ok(&c->current_ref) && nosc_ok(&c->nosc) &&
           (c->form == DRIVE_FORM_ENCODER) && nodo_harmonic_ok(c->nodo_harmonic);
}

static bool law_ok(const drive_config_t *c)
{
    return (drive_config_is(c, DRIVE_LAW_NOC) && noc_ok(c)) ||
           (drive_config_is(c, DRIVE_LAW_NOC_H) && noc_h_ok(c)) ||
           (drive_config_is(c, DRIVE_LAW_CONVENTIONAL) && conventional_ok(c)) ||
           (drive_config_is(c, DRIVE_LAW_SERVO) && servo_ok(&c->servo));
}

ctl_status_t drive_config_check(const drive_config_t *c)
{
    const bool limits_ok =
        base_in_range(c->ts_s, 1.0e-5f, 1.0e-2f) && is_positive(c->trip_current_A) &&
        is_positive(c->current_ref.current_max_A) &&
        (c->trip_current_A > c->current_ref.current_max_A) && is_positive(c->trip_speed_e_radps) &&
        base_in_range(c->trip_angle_rad, 1.0e-6f, BASE_PI) && is_positive(c->trip_d_omega) &&
        is_positive(c->dc_link_min_V) && is_positive(c->dc_link_max_V) &&
        (c->dc_link_max_V > c->dc_link_min_V);
    const bool dead_time_ok =
        base_in_range(c->dead_time.share, 0.0f, 0.1f) && is_positive(c->dead_time.inv_fade_1pA);

    return (limits_ok && dead_time_ok && motor_ok(&c->motor) && law_ok(c)) ? CTL_OK
                                                                           : CTL_BAD_CONFIG;
}
