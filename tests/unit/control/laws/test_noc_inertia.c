/* SPDX-License-Identifier: MIT */
#include "law_noc.h"

#include <math.h>
#include <string.h>

#include "drive_tick.h"
#include "gain_tables.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define CASES 400

static support_random_t random_state;
static law_noc_config_t whole; /* the shipped constants with the whole range of ratios */
static drive_config_t   own;
static law_noc_config_t scaled;
static drive_config_t   other;

void setUp(void)
{
    random_state.state = 91u;
    whole              = *law_constants_noc(&gain_tables_drive);
    whole.inertia      = (law_noc_inertia_t){.least = 0.5f, .most = 5.0f};
    own                = gain_tables_drive;
    own.constants      = &whole;
}

void tearDown(void) {}

static float uniform(float low, float high)
{
    return support_uniform(&random_state, low, high);
}

static void near(double wants, float is)
{
    TEST_ASSERT_DOUBLE_WITHIN(3e-7 * fabs(wants) + 1e-30, wants, (double)is);
}

/* EQ-INERTIA-8 in double, row by row. */
static void test_constants_are_those_of_the_other_inertia(void)
{
    for (int i = 0; i < CASES; i++) {
        const double k    = (double)uniform(0.5f, 5.0f);
        const double root = sqrt(k);

        TEST_ASSERT_TRUE(law_noc_believe(&other, &scaled, &own, (float)k) == (float)k);
        near((double)own.motor.l1 / k, other.motor.l1);
        near((double)own.motor.l2 / k, other.motor.l2);
        near((double)own.motor.l3 / k, other.motor.l3);
        near((double)own.motor.l11 / k, other.motor.l11);

        const current_ref_config_t *r = &whole.near_optimal.current_ref;
        const current_ref_config_t *s = &scaled.near_optimal.current_ref;
        near((double)r->l1_min / k, s->l1_min);
        near((double)r->regen_max_W_norm / k, s->regen_max_W_norm);
        near((double)r->near_e_radps / root, s->near_e_radps);

        const nosc_gains_t *g = &whole.near_optimal.nosc;
        const nosc_gains_t *h = &scaled.near_optimal.nosc;
        near((double)g->speed_A_per_radps * root, h->speed_A_per_radps);
        near((double)g->speed_radps_per_A / root, h->speed_radps_per_A);
        for (int n = 0; n <= NOSC_ORDER_MAX; n++) {
            near((double)g->lambda[n][0][0] * root, h->lambda[n][0][0]);
            near((double)g->lambda[n][1][0] * root, h->lambda[n][1][0]);
        }
        for (int n = 0; n <= NODO_ORDER_MAX; n++) {
            for (int y = 0; y < NODO_ENCODER_N_Y; y++) {
                near((double)whole.nodo.gain[n][0][y] / root, scaled.nodo.gain[n][0][y]);
            }
        }
        near((double)whole.rare.d_omega_1ps2 / root, scaled.rare.d_omega_1ps2);
        TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&other));
    }
}

/* The test puts back what EQ-INERTIA-8 names. Then not a bit differs. */
static void test_nothing_else_changes(void)
{
    (void)law_noc_believe(&other, &scaled, &own, 2.7f);
    TEST_ASSERT_FALSE(other.positions);
    other.positions = own.positions;
    other.constants = own.constants;
    other.motor.l1  = own.motor.l1;
    other.motor.l2  = own.motor.l2;
    other.motor.l3  = own.motor.l3;
    other.motor.l11 = own.motor.l11;
    TEST_ASSERT_EQUAL_MEMORY(&own, &other, sizeof own);

    current_ref_config_t *s = &scaled.near_optimal.current_ref;
    nosc_gains_t         *h = &scaled.near_optimal.nosc;
    s->l1_min               = whole.near_optimal.current_ref.l1_min;
    s->regen_max_W_norm     = whole.near_optimal.current_ref.regen_max_W_norm;
    s->near_e_radps         = whole.near_optimal.current_ref.near_e_radps;
    h->speed_A_per_radps    = whole.near_optimal.nosc.speed_A_per_radps;
    h->speed_radps_per_A    = whole.near_optimal.nosc.speed_radps_per_A;
    for (int n = 0; n <= NOSC_ORDER_MAX; n++) {
        h->lambda[n][0][0] = whole.near_optimal.nosc.lambda[n][0][0];
        h->lambda[n][1][0] = whole.near_optimal.nosc.lambda[n][1][0];
    }
    for (int n = 0; n <= NODO_ORDER_MAX; n++) {
        memcpy(scaled.nodo.gain[n][0], whole.nodo.gain[n][0], sizeof whole.nodo.gain[n][0]);
    }
    scaled.rare.d_omega_1ps2 = whole.rare.d_omega_1ps2;
    TEST_ASSERT_EQUAL_MEMORY(&whole, &scaled, sizeof whole);
}

static void test_the_certified_range_bounds_the_ratio(void)
{
    whole.inertia = (law_noc_inertia_t){.least = 0.7f, .most = 2.0f};
    TEST_ASSERT_TRUE(law_noc_believe(&other, &scaled, &own, 0.5f) == 0.7f);
    near((double)own.motor.l1 / (double)0.7f, other.motor.l1);
    TEST_ASSERT_TRUE(law_noc_believe(&other, &scaled, &own, 5.0f) == 2.0f);
    TEST_ASSERT_TRUE(law_noc_believe(&other, &scaled, &own, NAN) >= 0.7f);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&other));
}

static void test_ranges_that_no_table_has_are_refused(void)
{
    const law_noc_inertia_t bad[] = {{0.49f, 1.0f}, {1.1f, 2.0f}, {0.5f, 0.9f},
                                     {0.5f, 5.1f},  {NAN, 1.0f},  {1.0f, NAN}};

    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&own));
    for (int i = 0; i < SUPPORT_COUNT(bad); i++) {
        whole.inertia = bad[i];
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&own));
    }
}

static double accel(const motor_reduced_t *m, const nodo_t *x)
{
    return ((double)x->iq_A * ((double)m->l1 + ((double)m->l11 * (double)x->id_A))) -
           ((double)m->l2 * (double)x->omega_e_radps) + (double)x->d_omega;
}

/* EQ-INERTIA-9: the acceleration that the observer predicts is the same with both. */
static void test_the_predicted_acceleration_has_no_step(void)
{
    law_state_t state;

    memset(&state, 0, sizeof state);
    for (int i = 0; i < CASES; i++) {
        nodo_t *x        = &state.noc.observer;
        x->iq_A          = uniform(-8.0f, 8.0f);
        x->id_A          = uniform(-8.0f, 1.0f);
        x->omega_e_radps = uniform(-900.0f, 900.0f);
        x->d_omega       = uniform(-9000.0f, 9000.0f);
        (void)law_noc_believe(&other, &scaled, &own, uniform(0.5f, 5.0f));

        const nodo_t before = *x;
        const double wants  = accel(&own.motor, x);
        law_noc_adopt(&state, &own, &other);
        TEST_ASSERT_DOUBLE_WITHIN(0.05, wants, accel(&other.motor, x)); /* of 20,000 rad/s^2 */
        x->d_omega = before.d_omega;
        TEST_ASSERT_EQUAL_MEMORY(&before, x, sizeof before);
    }
}

/* The core goes over in any state, and only with a law that can. */
static void test_a_drive_takes_the_other_constants(void)
{
    static drive_t d;

    (void)law_noc_believe(&other, &scaled, &own, 3.0f);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&d, &own));
    d.law.noc.observer.iq_A    = 2.0f;
    d.law.noc.observer.d_omega = 100.0f;
    drive_adopt(&d, &other);
    TEST_ASSERT_TRUE(d.config == &other && d.config_again == &other);
    TEST_ASSERT_TRUE(d.constants_again == &scaled);
    TEST_ASSERT_TRUE(d.law.noc.observer.d_omega == 100.0f); /* off: the next run begins anew */

    d.state = DRIVE_RUN;
    drive_adopt(&d, &own);
    TEST_ASSERT_TRUE(d.config == &own && d.constants_again == &whole);
    TEST_ASSERT_TRUE(d.law.noc.observer.d_omega < 100.0f);

    law_t without  = law_noc;
    without.adopt  = NULL;
    own.law        = &without;
    d.law_again    = &without;
    const float at = d.law.noc.observer.d_omega;
    drive_adopt(&d, &other);
    TEST_ASSERT_TRUE(d.config == &own && d.law.noc.observer.d_omega == at);

    own.law        = &law_noc;
    d.config_again = &other; /* a flipped pointer */
    drive_adopt(&d, &other);
    TEST_ASSERT_TRUE(d.config == &own);
    d.config       = NULL;
    d.config_again = NULL;
    drive_adopt(&d, &other);
    TEST_ASSERT_TRUE(d.config == NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_constants_are_those_of_the_other_inertia);
    RUN_TEST(test_nothing_else_changes);
    RUN_TEST(test_the_certified_range_bounds_the_ratio);
    RUN_TEST(test_ranges_that_no_table_has_are_refused);
    RUN_TEST(test_the_predicted_acceleration_has_no_step);
    RUN_TEST(test_a_drive_takes_the_other_constants);
    return UNITY_END();
}
