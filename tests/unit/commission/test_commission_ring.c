/* SPDX-License-Identifier: MIT */
/* The stage on two masses in double precision, with the winding's R and L, an encoder that counts whole and no other errors. */
#include "commission_ring.h"

#include "commission_motion.h"
#include "unit_support.h"
#include "unity.h"

#define PI      3.14159265358979324
#define R_Ohm   1.5
#define LD_H    0.01
#define LQ_H    0.015
#define FLUX_Wb 0.1
#define PAIRS   3
#define INERTIA 3.0e-4
#define COUNTS  8192
#define LINK_V  300.0
#define STEPS   8 /* of the plant in a period */

typedef struct {
    double share;
    double resonance_Hz;
    double damping;
    double light; /* of the inertia that the stage believes */
    double drag_Nm;
    double motor_radps;
    double load_radps;
    double twist_rad;
    double angle_rad;
    double id_A;
    double iq_A;
} plant_t;

static commission_config_t config;
static commission_result_t found;
static commission_ring_t   ring;
static plant_t             plant;
static ab_t                acts_V;
static double              most_A;
static double              most_radps;
static double              most_twist_Nm;
static long                ticks;

void setUp(void)
{
    const commission_config_t c = {.ts_s              = 2.0e-4f,
                                   .current_max_A     = 5.0f,
                                   .speed_max_m_radps = 150.0f,
                                   .dc_link_min_V     = 200.0f,
                                   .dc_link_max_V     = 400.0f};
    const commission_result_t k = {.r_Ohm           = {(float)R_Ohm, 0.0f},
                                   .ld_H            = {(float)LD_H, 0.0f},
                                   .lq_H            = {(float)LQ_H, 0.0f},
                                   .flux_Wb         = {(float)FLUX_Wb, 0.0f},
                                   .inertia_kgm2    = {(float)INERTIA, 0.0f},
                                   .counts_per_turn = COUNTS,
                                   .pole_pairs      = PAIRS,
                                   .direction       = 1};
    const plant_t             p = {
                    .share = 0.5, .resonance_Hz = 150.0, .damping = 0.03, .light = 1.0, .drag_Nm = 0.01};
    config = c;
    found  = k;
    plant  = p;
}

void tearDown(void) {}

static void turn(double time_s, double vd_V, double vq_V)
{
    const double w       = 2.0 * PI * plant.resonance_Hz;
    const double j       = plant.light * INERTIA;
    const double reduced = plant.share * (1.0 - plant.share) * j;
    const double we      = PAIRS * plant.motor_radps;
    const double torque =
        1.5 * PAIRS * ((FLUX_Wb * plant.iq_A) + ((LD_H - LQ_H) * plant.id_A * plant.iq_A));
    const double pull =
        reduced * ((w * w * plant.twist_rad) +
                   (2.0 * plant.damping * w * (plant.motor_radps - plant.load_radps)));
    const double drag = plant.drag_Nm * tanh(plant.motor_radps / 0.05);

    plant.motor_radps += time_s * (torque - drag - pull) / ((1.0 - plant.share) * j);
    plant.load_radps += time_s * pull / (plant.share * j);
    plant.twist_rad += time_s * (plant.motor_radps - plant.load_radps);
    plant.angle_rad += time_s * plant.motor_radps;
    plant.id_A += time_s * (vd_V - (R_Ohm * plant.id_A) + (we * LQ_H * plant.iq_A)) / LD_H;
    plant.iq_A +=
        time_s * (vq_V - (R_Ohm * plant.iq_A) - (we * ((LD_H * plant.id_A) + FLUX_Wb))) / LQ_H;
    most_twist_Nm = fmax(most_twist_Nm, fabs(pull));
}

static commission_signal_t sample(void)
{
    const double        theta = PAIRS * plant.angle_rad;
    commission_signal_t s     = {.dc_link_V = (float)LINK_V};
    s.i_A.alpha               = (float)((plant.id_A * cos(theta)) - (plant.iq_A * sin(theta)));
    s.i_A.beta                = (float)((plant.id_A * sin(theta)) + (plant.iq_A * cos(theta)));
    s.position_cnt = found.direction * (int32_t)floor(plant.angle_rad * COUNTS / (2.0 * PI));
    return s;
}

/* One period; the voltage of the answer before acts in it. */
static void run_period(commission_answer_t answer)
{
    const double ts = (double)config.ts_s;
    for (int i = 0; i < STEPS; i++) {
        const double theta = PAIRS * plant.angle_rad;
        const double c     = cos(theta);
        const double s     = sin(theta);
        turn(ts / STEPS, ((double)acts_V.alpha * c) + ((double)acts_V.beta * s),
             ((double)acts_V.beta * c) - ((double)acts_V.alpha * s));
    }
    const double length = hypot((double)answer.v_V.alpha, (double)answer.v_V.beta);
    const float  share  = (float)fmin(1.0, LINK_V / sqrt(3.0) / fmax(length, 1.0));
    acts_V.alpha        = share * answer.v_V.alpha;
    acts_V.beta         = share * answer.v_V.beta;
    most_A              = fmax(most_A, hypot(plant.id_A, plant.iq_A));
    most_radps          = fmax(most_radps, fabs(plant.motor_radps));
}

/* Until it ends, 100 s at most. */
static commission_step_t run(void)
{
    const ab_t          zero   = {0.0f, 0.0f};
    commission_answer_t answer = commission_rest(COMMISSION_BUSY);
    commission_signal_t s      = sample();

    acts_V        = zero;
    most_A        = 0.0;
    most_radps    = 0.0;
    most_twist_Nm = 0.0;
    commission_ring_start(&ring, &config, &s, &found);
    for (ticks = 0; (ticks < 500000) && (answer.step == COMMISSION_BUSY); ticks++) {
        s      = sample();
        answer = commission_ring_tick(&ring, &config, &s, &found);
        run_period(answer);
    }
    return answer.step;
}

static void expect_found(void)
{
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    TEST_ASSERT_EQUAL_INT(COMMISSION_COUPLING_ELASTIC, found.coupling);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * plant.resonance_Hz, plant.resonance_Hz,
                              found.resonance_Hz.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.15 * plant.damping, plant.damping, found.damping.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.03, plant.share, found.load_share.value);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 600.0, found.searched_Hz);
}

static double torque_at_bound(void)
{
    return 1.5 * PAIRS * FLUX_Wb * (double)config.current_max_A;
}

static void test_a_resonance_is_found_within_the_limits(void)
{
    static const double hz[] = {45.0, 150.0, 410.0};
    for (int16_t way = -1; way <= 1; way = (int16_t)(way + 2)) {
        for (int k = 0; k < SUPPORT_COUNT(hz); k++) {
            setUp();
            found.direction    = way;
            plant.resonance_Hz = hz[k];
            expect_found();
            TEST_ASSERT_TRUE(most_A < (0.8 * (double)config.current_max_A));
            TEST_ASSERT_TRUE(most_radps < (0.25 * (double)config.speed_max_m_radps));
            TEST_ASSERT_TRUE(most_twist_Nm < (1.5 * torque_at_bound()));
            TEST_ASSERT_TRUE((double)ticks * (double)config.ts_s < 60.0);
            TEST_ASSERT_DOUBLE_WITHIN(3.0, 0.0, plant.motor_radps);
        }
    }
}

/* A coupling of steel with hardly any damping: the coupling's torque stays near that of the motor. */
static void test_the_amplitude_follows_the_answer(void)
{
    plant.damping      = 0.005;
    plant.resonance_Hz = 250.0;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    TEST_ASSERT_EQUAL_INT(COMMISSION_COUPLING_ELASTIC, found.coupling);
    TEST_ASSERT_DOUBLE_WITHIN(2.5, 250.0, found.resonance_Hz.value);
    TEST_ASSERT_TRUE(most_twist_Nm < (2.5 * torque_at_bound()));
}

static void test_a_reluctance_motor_has_one_too(void)
{
    found.reluctance = true;
    expect_found();
    TEST_ASSERT_TRUE(most_A < (double)config.current_max_A);
}

static void expect_words(double hz, commission_coupling_t coupling)
{
    static const double dampings[] = {0.02, 0.1};
    for (int k = 0; k < SUPPORT_COUNT(dampings); k++) {
        setUp();
        plant.resonance_Hz = hz;
        plant.damping      = dampings[k];
        TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
        TEST_ASSERT_EQUAL_INT(coupling, found.coupling);
        TEST_ASSERT_TRUE((found.resonance_Hz.value == 0.0f) && (found.damping.value == 0.0f) &&
                         (found.load_share.value == 0.0f));
    }
}

static void test_what_is_outside_the_range_is_said(void)
{
    expect_words(30.0, COMMISSION_COUPLING_BELOW);
    expect_words(38.0, COMMISSION_COUPLING_BELOW);
    expect_words(12.0, COMMISSION_COUPLING_BELOW);
    expect_words(620.0, COMMISSION_COUPLING_ABOVE);
    expect_words(700.0, COMMISSION_COUPLING_ABOVE);
    expect_words(800.0, COMMISSION_COUPLING_ABOVE);
    expect_words(2500.0, COMMISSION_COUPLING_RIGID);
}

/* A flywheel: the counts hardly show an oscillation, and noise is no resonance. */
static void test_noise_ends_the_search_and_is_no_resonance(void)
{
    plant.light              = 60.0;
    plant.resonance_Hz       = 2500.0;
    found.inertia_kgm2.value = (float)(60.0 * INERTIA);
    config.speed_max_m_radps = 40.0f;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    TEST_ASSERT_TRUE(found.searched_Hz < 590.0f);
    TEST_ASSERT_EQUAL_INT((found.searched_Hz > 0.0f) ? COMMISSION_COUPLING_RIGID
                                                     : COMMISSION_COUPLING_UNKNOWN,
                          found.coupling);
}

/* On the grid of the search, with hardly any damping: the first block already swings far. */
static void test_the_first_block_of_a_frequency_is_small(void)
{
    plant.resonance_Hz = 44.1;
    plant.damping      = 0.005;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    printf("%g\n", most_radps);
    TEST_ASSERT_TRUE(most_radps < (0.3 * (double)config.speed_max_m_radps));
}

/* The range ends at eight periods of an oscillation; without a range nothing moves. */
static void test_a_slow_controller_searches_less_or_nothing(void)
{
    config.ts_s        = 1.0e-3f;
    plant.resonance_Hz = 70.0;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    TEST_ASSERT_EQUAL_INT(COMMISSION_COUPLING_ELASTIC, found.coupling);
    TEST_ASSERT_DOUBLE_WITHIN(1.3, 121.0, found.searched_Hz);
    setUp();
    config.ts_s = 3.0e-3f;
    TEST_ASSERT_EQUAL_INT(COMMISSION_DONE, run());
    TEST_ASSERT_EQUAL_INT(1, ticks);
    TEST_ASSERT_EQUAL_INT(COMMISSION_COUPLING_UNKNOWN, found.coupling);
}

static void test_a_held_shaft_ends_it(void)
{
    plant.drag_Nm = 10.0;
    TEST_ASSERT_EQUAL_INT(COMMISSION_FAILED, run());
    TEST_ASSERT_FALSE(ring.rings);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 10.0, (double)ticks * (double)config.ts_s);
}

/* A count that swings whatever the torque is, as of a coupling that slips. */
static void test_an_oscillation_beyond_its_limit_ends_it(void)
{
    const commission_signal_t s = sample();

    commission_ring_start(&ring, &config, &s, &found);
    ring.part                  = 1;
    ring.swing_A               = 0.1f;
    int                 ends   = 0;
    commission_answer_t answer = commission_rest(COMMISSION_BUSY);
    for (int k = 0; (k < 20000) && (answer.step == COMMISSION_BUSY); k++) {
        commission_signal_t now = s;
        now.position_cnt        = s.position_cnt + (((k / 62) % 2) * 1000);
        answer                  = commission_ring_tick(&ring, &config, &now, &found);
        ends                    = k;
    }
    TEST_ASSERT_EQUAL_INT(COMMISSION_FAILED, answer.step);
    TEST_ASSERT_TRUE(ring.rings);
    TEST_ASSERT_TRUE(ends < 5000);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_resonance_is_found_within_the_limits);
    RUN_TEST(test_the_amplitude_follows_the_answer);
    RUN_TEST(test_a_reluctance_motor_has_one_too);
    RUN_TEST(test_what_is_outside_the_range_is_said);
    RUN_TEST(test_noise_ends_the_search_and_is_no_resonance);
    RUN_TEST(test_the_first_block_of_a_frequency_is_small);
    RUN_TEST(test_a_slow_controller_searches_less_or_nothing);
    RUN_TEST(test_a_held_shaft_ends_it);
    RUN_TEST(test_an_oscillation_beyond_its_limit_ends_it);
    return UNITY_END();
}
