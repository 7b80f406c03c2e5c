/* SPDX-License-Identifier: MIT */
#include "encoder_form.h"

#include "unit_support.h"
#include "unity.h"

#define TOL_RAD 3.3e-6 /* rad, angles up to 9.3 rad; worst 6.6e-7 */
#define TS_s    2.0e-4f

static encoder_form_limits_t limits;
static nodo_t                est;

void setUp(void)
{
    support_random_t random_state = {.state = 43u};

    limits.angle_rad = 0.45f;
    limits.d_omega   = 2.0e4f;
    est              = support_random_estimate(&random_state);
    est.d_omega      = -1.5e4f;
}

void tearDown(void) {}

static bool plausible(float angle_error_rad)
{
    return encoder_form_view(&limits, &est, 1.0f, angle_error_rad, TS_s).plausible;
}

static void test_angle_error_is_measured_minus_estimated(void)
{
    drive_sample_t sample = {.valid = true};

    for (int measured = -62; measured <= 62; measured++) {
        for (int estimated = -31; estimated <= 31; estimated++) {
            const float hat    = 0.1f * (float)estimated;
            sample.theta_e_rad = 0.1f * (float)measured;
            const double want  = (double)sample.theta_e_rad - (double)hat;

            const float e = encoder_form_error_rad(&sample, hat);

            TEST_ASSERT_TRUE(base_within(e, BASE_PI));
            TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, 0.0,
                                      remainder((double)e - want, 2.0 * 3.141592653589793));
        }
    }
}

/* Inside the band the sample knows nothing better; beyond, the error is that to its edge. */
static void test_angle_error_is_less_the_band(void)
{
    drive_sample_t sample = {.theta_e_rad = 3.1f, .band_rad = 0.01f, .valid = true};

    for (int n = -100; n <= 100; n++) {
        const double hat  = (double)sample.theta_e_rad - (0.001 * n);
        const double want = fmax(fabs(0.001 * n) - (double)sample.band_rad, 0.0);
        const float  e    = encoder_form_error_rad(&sample, (float)hat);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, copysign(want, n), (double)e);
    }
}

static encoder_form_gains_t gains = {
    .theta = 0.8f, .omega_1ps = 1700.0f, .d_omega_1ps2 = 4.7e5f, .count_rad = 1.2566371e-3f};

static void test_rare_edges_are_those_further_apart_than_samples(void)
{
    drive_sample_t sample = {.edge_gap_s = TS_s};
    TEST_ASSERT_FALSE(encoder_form_is_rare(&sample, TS_s));
    sample.edge_gap_s = nextafterf(TS_s, 1.0f);
    TEST_ASSERT_TRUE(encoder_form_is_rare(&sample, TS_s));
    sample.edge_gap_s = 0.0f;
    TEST_ASSERT_FALSE(encoder_form_is_rare(&sample, TS_s));
}

/* EQ-ENCODER-FORM-2 in double. */
static void check_rare_edges(double one_k_d)
{
    static const double gaps_s[] = {2.0e-4, 3.0e-4, 5.0e-4, 1.0e-3, 1.0e-2, 0.1, 1.0};
    static const float  speeds[] = {0.0f, 0.5f, -3.0f, 6.2f, 6.4f, -50.0f};
    const double        most     = fmin(fmax(one_k_d * (double)TS_s * (double)TS_s, 0.15), 0.5);
    const double        count    = 2.0 * 2.0 * 3.141592653589793 / 10000.0;
    for (int i = 0; i < SUPPORT_COUNT(gaps_s) * SUPPORT_COUNT(speeds); i++) {
        const double gap    = gaps_s[i / SUPPORT_COUNT(speeds)];
        const double w0     = (double)speeds[i % SUPPORT_COUNT(speeds)];
        const double moving = (w0 == 0.0) ? gap : (count / fabs(w0));
        const double T      = fmax(fmin(gap, moving), (double)TS_s);
        const double ratio  = T / (double)TS_s;
        const bool   dense  = fabs(w0) * (double)TS_s >= count; /* the gains of one sample */
        const double s_w    = fmin(fmax(0.33 * ratio, 0.5), 1.0);
        nodo_t       x      = est;
        float        theta  = 0.3f;
        x.omega_e_radps     = (float)w0;

        const double share =
            (double)encoder_form_correct_rare(&x, &theta, &gains, -0.004f, (float)gap, TS_s);

        const double k_d = share * one_k_d;
        const double k_w = (share * 1700.0) + ((w0 - (double)x.omega_e_radps) / 0.004);
        const double k_t = (share * 0.8) + ((0.3 - (double)theta) / 0.004);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5 * k_d,
                                  dense ? one_k_d : fmin(one_k_d * ratio, most / (T * T)), k_d);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-2 + fabs(w0 * 1.0e-4),
                                  dense ? 1700.0 : fmin(1700.0 * ratio, s_w / T), k_w);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, dense ? 0.8 : fmin(0.8 * ratio, 1.0), k_t);
        TEST_ASSERT_TRUE((x.iq_A == est.iq_A) && (x.id_A == est.id_A) && (x.d_q == est.d_q) &&
                         (x.d_d == est.d_d) && (x.d_omega == est.d_omega));
    }
}

static void test_rare_edges_correct_as_their_time_allows(void)
{
    static const float k_d[] = {4.7e5f, 2.5e6f,
                                3.0e7f}; /* below, within and beyond the range of s */

    for (int i = 0; i < SUPPORT_COUNT(k_d); i++) {
        gains.d_omega_1ps2 = k_d[i];
        check_rare_edges((double)k_d[i]);
    }
}

/* A shaft at constant speed far below one edge per period, started with a wrong speed and load: the estimate comes to it. */
static void test_rare_edges_find_a_slow_speed(void)
{
    const double per_count = 2.0 * 2.0 * 3.141592653589793 / 10000.0;
    const double w         = 0.4; /* an edge every 16 periods */
    nodo_t       x         = {.omega_e_radps = 1.0f, .d_omega = 40.0f};
    float        hat       = 0.0f;
    double       edge_s    = 0.0;
    double       theta     = 0.0;
    for (int n = 1; n < 20000; n++) {
        const double   before = theta;
        drive_sample_t sample = {.valid = true};
        theta += w * (double)TS_s;
        hat = frames_wrap(hat + (TS_s * (x.omega_e_radps + (0.5f * TS_s * x.d_omega))));
        x.omega_e_radps += TS_s * x.d_omega;
        const double count = floor(theta / per_count);
        edge_s += (double)TS_s;
        if (count > floor(before / per_count)) {
            const double age   = (theta - (count * per_count)) / w;
            sample.theta_e_rad = (float)fmod(theta, 6.283185307179586);
            sample.edge_gap_s  = (float)(edge_s - age);
            edge_s             = age;
        } else {
            sample.theta_e_rad = (float)fmod((count + 0.5) * per_count, 6.283185307179586);
            sample.band_rad    = (float)(0.5 * per_count);
            sample.edge_gap_s  = (float)edge_s;
        }
        const float e = encoder_form_error_rad(&sample, hat);
        const float used =
            e * encoder_form_correct_rare(&x, &hat, &gains, e, sample.edge_gap_s, TS_s);
        x.d_omega += gains.d_omega_1ps2 * used;
        x.omega_e_radps += gains.omega_1ps * used;
        hat = frames_wrap(hat + (gains.theta * used));
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.01, w, (double)x.omega_e_radps);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 0.0, (double)x.d_omega);
}

/* A shaft at constant speed [count/s] whose edges are off, timed at every sample. */
typedef struct {
    const double *off_cnt; /* of the 16 edges, mean zero */
    double        per_s;
    double        at_cnt;
    double        time_s;
    double        edge_s; /* of the last edge sampled */
    double        edge_cnt;
} disc_t;

#define COUNT_RAD (2.0 * 2.0 * 3.141592653589793 / 10000.0)

static int edge_of(double edge_cnt)
{
    return (int)fmod(fmod(edge_cnt, 16.0) + 16.0, 16.0);
}

static double edge_at_cnt(const disc_t *d, double edge_cnt)
{
    return edge_cnt + d->off_cnt[edge_of(edge_cnt)];
}

/* The next sample; theta is the one that the edges seem to say. */
static drive_sample_t next_sample(disc_t *d)
{
    const double way = (d->per_s > 0.0) ? 1.0 : -1.0;
    d->time_s += (double)TS_s;
    d->at_cnt += d->per_s * (double)TS_s;
    double edge = d->edge_cnt;
    while (((edge_at_cnt(d, edge + way) - d->at_cnt) * way) <= 0.0) {
        edge += way;
    }
    const double   age    = (d->at_cnt - edge_at_cnt(d, edge)) / d->per_s;
    const double   edge_s = d->time_s - age;
    drive_sample_t s      = {.edge_gap_s = (float)(d->time_s - d->edge_s)};
    if (fabs(edge - d->edge_cnt) > 0.5) {
        const double gap   = edge_s - d->edge_s;
        const double speed = (edge - d->edge_cnt) / gap;
        /* whole turns away: exact in single precision */
        s.theta_e_rad     = (float)(fmod(edge + (speed * age), 5000.0) * COUNT_RAD);
        s.omega_e_radps   = (float)(speed * COUNT_RAD);
        s.edge_gap_s      = (float)gap;
        s.edge_age_s      = (float)age;
        s.edge_of_pattern = (int16_t)(edge_of(edge) + 1);
        d->edge_cnt       = edge;
        d->edge_s         = edge_s;
    }
    return s;
}

/* The same in every line, and different in all four lines. */
static const double line_cnt[ENCODER_FORM_EDGES] = {-0.20, 0.05, 0.12,  0.03, -0.20, 0.05,
                                                    0.12,  0.03, -0.20, 0.05, 0.12,  0.03,
                                                    -0.20, 0.05, 0.12,  0.03};
static const double own_cnt[ENCODER_FORM_EDGES]  = {-0.14, 0.05,  0.12, 0.01,  0.16,  -0.11,
                                                    0.02,  -0.07, 0.09, -0.04, -0.13, 0.17,
                                                    0.06,  -0.08, 0.03, -0.14};

/* Turns a disc for some periods. Returns the largest error of what the edges say in the last 2000 [count]. */
static double left_after(encoder_form_edges_t *edges, const double *off_cnt, double per_period,
                         int periods)
{
    disc_t d    = {.off_cnt  = off_cnt,
                   .per_s    = per_period / (double)TS_s,
                   .at_cnt   = 1000.3,
                   .edge_cnt = 1000.0};
    double left = 0.0;

    encoder_form_edges_reset(edges);
    for (int n = 0; n < periods; n++) {
        const drive_sample_t s = next_sample(&d);
        const double         off =
            (double)encoder_form_learn(edges, &s, (float)COUNT_RAD, TS_s) / COUNT_RAD;
        if ((n >= (periods - 2000)) && (s.edge_of_pattern != 0)) {
            const double seen = ((double)s.theta_e_rad / COUNT_RAD) - fmod(d.at_cnt, 5000.0);
            left              = fmax(left, fabs(remainder(seen, 5000.0) - off));
        }
    }
    return left;
}

/* EQ-ENCODER-FORM-3: at speeds that meet the edges in different orders, from one edge in three samples on. An edge is early
 * in the angle when it lies late. Places that a speed meets one after another are learned most slowly. With 47.75 edges
 * per period the next sample has the same edge or the one before it. */
static void test_edges_of_the_pattern_are_learned(void)
{
    static const struct {
        double per_period;
        double line_left_cnt; /* after 0.6 s; 0.2 at the start */
        double own_left_cnt;  /* after 4.8 s; 0.17 at the start */
    } speeds[] = {{47.75, 0.015, 0.005}, {-47.75, 0.015, 0.005}, {13.3, 0.001, 0.004},
                  {2.6, 0.001, 0.001},   {101.1, 0.001, 0.002},  {31.2, 0.001, 0.01},
                  {1.6, 0.001, 0.03},    {-1.6, 0.001, 0.03},    {0.4, 0.001, 0.3},
                  {-0.4, 0.001, 0.3}}; /* slow: lines stay the same */
    encoder_form_edges_t edges;

    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        const double per_period = speeds[i].per_period;
        TEST_ASSERT_DOUBLE_WITHIN(speeds[i].line_left_cnt, 0.0,
                                  left_after(&edges, line_cnt, per_period, 3000));
        TEST_ASSERT_DOUBLE_WITHIN(speeds[i].own_left_cnt, 0.0,
                                  left_after(&edges, own_cnt, per_period, 24000));
    }
}

/* Whole patterns per period meet one edge only: there is nothing to tell it from the others, and nothing is made up. */
static void test_one_edge_alone_teaches_nothing(void)
{
    disc_t               d = {.off_cnt = own_cnt, .per_s = 32.0 / (double)TS_s, .at_cnt = 0.5};
    encoder_form_edges_t edges;
    encoder_form_edges_reset(&edges);
    for (int n = 0; n < 1000; n++) {
        const drive_sample_t s   = next_sample(&d);
        const float          off = encoder_form_learn(&edges, &s, (float)COUNT_RAD, TS_s);
        TEST_ASSERT_FLOAT_WITHIN((n > 2) ? 4.0e-6f : 2.0e-4f, 0.0f, off);
    }
}

/* A shaft that turns round, stops or starts is no witness: its speed is not the same between all three edges. */
static void test_edges_far_apart_and_reversals_teach_nothing(void)
{
    static const struct {
        float gap_s;
        float omega_e_radps;
    } last[] = {{4.1f * TS_s, 3.0f}, {TS_s, -3.0f}, {0.2f * TS_s, 3.0f}, {3.0f * TS_s, 0.0f}};
    for (int i = 0; i < SUPPORT_COUNT(last); i++) {
        const float          gap_s = (i == 0) ? (3.0f * TS_s) : ((i == 3) ? (0.7f * TS_s) : TS_s);
        encoder_form_edges_t edges;
        encoder_form_edges_reset(&edges);
        for (int n = 0; n < 3; n++) {
            const drive_sample_t s = {.edge_gap_s      = (n < 2) ? gap_s : last[i].gap_s,
                                      .omega_e_radps   = (n < 2) ? 2.0f : last[i].omega_e_radps,
                                      .edge_of_pattern = (int16_t)(n + 1)};
            (void)encoder_form_learn(&edges, &s, 1.0e-3f, TS_s);
        }
        for (int k = 0; k < ENCODER_FORM_LINE; k++) {
            TEST_ASSERT_FLOAT_WITHIN(1.0e-12f, 0.0f, edges.offset_rad[k]);
        }
    }
}

/* Samples without an edge, edges that do not exist, and a shaft that jumps leave offsets within half a count. */
static void test_learned_offsets_are_bounded(void)
{
    support_random_t     random = {.state = 7u};
    encoder_form_edges_t edges;
    encoder_form_edges_reset(&edges);
    for (int n = 0; n < 100000; n++) {
        const drive_sample_t s   = {.omega_e_radps = support_uniform(&random, -100.0f, 500.0f),
                                    .edge_gap_s    = support_uniform(&random, 0.0f, 2.0f * TS_s),
                                    .edge_age_s    = support_uniform(&random, 0.0f, TS_s),
                                    .edge_of_pattern =
                                        (int16_t)support_uniform(&random, -3.0f, 20.0f)};
        const float          off = encoder_form_learn(&edges, &s, 1.0e-3f, TS_s);
        TEST_ASSERT_TRUE(base_within(off, 2.0e-3f));
        TEST_ASSERT_TRUE(((s.edge_of_pattern >= 1) && (s.edge_of_pattern <= ENCODER_FORM_EDGES)) ||
                         (off == 0.0f));
        const int used = (n < ENCODER_FORM_EDGES * 10) ? ENCODER_FORM_LINE : ENCODER_FORM_EDGES;
        for (int k = 0; k < used; k++) {
            TEST_ASSERT_TRUE(base_within(edges.offset_rad[k], 0.5e-3f));
        }
    }
}

/* EQ-ENCODER-FORM-4: the places divide a turn, and they are as many as 16 allows. */
static void test_places_divide_a_turn(void)
{
    for (uint32_t edges = 4u; edges <= 65532u; edges += 4u) {
        const uint16_t places = encoder_form_places(edges);
        TEST_ASSERT_TRUE((places == 4u) || (places == 8u) || (places == 16u));
        TEST_ASSERT_EQUAL_UINT(0u, edges % places);
        TEST_ASSERT_TRUE((places == 16u) || ((edges % (2u * places)) != 0u));
    }
}

static void test_gains_out_of_range_are_refused(void)
{
    float *const fields[] = {&gains.theta, &gains.omega_1ps, &gains.d_omega_1ps2, &gains.count_rad};
    TEST_ASSERT_TRUE(encoder_form_gains_check(&gains));
    for (int i = 0; i < SUPPORT_COUNT(fields); i++) {
        const float good  = *fields[i];
        const float bad[] = {NAN, INFINITY, -INFINITY, 0.0f, -1.0f};
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            *fields[i] = bad[k];
            TEST_ASSERT_FALSE(encoder_form_gains_check(&gains));
        }
        *fields[i] = good;
    }
    gains.theta = 1.1f;
    TEST_ASSERT_FALSE(encoder_form_gains_check(&gains));
    gains.theta = 0.8f;
}

static void test_view_is_the_prediction(void)
{
    const near_optimal_view_t v = encoder_form_view(&limits, &est, 1.0f, 0.1f, TS_s);

    TEST_ASSERT_TRUE(v.est == &est);
    TEST_ASSERT_TRUE((v.now.omega_e_radps == est.omega_e_radps) && (v.now.iq_A == est.iq_A) &&
                     (v.now.id_A == est.id_A));
    TEST_ASSERT_TRUE(v.d_omega_dot == 0.0f);
    TEST_ASSERT_TRUE(v.plausible);
}

/* EQ-DRIVE-2: the prediction is of the instant at which the voltage takes effect, for one period. */
static void test_middle_angle_is_half_a_period_after_the_prediction(void)
{
    for (int speed = -1500; speed <= 1500; speed += 250) {
        est.omega_e_radps = (float)speed;

        const near_optimal_view_t v = encoder_form_view(&limits, &est, -2.5f, 0.1f, TS_s);

        TEST_ASSERT_DOUBLE_WITHIN(TOL_RAD, -2.5 + (1.0e-4 * (double)speed), (double)v.theta_rad);
    }
}

static void test_angle_is_plausible_up_to_its_limit(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        TEST_ASSERT_TRUE(plausible((float)sign * 0.45f));
        TEST_ASSERT_FALSE(plausible((float)sign * nextafterf(0.45f, 1.0f)));
    }
    TEST_ASSERT_TRUE(plausible(0.0f));
}

static void test_disturbance_is_plausible_up_to_its_limit(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        est.d_omega = (float)sign * 2.0e4f;
        TEST_ASSERT_TRUE(plausible(0.1f));
        est.d_omega = (float)sign * nextafterf(2.0e4f, INFINITY);
        TEST_ASSERT_FALSE(plausible(0.1f));
    }
}

static void test_not_a_number_is_not_plausible(void)
{
    TEST_ASSERT_FALSE(plausible(NAN));
    est.d_omega = NAN;
    TEST_ASSERT_FALSE(plausible(0.0f));
}

static void test_check_of_the_limits(void)
{
    const float angles[]     = {1.0e-6f, 0.45f, BASE_PI};
    const float bad_angles[] = {0.0f, 0.99e-6f, -0.45f, 3.1416f, NAN, INFINITY};
    const float bad_others[] = {0.0f, -1.0f, 1.0e13f, NAN, INFINITY};

    for (int i = 0; i < SUPPORT_COUNT(angles); i++) {
        limits.angle_rad = angles[i];
        TEST_ASSERT_TRUE(encoder_form_check(&limits));
    }
    for (int i = 0; i < SUPPORT_COUNT(bad_angles); i++) {
        limits.angle_rad = bad_angles[i];
        TEST_ASSERT_FALSE(encoder_form_check(&limits));
    }
    limits.angle_rad = 0.45f;
    for (int i = 0; i < SUPPORT_COUNT(bad_others); i++) {
        limits.d_omega = bad_others[i];
        TEST_ASSERT_FALSE(encoder_form_check(&limits));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angle_error_is_measured_minus_estimated);
    RUN_TEST(test_angle_error_is_less_the_band);
    RUN_TEST(test_rare_edges_are_those_further_apart_than_samples);
    RUN_TEST(test_rare_edges_correct_as_their_time_allows);
    RUN_TEST(test_rare_edges_find_a_slow_speed);
    RUN_TEST(test_edges_of_the_pattern_are_learned);
    RUN_TEST(test_places_divide_a_turn);
    RUN_TEST(test_one_edge_alone_teaches_nothing);
    RUN_TEST(test_edges_far_apart_and_reversals_teach_nothing);
    RUN_TEST(test_learned_offsets_are_bounded);
    RUN_TEST(test_gains_out_of_range_are_refused);
    RUN_TEST(test_view_is_the_prediction);
    RUN_TEST(test_middle_angle_is_half_a_period_after_the_prediction);
    RUN_TEST(test_angle_is_plausible_up_to_its_limit);
    RUN_TEST(test_disturbance_is_plausible_up_to_its_limit);
    RUN_TEST(test_not_a_number_is_not_plausible);
    RUN_TEST(test_check_of_the_limits);
    return UNITY_END();
}
