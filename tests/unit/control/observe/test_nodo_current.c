/* SPDX-License-Identifier: MIT */
#include "nodo_current.h"

#include "frames.h"
#include "gain_tables.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_REL 2.0e-6 /* relative to the largest term of a row; worst 4e-7 */

static nodo_current_gains_t g;
static support_random_t     random_state;

void setUp(void)
{
    g                  = law_constants_noc(&gain_tables_drive)->currents;
    random_state.state = 71u;
}

void tearDown(void) {}

/* EQ-NODO-CURRENT-2 in double: row, column. */
static double gain(double w, int row, int column)
{
    const double place =
        fmin(fmax((double)g.nodes_per_root * (sqrt(fabs(w)) - (double)g.root), 0.0), 4.0);
    const int    node = (place >= 4.0) ? 3 : (int)place;
    const double a    = (double)g.gain[node][row][column];
    const double b    = (double)g.gain[node + 1][row][column];
    return a + ((place - node) * (b - a));
}

static void near(double want, float found, double size)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOL_REL * size, want, (double)found);
}

static void test_correction_is_gain_times_innovation(void)
{
    for (int n = 0; n < 2000; n++) {
        const nodo_t x0  = support_random_estimate(&random_state);
        const dq_t   i_A = {.d = support_uniform(&random_state, -4.0f, 4.0f),
                            .q = support_uniform(&random_state, -4.0f, 4.0f)};
        const double w   = (double)x0.omega_e_radps;
        const double s =
            (w < 0.0) ? -1.0 : 1.0; /* the mirror image changes the sign of id's partners */
        const double rq    = (double)i_A.q - (double)x0.iq_A;
        const double rd    = (double)i_A.d - (double)x0.id_A;
        nodo_t       x     = x0;
        float        theta = 0.4f;
        double       c[5];
        for (int row = 0; row < 5; row++) {
            const double even = (row == 3) ? s : 1.0;
            c[row]            = (even * gain(w, row, 0) * rq) + (even * s * gain(w, row, 1) * rd);
        }
        const double iq = (double)x0.iq_A + c[2];
        const double id = (double)x0.id_A + c[3];

        nodo_current_correct(&x, &theta, &g, i_A);

        near((double)x0.d_omega + c[0], x.d_omega, 3.0e4);
        near(w + c[1], x.omega_e_radps, 2.0e3);
        near(iq - (c[4] * id), x.iq_A, 20.0);
        near(id + (c[4] * iq), x.id_A, 20.0);
        near(0.4 + c[4], theta, 4.0);
        TEST_ASSERT_TRUE((x.d_q == x0.d_q) && (x.d_d == x0.d_d));
    }
}

static void test_angle_stays_within_half_a_turn(void)
{
    nodo_t     x     = {.omega_e_radps = 300.0f};
    float      theta = 3.1f;
    const dq_t i_A   = {.d = 4.0f, .q = -4.0f};
    nodo_current_correct(&x, &theta, &g, i_A);
    TEST_ASSERT_TRUE((theta < 0.0f) && base_within(theta, BASE_PI));
}

static void test_speed_from_which_the_currents_know(void)
{
    TEST_ASSERT_FALSE(nodo_current_knows(&g, 0.0f));
    TEST_ASSERT_FALSE(nodo_current_knows(&g, g.from_e_radps));
    TEST_ASSERT_TRUE(nodo_current_knows(&g, nextafterf(g.from_e_radps, 1.0e9f)));
    TEST_ASSERT_TRUE(nodo_current_knows(&g, -300.0f));
    TEST_ASSERT_FALSE(nodo_current_knows(&g, NAN));
    TEST_ASSERT_FALSE(nodo_current_knows(&g, INFINITY));
}

static void test_constants_out_of_range_are_refused(void)
{
    float *const fields[] = {&g.from_e_radps, &g.root, &g.nodes_per_root, &g.gain[4][4][1]};
    TEST_ASSERT_TRUE(nodo_current_check(&g));
    for (int i = 0; i < SUPPORT_COUNT(fields); i++) {
        const float good = *fields[i];
        *fields[i]       = NAN;
        TEST_ASSERT_FALSE(nodo_current_check(&g));
        *fields[i] = (i < 3) ? 0.0f : INFINITY;
        TEST_ASSERT_FALSE(nodo_current_check(&g));
        *fields[i] = good;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_correction_is_gain_times_innovation);
    RUN_TEST(test_angle_stays_within_half_a_turn);
    RUN_TEST(test_speed_from_which_the_currents_know);
    RUN_TEST(test_constants_out_of_range_are_refused);
    return UNITY_END();
}
