/* SPDX-License-Identifier: MIT */
/**
 * @file test_motor.h
 * @brief A motor for the application's tests, in double and in the rotor frame: Ohm's law, flux, torque, one shaft.
 *
 * Averaged bridge with dead time; viscous and Coulomb friction; 5 us explicit Euler steps, 40 per control period.
 */
#ifndef TEST_MOTOR_H
#define TEST_MOTOR_H

#include <math.h>
#include <stdbool.h>

#include "base.h"

typedef struct {
    double rs_Ohm, ld_H, lq_H, flux_Wb, inertia_kgm2, viscous_Nms;
    int    pole_pairs;
    double coulomb_Nm;
    double load_Nm;
    double v_dc_V;
    double dead_share; /* of the dc link that a phase loses against its current */
    double id_A, iq_A, omega_m_radps, theta_m_rad;
} test_motor_t;

/* The shipped motor, with the dead time of the shipped inverter. */
static inline test_motor_t test_motor_390w(void)
{
    const test_motor_t m = {.rs_Ohm       = 2.48,
                            .ld_H         = 0.07498,
                            .lq_H         = 0.11391,
                            .flux_Wb      = 0.193,
                            .inertia_kgm2 = 0.00042,
                            .viscous_Nms  = 0.0001,
                            .pole_pairs   = 2,
                            .v_dc_V       = 295.0,
                            .dead_share   = 0.015};
    return m;
}

static inline double test_motor_phase_A(const test_motor_t *m, int phase)
{
    const double angle = (m->pole_pairs * m->theta_m_rad) - ((double)phase * 2.0943951023931953);
    return (m->id_A * cos(angle)) - (m->iq_A * sin(angle));
}

static inline double test_motor_friction(test_motor_t *m, double torque_Nm)
{
    if ((fabs(m->omega_m_radps) < 1.0e-3) && (fabs(torque_Nm) <= m->coulomb_Nm)) {
        m->omega_m_radps = 0.0;
        return torque_Nm;
    }
    return (m->omega_m_radps != 0.0) ? copysign(m->coulomb_Nm, m->omega_m_radps)
                                     : copysign(m->coulomb_Nm, torque_Nm);
}

static inline void test_motor_step(test_motor_t *m, const double duty[3], bool gate, double dt_s)
{
    const double th   = m->pole_pairs * m->theta_m_rad;
    const double w    = m->pole_pairs * m->omega_m_radps;
    double       v[3] = {0.0, 0.0, 0.0};
    for (int x = 0; x < 3; x++) {
        const double i_A = test_motor_phase_A(m, x);
        v[x] = m->v_dc_V * (duty[x] - (m->dead_share * fmax(-1.0, fmin(1.0, i_A / 0.05))));
    }
    const double alpha  = (2.0 * v[0] - v[1] - v[2]) / 3.0;
    const double beta   = (v[1] - v[2]) / sqrt(3.0);
    const double vd     = (alpha * cos(th)) + (beta * sin(th));
    const double vq     = (beta * cos(th)) - (alpha * sin(th));
    const double psi_d  = m->flux_Wb + (m->ld_H * m->id_A);
    const double psi_q  = m->lq_H * m->iq_A;
    const double drive  = 1.5 * m->pole_pairs * ((psi_d * m->iq_A) - (psi_q * m->id_A));
    const double torque = drive - m->load_Nm - (m->viscous_Nms * m->omega_m_radps);
    if (gate) {
        m->id_A += dt_s * (vd - (m->rs_Ohm * m->id_A) + (w * psi_q)) / m->ld_H;
        m->iq_A += dt_s * (vq - (m->rs_Ohm * m->iq_A) - (w * psi_d)) / m->lq_H;
    } else {
        m->id_A = 0.0; /* the diodes end the currents within a period or two */
        m->iq_A = 0.0;
    }
    m->omega_m_radps += dt_s * (torque - test_motor_friction(m, torque)) / m->inertia_kgm2;
    m->theta_m_rad += dt_s * m->omega_m_radps;
}

/* One control period of 200 us under constant duty ratios. */
static inline void test_motor_period(test_motor_t *m, const double duty[3], bool gate)
{
    for (int n = 0; n < 40; n++) {
        test_motor_step(m, duty, gate, 5.0e-6);
    }
}

/* Encoder position for a mark at mark_m_rad: 0 .. 9999. */
static inline int test_motor_position(const test_motor_t *m, double mark_m_rad)
{
    const double turns = (m->theta_m_rad - mark_m_rad) / 6.283185307179586;
    return (int)floor((turns - floor(turns)) * 10000.0) % 10000;
}

/* Since the last edge of the counter, at constant speed [s]; a second when it stands. */
static inline double test_motor_edge_age_s(const test_motor_t *m, double mark_m_rad)
{
    const double counts  = (m->theta_m_rad - mark_m_rad) / 6.283185307179586 * 10000.0;
    const double per_s   = m->omega_m_radps / 6.283185307179586 * 10000.0;
    const double in_cnt  = counts - floor(counts);
    const double way_cnt = (per_s > 0.0) ? in_cnt : (1.0 - in_cnt);
    return (fabs(per_s) > 1.0) ? fmin(way_cnt / fabs(per_s), 1.0) : 1.0;
}

#endif /* TEST_MOTOR_H */
