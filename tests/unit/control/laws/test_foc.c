/* SPDX-License-Identifier: MIT */
#include "foc.h"

#include <stddef.h>

#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_V 5.0e-4 /* V, voltages up to 500 V; worst 6e-5 */
#define TOL_A 5.0e-6 /* A; worst 5e-7 */

/* The shipped motor in SI units. */
#define RS   2.48
#define LD   0.07498
#define LQ   0.11391
#define FLUX 0.193
#define NP   2.0
#define J    0.00042

static foc_config_t   config;
static drive_config_t drive;
static foc_t          s;
static drive_sample_t sample;
static law_input_t    in;
static nodo_meas_t    y;

void setUp(void)
{
    const foc_config_t   c    = {.d                 = {190.0f, 1.2f, 0.0063f},
                                 .q                 = {280.0f, 1.2f, 0.0043f},
                                 .current_max_A     = 4.0f,
                                 .iq_max_A          = 3.3f,
                                 .mtpa_A            = (float)(FLUX / (2.0 * (LQ - LD))),
                                 .id_min_A          = -2.5f,
                                 .voltage_share     = 0.95f,
                                 .weakening_A_per_V = 1.0e-3f};
    const drive_sample_t at   = {.dc_link_V = 295.0f, .theta_e_rad = 0.5f, .valid = true};
    const law_input_t no_past = {.sample = &sample, .command_e_radps = 0.0f, .v_V = {0.0f, 0.0f}};
    const nodo_meas_t now     = {.omega_e_radps = 300.0f, .iq_A = 1.2f, .id_A = -0.3f};

    config = c;
    sample = at;
    in     = no_past;
    y      = now;
    drive  = gain_tables_drive;
    foc_reset(&s);
}

void tearDown(void) {}

static law_output_t answer(float accel)
{
    law_output_t out;

    foc_realise(&s, &config, &in);
    foc_answer(&s, &config, &drive, &in, &y, accel, &out);
    in.v_V = out.v_V;
    return out;
}

/* References that the same wish has brought to rest. */
static dq_t settled(float accel)
{
    for (int k = 0; k < 60; k++) {
        foc_reset(&s);
        s.i_ref_A.d = (k == 0) ? 0.0f : y.id_A;
        (void)answer(accel);
        y.id_A = s.i_ref_A.d; /* the next period's reference before */
    }
    return s.i_ref_A;
}

/* Electrical acceleration of the torque (1), and least current for it: no other angle of the current needs less. */
static void test_references_make_the_torque_with_the_least_current(void)
{
    const double np2_J = 1.5 * NP * NP / J;

    for (int k = -8; k <= 8; k++) {
        const double a   = 1000.0 * k;
        const dq_t   ref = settled((float)a);
        const double iq  = (double)ref.q;
        const double id  = (double)ref.d;

        TEST_ASSERT_DOUBLE_WITHIN(0.05, a, np2_J * ((FLUX * iq) + ((LD - LQ) * id * iq)));
        for (double step = -0.05; step < 0.06;
             step += 0.1) { /* another id, iq for the same torque */
            const double other = a / (np2_J * (FLUX + ((LD - LQ) * (id + step))));
            TEST_ASSERT_TRUE(((id + step) * (id + step)) + (other * other) >=
                             ((id * id) + (iq * iq)) - 1.0e-9);
        }
    }
}

static void test_voltage_is_that_of_the_decoupled_loops(void)
{
    const law_output_t out = answer(2000.0f);
    const double       e_q = (double)s.i_ref_A.q - 1.2;
    const double       e_d = (double)s.i_ref_A.d + 0.3;

    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (280.0 * e_q) + (300.0 * ((LD * -0.3) + FLUX)),
                              (double)s.u_V.q);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_V, (190.0 * e_d) - (300.0 * LQ * 1.2), (double)s.u_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 0.5 + (1.5 * (double)drive.ts_s * 300.0),
                              (double)out.theta_rad);
    TEST_ASSERT_TRUE(out.plausible && (out.i_ref_A.q == s.i_ref_A.q));
    TEST_ASSERT_TRUE(out.now.omega_e_radps == 300.0f);
}

/* Nothing cut: the sum grows by k_i e. Cut by half a volt: it gives its share back. */
static void test_sums_take_what_the_limits_left(void)
{
    (void)answer(2000.0f);
    const foc_t before = s;

    in.v_V = before.u_V;
    in.v_V.q -= 0.5f;
    foc_realise(&s, &config, &in);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-6, 1.2 * (double)before.e_A.d, (double)s.sum_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, (1.2 * (double)before.e_A.q) - (0.0043 * 0.5),
                              (double)s.sum_V.q);
}

static void test_current_stays_in_its_circle(void)
{
    for (int k = 0; k < 400; k++) {
        (void)answer((k < 200) ? 1.0e6f : -1.0e6f);
        s.id_fw_A = (k % 50 < 25) ? -2.0f : 0.0f;
    }
    s.i_ref_A.d = -3.2f;
    foc_realise(&s, &config, &in);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 2.4, (double)s.iq_most_A); /* 3.2^2 + 2.4^2 = 4^2 */
    s.i_ref_A.d = -4.5f;
    foc_realise(&s, &config, &in);
    TEST_ASSERT_TRUE(s.iq_most_A == 0.0f);
    for (int k = 0; k < 5; k++) { /* id_ref of the period before is that of this one */
        (void)answer(1.0e6f);
        s.id_fw_A = 0.0f;
    }
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 3.3, (double)s.i_ref_A.q);
    TEST_ASSERT_TRUE(s.limit > 0.0f);
    (void)answer(-1.0e6f);
    TEST_ASSERT_TRUE(s.limit < 0.0f);
    (void)answer(100.0f);
    TEST_ASSERT_TRUE(base_within(s.i_ref_A.q, 3.3f));
}

/* A voltage that is short asks for more -id until the lowest one, a voltage to spare gives it back. */
static void test_flux_weakening_follows_the_voltage(void)
{
    s.u_V.q = 400.0f;
    for (int k = 0; k < 500; k++) {
        const float before = s.id_fw_A;
        foc_realise(&s, &config, &in);
        TEST_ASSERT_TRUE(s.id_fw_A <= before);
    }
    TEST_ASSERT_TRUE(s.id_fw_A == -2.5f);
    s.u_V.q = 100.0f;
    foc_realise(&s, &config, &in);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -2.5 + (1.0e-3 * 0.25 * 295.0 / sqrt(3.0)),
                              (double)s.id_fw_A); /* more than a quarter of the circle to spare */
    s.u_V.q = 160.0f;
    foc_realise(&s, &config, &in);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_A, -2.5 + (1.0e-3 * ((1.2 * 295.0 / sqrt(3.0)) - 160.0)),
                              (double)s.id_fw_A);
}

/* On the circle, the voltage of id whole, while id is short of its reference; as it was wanted while it is not. */
static void test_d_axis_comes_first_while_it_is_short(void)
{
    const float circle_V = 295.0f / sqrtf(3.0f);

    s.id_fw_A        = -0.6f;
    y.id_A           = -1.7f;
    law_output_t out = answer(1.0e5f);
    TEST_ASSERT_TRUE(s.u_V.q > circle_V);
    TEST_ASSERT_TRUE(out.v_V.d == s.u_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, (double)circle_V,
                              hypot((double)out.v_V.d, (double)out.v_V.q));
    y.id_A = 4.0f; /* never so much that q has nothing */
    out    = answer(1.0e5f);
    TEST_ASSERT_TRUE(s.u_V.d < -circle_V);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, -0.95 * (double)circle_V, (double)out.v_V.d);
    TEST_ASSERT_DOUBLE_WITHIN(1.0e-3, sqrt(1.0 - (0.95 * 0.95)) * (double)circle_V,
                              (double)out.v_V.q);
    y.id_A = s.i_ref_A.d;
    out    = answer(1.0e5f);
    TEST_ASSERT_TRUE((out.v_V.d == s.u_V.d) && (out.v_V.q == s.u_V.q));
}

static void test_no_number_makes_no_voltage(void)
{
    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        setUp();
        law_output_t out = answer(support_not_finite[k]);
        TEST_ASSERT_FALSE(base_within(out.v_V.q, 1.0e9f));
        setUp();
        s.sum_V.q = support_not_finite[k];
        out       = answer(1.0e5f);
        TEST_ASSERT_FALSE(base_within(out.v_V.q, 1.0e9f));
        setUp();
        s.sum_V.d = support_not_finite[k];
        y.id_A    = 2.0f;
        out       = answer(1.0e5f);
        TEST_ASSERT_FALSE(base_within(out.v_V.d, 1.0e9f));
    }
}

static void test_check_wants_every_constant(void)
{
    float *const constants[] = {
        &config.d.kp_V_per_A,  &config.d.ki_tick,     &config.d.ki_per_kp,
        &config.q.kp_V_per_A,  &config.q.ki_tick,     &config.q.ki_per_kp,
        &config.current_max_A, &config.iq_max_A,      &config.mtpa_A,
        &config.id_min_A,      &config.voltage_share, &config.weakening_A_per_V};

    TEST_ASSERT_TRUE(foc_check(&config, &drive));
    for (int i = 0; i < SUPPORT_COUNT(constants); i++) {
        const float kept = *constants[i];
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *constants[i] = support_not_finite[k];
            TEST_ASSERT_FALSE(foc_check(&config, &drive));
        }
        *constants[i] = (constants[i] == &config.id_min_A) ? 0.1f : -0.1f;
        TEST_ASSERT_FALSE(foc_check(&config, &drive));
        *constants[i] = kept;
    }
    config.iq_max_A = 4.1f;
    TEST_ASSERT_FALSE(foc_check(&config, &drive));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_references_make_the_torque_with_the_least_current);
    RUN_TEST(test_voltage_is_that_of_the_decoupled_loops);
    RUN_TEST(test_sums_take_what_the_limits_left);
    RUN_TEST(test_current_stays_in_its_circle);
    RUN_TEST(test_flux_weakening_follows_the_voltage);
    RUN_TEST(test_d_axis_comes_first_while_it_is_short);
    RUN_TEST(test_no_number_makes_no_voltage);
    RUN_TEST(test_check_wants_every_constant);
    return UNITY_END();
}
