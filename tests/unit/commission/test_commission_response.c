/* SPDX-License-Identifier: MIT */
#include "commission_response.h"

#include "unit_support.h"
#include "unity.h"

#define PI      3.14159265358979324
#define TS_s    2.0e-4
#define INERTIA 4.2e-4
#define COUNTS  10000
#define STEPS   80 /* of the plant in a period */

/* Two masses, in double precision. */
typedef struct {
    double share; /* of the load */
    double resonance_Hz;
    double damping;
    double motor_radps;
    double load_radps;
    double twist_rad;
    double angle_rad;
} plant_t;

static commission_config_t config;
static commission_result_t known;
static support_random_t    noise_state = {7u};

void setUp(void)
{
    const commission_config_t c = {.ts_s = (float)TS_s};
    const commission_result_t k = {
        .inertia_kgm2 = {(float)INERTIA, 0.0f}, .counts_per_turn = COUNTS, .direction = 1};
    config = c;
    known  = k;
}

void tearDown(void) {}

static void step(plant_t *p, double torque_Nm, double time_s)
{
    const double w       = 2.0 * PI * p->resonance_Hz;
    const double reduced = p->share * (1.0 - p->share) * INERTIA;
    const double pull    = reduced * ((w * w * p->twist_rad) +
                                   (2.0 * p->damping * w * (p->motor_radps - p->load_radps)));
    p->motor_radps += time_s * (torque_Nm - pull) / ((1.0 - p->share) * INERTIA);
    p->load_radps += time_s * pull / (p->share * INERTIA);
    p->twist_rad += time_s * (p->motor_radps - p->load_radps);
    p->angle_rad += time_s * p->motor_radps;
}

static int32_t count_of(const plant_t *p)
{
    return (int32_t)floor(p->angle_rad * COUNTS / (2.0 * PI)) * known.direction;
}

/* The answer to a torque of 1 N m, a straight line between two samples: a mean of 50 blocks after 50. */
static commission_phasor_t answer(plant_t *p, double *hz, commission_response_t *last)
{
    commission_phasor_t sum    = {0.0f, 0.0f};
    int32_t             before = count_of(p);
    double              torque = 0.0;
    commission_block_t  b;
    for (int k = 0; k < 100; k++) {
        commission_block_start(&b, (float)TS_s, (float)*hz, 0.04f);
        for (bool whole = false; !whole;) {
            const double  next = (double)commission_block_wave(&b);
            const int32_t now  = count_of(p);
            whole              = commission_block_add(&b, now - before, (float)torque);
            before             = now;
            for (int i = 0; i < STEPS; i++) {
                step(p, torque + ((next - torque) * (i + 0.5) / STEPS), TS_s / STEPS);
            }
            torque = next;
        }
        *last = commission_block_response(&b, &config, &known);
        if (k >= 50) {
            sum.re += last->y.re / 50.0f;
            sum.im += last->y.im / 50.0f;
        }
    }
    const double real_Hz = commission_block_Hz(&b, (float)TS_s);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * *hz, *hz, real_Hz);
    *hz = real_Hz;
    return sum;
}

static plant_t plant_of(double resonance_Hz, double damping, double share)
{
    const plant_t p = {.share        = share,
                       .resonance_Hz = resonance_Hz,
                       .damping      = damping,
                       .motor_radps  = 12.0,
                       .load_radps   = 12.0};
    return p;
}

/* EQ-COMMISSION-18, written anew in double precision. */
static commission_phasor_t expected(const plant_t *p, double hz)
{
    const double        mu = p->share / (1.0 - p->share);
    const double        u  = hz / p->resonance_Hz;
    const double        re = 1.0 - (u * u);
    const double        im = 2.0 * p->damping * u;
    const double        l2 = (re * re) + (im * im);
    commission_phasor_t y  = {(float)(-mu * u * u * re / l2), (float)(mu * u * u * im / l2)};
    return y;
}

static void test_the_answer_is_that_of_two_masses(void)
{
    static const double wanted[] = {45.0, 130.0, 210.0, 222.0, 400.0, 590.0};
    for (int16_t way = -1; way <= 1; way = (int16_t)(way + 2)) {
        for (int k = 0; k < SUPPORT_COUNT(wanted); k++) {
            double                hz = wanted[k];
            commission_response_t last;
            plant_t               p       = plant_of(220.0, 0.05, 0.4);
            known.direction               = way;
            const commission_phasor_t got = answer(&p, &hz, &last);
            const commission_phasor_t y   = expected(&p, hz);
            const double size = 0.02 * sqrt(1.0 + (double)((y.re * y.re) + (y.im * y.im)));
            TEST_ASSERT_DOUBLE_WITHIN(size, y.re, got.re);
            TEST_ASSERT_DOUBLE_WITHIN(size, y.im, got.im);
        }
    }
}

/* 1 N m on a rigid shaft: the speed swings by T / (J w), and J times the acceleration is T. */
static void test_amplitudes_are_those_of_the_motor(void)
{
    commission_response_t     last;
    double                    hz = 100.0;
    plant_t                   p  = plant_of(1.0, 0.0, 1.0e-6);
    const commission_phasor_t y  = answer(&p, &hz, &last);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, y.re);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, y.im);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 1.0, last.j_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.03 * 3.79, 1.0 / (INERTIA * 2.0 * PI * 100.0), last.m_radps);
}

static void test_a_block_without_torque_has_no_answer(void)
{
    commission_block_t b;
    commission_block_start(&b, (float)TS_s, 50.0f, 0.04f);
    while (!commission_block_add(&b, 1, 0.0f)) {
    }
    TEST_ASSERT_EQUAL_INT32(200, b.turned_cnt);
    const commission_response_t r = commission_block_response(&b, &config, &known);
    TEST_ASSERT_TRUE((r.y.re == 0.0f) && (r.y.im == 0.0f));
}

/* Evenly distributed in -0.1 .. 0.1. */
static double noise_of(void)
{
    return (double)support_uniform(&noise_state, -0.1f, 0.1f);
}

/* Frequencies around 1.03 times the resonance, with errors of a tenth of `noise`. */
static void fill(commission_ring_fit_t *f, const plant_t *p, double noise)
{
    const double centre = 1.03 * p->resonance_Hz;
    commission_ring_fit_start(f, (float)centre);
    for (int k = -6; k <= 6; k++) {
        const double        hz = centre * (1.0 + (0.015 * k));
        commission_phasor_t y  = expected(p, hz);
        y.re += (float)(noise * noise_of());
        y.im += (float)(noise * noise_of());
        commission_ring_fit_add(f, (float)hz, y);
    }
}

static void test_the_fit_gives_back_what_made_the_answers(void)
{
    static const double dampings[] = {0.005, 0.02, 0.1, 0.2};
    static const double shares[]   = {0.1, 0.5, 0.9};
    for (int i = 0; i < SUPPORT_COUNT(dampings); i++) {
        for (int k = 0; k < SUPPORT_COUNT(shares); k++) {
            commission_result_t   found = known;
            commission_ring_fit_t f;
            const plant_t         p = plant_of(140.0, dampings[i], shares[k]);
            fill(&f, &p, 0.0);
            TEST_ASSERT_TRUE(commission_ring_fit_solve(&f, &found));
            TEST_ASSERT_DOUBLE_WITHIN(0.001 * 140.0, 140.0, found.resonance_Hz.value);
            TEST_ASSERT_DOUBLE_WITHIN(0.01 * dampings[i], dampings[i], found.damping.value);
            TEST_ASSERT_DOUBLE_WITHIN(0.005, shares[k], found.load_share.value);
            TEST_ASSERT_DOUBLE_WITHIN(1.0, 0.0, found.resonance_Hz.error);
        }
    }
}

/* Twice the standard deviation: nine of ten errors are within it, and few within a quarter. */
static void test_the_errors_are_what_they_say(void)
{
    const plant_t p      = plant_of(140.0, 0.05, 0.5);
    int           within = 0;
    int           close  = 0;
    for (int k = 0; k < 100; k++) {
        commission_result_t   found = known;
        commission_ring_fit_t f;
        fill(&f, &p, 0.3);
        TEST_ASSERT_TRUE(commission_ring_fit_solve(&f, &found));
        const double off[] = {
            ((double)found.resonance_Hz.value - 140.0) / (double)found.resonance_Hz.error,
            ((double)found.damping.value - 0.05) / (double)found.damping.error,
            ((double)found.load_share.value - 0.5) / (double)found.load_share.error};
        for (int i = 0; i < 3; i++) {
            within += (fabs(off[i]) < 1.0) ? 1 : 0;
            close += (fabs(off[i]) < 0.25) ? 1 : 0;
        }
    }
    TEST_ASSERT_INT_WITHIN(30, 276, within); /* 92 of 100, three times */
    TEST_ASSERT_INT_WITHIN(50, 115, close);  /* 38 of 100 */
}

static void test_answers_of_one_mass_are_refused(void)
{
    commission_result_t   found = known;
    commission_ring_fit_t f;
    commission_ring_fit_start(&f, 100.0f);
    TEST_ASSERT_FALSE(commission_ring_fit_solve(&f, &found));
    for (int k = 0; k < 13; k++) {
        const commission_phasor_t none = {0.0f, 0.0f};
        commission_ring_fit_add(&f, 90.0f + (float)k, none);
    }
    TEST_ASSERT_FALSE(commission_ring_fit_solve(&f, &found));
    commission_ring_fit_start(&f, 100.0f);
    for (int k = -6; k <= 6; k++) { /* an imaginary part of the wrong sign: negative damping */
        plant_t                   p    = plant_of(100.0, 0.05, 0.5);
        const double              hz   = 100.0 * (1.0 + (0.015 * k));
        const commission_phasor_t y    = expected(&p, hz);
        const commission_phasor_t back = {y.re, -y.im};
        commission_ring_fit_add(&f, (float)hz, back);
    }
    TEST_ASSERT_FALSE(commission_ring_fit_solve(&f, &found));
    TEST_ASSERT_TRUE(found.resonance_Hz.value == 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_answer_is_that_of_two_masses);
    RUN_TEST(test_amplitudes_are_those_of_the_motor);
    RUN_TEST(test_a_block_without_torque_has_no_answer);
    RUN_TEST(test_the_fit_gives_back_what_made_the_answers);
    RUN_TEST(test_the_errors_are_what_they_say);
    RUN_TEST(test_answers_of_one_mass_are_refused);
    return UNITY_END();
}
