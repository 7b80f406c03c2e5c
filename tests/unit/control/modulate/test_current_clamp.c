/* SPDX-License-Identifier: MIT */
#include "current_clamp.h"

#include <math.h>
#include <string.h>

#include "unit_support.h"
#include "unity.h"

/* The outrunner: 30 uH, 50 mOhm, 2.4 mWb, 30 A, 20 kHz; 14 V add 23 A in a period. */
#define TS_s  5.0e-5
#define L_H   3.0e-5
#define R_Ohm 5.0e-2
#define PM_Wb 2.39e-3
#define MAX_A 30.0f
#define CASES 2000

#define SHARE 0.7  /* of the inductance, that current_clamp.h names */
#define RATIO 1.03 /* of the limit */

static support_random_t random_state;

static const motor_reduced_t motor = {.l4     = (float)(R_Ohm / L_H),
                                      .l5     = (float)(PM_Wb / L_H),
                                      .l6     = (float)(1.0 / L_H),
                                      .l7     = (float)(R_Ohm / L_H),
                                      .l8     = (float)(1.0 / L_H),
                                      .l9     = 1.0f,
                                      .l10    = 1.0f,
                                      .inv_l6 = (float)L_H,
                                      .inv_l8 = (float)L_H};

void setUp(void)
{
    random_state.state = 5u;
}

void tearDown(void) {}

typedef struct {
    nodo_meas_t now;
    nodo_t      est;
    dq_t        v_V;
    dq_t        v_0_V;
} case_t;

static case_t random_case(void)
{
    case_t c;
    memset(&c, 0, sizeof c);
    c.now.omega_e_radps = support_uniform(&random_state, -5000.0f, 5000.0f);
    c.now.iq_A          = support_uniform(&random_state, -30.0f, 30.0f);
    c.now.id_A          = support_uniform(&random_state, -20.0f, 5.0f);
    c.est.d_q           = support_uniform(&random_state, -1.0e4f, 1.0e4f);
    c.est.d_d           = support_uniform(&random_state, -1.0e4f, 1.0e4f);
    c.v_V.q             = support_uniform(&random_state, -13.0f, 13.0f);
    c.v_V.d             = support_uniform(&random_state, -13.0f, 13.0f);
    c.v_0_V.q           = support_uniform(&random_state, -13.0f, 13.0f);
    c.v_0_V.d           = support_uniform(&random_state, -13.0f, 13.0f);
    return c;
}

static dq_t clamped(const case_t *c)
{
    return current_clamp_V(&motor, &c->est, &c->now, c->v_V, c->v_0_V, MAX_A, (float)(1.0 / TS_s));
}

typedef struct {
    double d;
    double q;
} pair_t;

/* In double, from the motor's equation with its own numbers. */
static pair_t rate_Aps(const case_t *c, dq_t v_V)
{
    const double w   = (double)c->now.omega_e_radps;
    const double iq  = (double)c->now.iq_A;
    const double id  = (double)c->now.id_A;
    const pair_t out = {
        (((double)v_V.d - (R_Ohm * id) + (w * L_H * iq)) / L_H) + (double)c->est.d_d,
        (((double)v_V.q - (R_Ohm * iq) - (w * (PM_Wb + (L_H * id)))) / L_H) + (double)c->est.d_q};
    return out;
}

/* The current at the end of the period in a winding with SHARE of the inductance, in which both periods change it more. */
static pair_t end_A(const case_t *c, dq_t v_V)
{
    const pair_t before = rate_Aps(c, c->v_0_V);
    const pair_t during = rate_Aps(c, v_V);
    const pair_t out    = {
           (double)c->now.id_A + (TS_s * (((1.0 / SHARE - 1.0) * before.d) + (during.d / SHARE))),
           (double)c->now.iq_A + (TS_s * (((1.0 / SHARE - 1.0) * before.q) + (during.q / SHARE)))};
    return out;
}

static void test_current_ends_inside_or_on_the_circle(void)
{
    int held = 0;

    for (int i = 0; i < CASES; i++) {
        const case_t c      = random_case();
        const dq_t   v_V    = clamped(&c);
        const pair_t asked  = end_A(&c, c.v_V);
        const pair_t end    = end_A(&c, v_V);
        const double most_A = RATIO * (double)MAX_A;
        const double far_A  = hypot(asked.d, asked.q);

        if (far_A < (most_A * 0.9999)) {
            TEST_ASSERT_TRUE((v_V.d == c.v_V.d) && (v_V.q == c.v_V.q));
        } else if (far_A > (most_A * 1.0001)) {
            held++;
            TEST_ASSERT_DOUBLE_WITHIN(1e-4 * far_A, most_A * asked.d / far_A, end.d);
            TEST_ASSERT_DOUBLE_WITHIN(1e-4 * far_A, most_A * asked.q / far_A, end.q);
        } else {
            /* on the circle either is right */
        }
    }
    TEST_ASSERT_GREATER_THAN(CASES / 10, held);
    TEST_ASSERT_LESS_THAN(CASES * 9 / 10, held);
}

/* A NaN passes the clamp, so that drive_tick() detects it. */
static void test_what_is_no_number_stays_none(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        case_t c = random_case();
        c.v_V.q  = support_not_finite[k];

        TEST_ASSERT_FALSE(isfinite(clamped(&c).q));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_current_ends_inside_or_on_the_circle);
    RUN_TEST(test_what_is_no_number_stays_none);
    return UNITY_END();
}
