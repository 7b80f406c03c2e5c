/* SPDX-License-Identifier: MIT */
/**
 * @file unit_support.h
 * @brief Common part of the unit tests: repeatable random numbers, bad numbers, double oracles.
 */
#ifndef UNIT_SUPPORT_H
#define UNIT_SUPPORT_H

#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base.h"
#include "motor.h"
#include "nodo.h"

#define SUPPORT_COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const float support_not_finite[] = {NAN, INFINITY, -INFINITY};

/** State of a repeatable sequence. */
typedef struct {
    uint32_t state;
} support_random_t;

/** Evenly distributed in lo .. hi (linear congruential, upper 24 bits). */
static inline float support_uniform(support_random_t *random, float lo, float hi)
{
    random->state = (random->state * 1664525u) + 1013904223u;
    const float x = (float)(random->state >> 8) / 16777216.0f;
    return base_clamp(lo + (x * (hi - lo)), lo, hi);
}

/** Whether an entry of L_n is one that parity leaves (nodo.h): rows 2 and 5 are the even states. */
static inline bool support_parity(int row, int column, int id_column, int n)
{
    const bool even_state = (row == 2) || (row == 5);
    return ((column == id_column) == even_state) == ((n % 2) == 0);
}

static inline double support_limit(double x, double lo, double hi)
{
    return (x < lo) ? lo : ((x > hi) ? hi : x);
}

static inline double support_length(dq_t x)
{
    return hypot((double)x.d, (double)x.q);
}

/** x1 + j x2 in double. */
static inline double complex support_complex(double re, double im)
{
    return re + (im * (double complex)I);
}

/** Motor constants in SI units, worked back from the reduced parameters. */
typedef struct {
    double rs_Ohm;
    double ld_H;
    double lq_H;
    double flux_Wb;
} support_motor_t;

static inline support_motor_t support_motor(const motor_reduced_t *m)
{
    const support_motor_t motor = {.rs_Ohm  = (double)m->l4 / (double)m->l6,
                                   .ld_H    = 1.0 / (double)m->l8,
                                   .lq_H    = 1.0 / (double)m->l6,
                                   .flux_Wb = (double)m->l5 / (double)m->l6};
    return motor;
}

/** Every float of the measurement and of the estimates, evenly distributed over a wide range. */
static inline nodo_meas_t support_random_meas(support_random_t *random)
{
    nodo_meas_t y;
    y.omega_e_radps = support_uniform(random, -1500.0f, 1500.0f);
    y.iq_A          = support_uniform(random, -5.0f, 5.0f);
    y.id_A          = support_uniform(random, -5.0f, 5.0f);
    return y;
}

static inline nodo_t support_random_estimate(support_random_t *random)
{
    nodo_t x;
    x.d_omega       = support_uniform(random, -1.0e4f, 1.0e4f);
    x.d_q           = support_uniform(random, -1.0e3f, 1.0e3f);
    x.d_d           = support_uniform(random, -1.0e3f, 1.0e3f);
    x.omega_e_radps = support_uniform(random, -1500.0f, 1500.0f);
    x.iq_A          = support_uniform(random, -7.0f, 7.0f);
    x.id_A          = support_uniform(random, -5.0f, 5.0f);
    return x;
}

/** Reduced parameters that are all different, so that no exchange of two of them goes unseen. */
static inline motor_reduced_t support_odd_motor(void)
{
    const motor_reduced_t m = {.l1     = 2757.0f,
                               .l2     = 3.5f,
                               .l3     = 4761.0f,
                               .l4     = 21.0f,
                               .l5     = 1.7f,
                               .l6     = 8.0f,
                               .l7     = 33.0f,
                               .l8     = 12.8f,
                               .l9     = 1.6f,
                               .l10    = 0.625f,
                               .l11    = -556.0f,
                               .inv_l6 = 0.125f,
                               .inv_l8 = 0.078125f};
    return m;
}

#endif /* UNIT_SUPPORT_H */
