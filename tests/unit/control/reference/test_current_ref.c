/* SPDX-License-Identifier: MIT */
#include "current_ref.h"

#include "check.h"
#include "gain_tables.h"
#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_A        7.0e-5 /* A, currents up to 4 A; worst 1.4e-5 */
#define TOL_STEEP_A  7.0e-4 /* A where iq nearly touches the voltage circle; worst 1.4e-4 */
#define TOL_V        1.8e-4 /* V beyond the usable 161.5 V; worst 3.5e-5 */
#define TOL_CIRCLE_A 7.5e-7 /* A beyond the circle of 4 A; worst 1.5e-7 */
#define TOL_RADPS2   2.0e-3 /* rad/s^2, summands up to 4e3 rad/s^2; worst 4.1e-4 */
#define TOL_Aps      2.7e-3 /* A/s, currents up to 4 A over 1 ms; worst 5.3e-4 */
#define TOL_FILTER_A 8.0e-7 /* A; worst 1.7e-7 */

#define CASES   2000
#define V_MAX_V 170.0f
#define TS_s    2.0e-4

static support_random_t     random_state;
static current_ref_config_t config;
static motor_reduced_t      motor;
static support_motor_t      si;
static nodo_t               est;
static nodo_meas_t          y;
static speed_ref_t          w_ref;
static float                iq_speed_A;
static float                dc_link_V;
static float                d_omega_dot;
static current_ref_t        r;

static void use_filter(float per_period)
{
    config.mtpa_per_period      = per_period;
    config.weakening_per_period = per_period;
}

/* l6 times the voltage for steady currents. */
static float motor_Aps(void)
{
    return motor.l6 * (0.995f * V_MAX_V);
}

static void use_motor(motor_reduced_t m)
{
    const float saliency = fmaxf(1.0f - m.l10, 1.0e-9f);
    motor                = m;
    si                   = support_motor(&motor);
    config.mtpa_A        = m.l5 / (2.0f * saliency);
    config.mtpa_half_1pA = saliency / m.l5;
}

void setUp(void)
{
    const nodo_meas_t rest    = {0.0f, 0.0f, 0.0f};
    const nodo_t      nothing = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};

    random_state.state = 19u;
    config             = law_constants_near_optimal(&speed_tables_drive)->current_ref;
    use_filter(1.0f);                  /* id_ref is its target at once */
    config.regen_max_W_norm = 1.0e12f; /* regeneration has its own tests */
    use_motor(speed_tables_drive.motor);
    dc_link_V   = 295.0f;
    d_omega_dot = 0.0f;
    est         = nothing;
    y           = rest;
    iq_speed_A  = 0.0f;
    speed_ref_reset(&w_ref, 0.0f);
    current_ref_reset(&r, &config);
}

void tearDown(void) {}

/* Largest |iq| of the current circle beside i_A.d. */
static double circle_A(const current_ref_t *of)
{
    const double max_A = (double)config.current_max_A;
    return sqrt(fmax((max_A * max_A) - ((double)of->i_A.d * (double)of->i_A.d), 0.0));
}

static void update(void)
{
    const current_ref_input_t in = {.est         = &est,
                                    .state       = &y,
                                    .iq_speed_A  = iq_speed_A,
                                    .dc_link_V   = dc_link_V,
                                    .v_max_Aps   = motor_Aps(),
                                    .d_omega_dot = d_omega_dot};
    /* The tests set i_A.d themselves. */
    r.iq_circle_A = (float)circle_A(&r);
    current_ref_update(&r, &config, &motor, &w_ref, &in);
}

/* Sets the acceleration so that EQ-CURRENT-REF-1 asks for this q current. */
static void ask_for(double iq_A)
{
    const double torque_gain =
        fmax((double)motor.l1 + ((double)motor.l11 * (double)y.id_A), (double)config.l1_min);
    w_ref.omega_e_radps = y.omega_e_radps;
    w_ref.omega_dot_e_radps2 =
        (float)((iq_A * torque_gain) - ((double)motor.l2 * (double)y.omega_e_radps) +
                (double)est.d_omega);
    w_ref.accel_wanted_e_radps2 = w_ref.omega_dot_e_radps2;
}

/* Length of the voltage vector that holds (id, iq), by the motor's voltage equations in SI units.
 * The resistive drop is that of the measured currents. */
static double voltage_V(double id_A, double iq_A)
{
    const double w = (double)y.omega_e_radps;
    const double v_d =
        (si.rs_Ohm * (double)y.id_A) - (w * si.lq_H * iq_A) - (si.ld_H * (double)est.d_d);
    const double v_q = (si.rs_Ohm * (double)y.iq_A) + (w * (si.flux_Wb + (si.ld_H * id_A))) -
                       (si.lq_H * (double)est.d_q);
    return hypot(v_d, v_q);
}

static double usable_V(void)
{
    return (double)motor_Aps() / (double)motor.l6;
}

/* Radius of the circle for the d current, EQ-CURRENT-REF-3. */
static double weakening_V(void)
{
    return 0.965 * usable_V();
}

/* Bisects between a current that fits a voltage and one that does not. */
static double search(bool along_d, double other_A, double fits_A, double fails_A, double most_V)
{
    for (int halving = 0; halving < 60; halving++) {
        const double middle_A = 0.5 * (fits_A + fails_A);
        const double v_V = along_d ? voltage_V(middle_A, other_A) : voltage_V(other_A, middle_A);
        if (v_V <= most_V) {
            fits_A = middle_A;
        } else {
            fails_A = middle_A;
        }
    }
    return fits_A;
}

/* Torque for a q axis flux linkage of u amperes below the centre of the circle, resistance left out. */
static double torque_on_circle(double f_A, double u_A)
{
    const double id_A = -((double)motor.l5 + u_A) / (double)motor.l10;
    return sqrt(fmax((f_A * f_A) - (u_A * u_A), 0.0)) *
           ((double)motor.l5 + (((double)motor.l10 - 1.0) * id_A));
}

/* Maximum torque per volt by golden search over the voltage circle. */
static double oracle_mtpv_A(double f_A)
{
    double lo = 0.0;
    double hi = f_A;
    for (int n = 0; n < 120; n++) {
        const double left  = hi - (0.618034 * (hi - lo));
        const double right = lo + (0.618034 * (hi - lo));
        if (torque_on_circle(f_A, left) > torque_on_circle(f_A, right)) {
            hi = right;
        } else {
            lo = left;
        }
    }
    return 0.5 * (lo + hi);
}

/* Oracle: the id with the least flux weakening that fits, found in volts. Beyond a share of the
 * circle it is on the chord to no flux at the whole of it. It ends at maximum torque per volt. */
static double oracle_fw_A(double iq_A)
{
    const double w = (double)y.omega_e_radps;
    const double rest =
        (si.rs_Ohm * (double)y.iq_A) - (si.lq_H * (double)est.d_q) + (w * si.flux_Wb);
    const double least = -rest / (w * si.ld_H);
    const double g_A   = weakening_V() / (fabs(w) * si.lq_H);
    const double y_A = ((si.rs_Ohm * (double)y.id_A) - (si.ld_H * (double)est.d_d)) / (w * si.lq_H);
    const double from_A  = (double)config.chord_from * g_A;
    const double from_Wb = sqrt((g_A * g_A) - (from_A * from_A)) * si.lq_H;
    const double beyond  = (fabs(iq_A - y_A) - from_A) / (g_A - from_A); /* 1 at the whole circle */
    const double most_Wb = -oracle_mtpv_A(g_A) * si.lq_H;
    return (beyond < 0.0) ? search(true, iq_A, least, least + 1.0e3, weakening_V())
                          : least + (fmax(from_Wb * (1.0 - beyond), most_Wb) / si.ld_H);
}

static double oracle_id_A(double iq_before_A, double iq_wanted_A)
{
    const double k      = (double)config.mtpa_A;
    const double iq2    = iq_before_A * iq_before_A;
    const double mtpa_A = config.mtpa_exact ? (k - sqrt((k * k) + iq2)) : (-iq2 / (2.0 * k));
    const double fw_A   = oracle_fw_A(iq_wanted_A);
    return support_limit(fmin(mtpa_A, fw_A), -(double)config.current_max_A, 0.0);
}

/* Oracle: lowest (direction -1) or highest (+1) iq that fits the voltage at the measured id. */
static double oracle_iq_limit_A(double direction, double id_ref_A)
{
    const double w       = (double)y.omega_e_radps;
    const double id_A    = (double)y.id_A;
    const double least   = ((si.rs_Ohm * id_A) - (si.ld_H * (double)est.d_d)) / (w * si.lq_H);
    const double voltage = (voltage_V(id_A, least) <= usable_V())
                               ? search(false, id_A, least, least + (direction * 1.0e3), usable_V())
                               : least;
    const double i_max   = (double)config.current_max_A;
    const double current =
        fmin((double)config.iq_max_A, sqrt(fmax((i_max * i_max) - (id_ref_A * id_ref_A), 0.0)));
    return (direction > 0.0) ? support_limit(voltage, 0.0, current)
                             : support_limit(voltage, -current, 0.0);
}

static void draw_fast_case(void)
{
    const float speed = support_uniform(&random_state, 350.0f, 1500.0f);
    y.omega_e_radps   = (support_uniform(&random_state, -1.0f, 1.0f) < 0.0f) ? -speed : speed;
    y.iq_A            = support_uniform(&random_state, -4.0f, 4.0f);
    y.id_A            = support_uniform(&random_state, -4.0f, 1.0f);
    est.d_q           = support_uniform(&random_state, -300.0f, 300.0f);
    est.d_d           = support_uniform(&random_state, -300.0f, 300.0f);
    est.d_omega       = support_uniform(&random_state, -7000.0f, 7000.0f);
    r.i_A.q           = support_uniform(&random_state, -3.3f, 3.3f);
}

/* Whether the tangent to the voltage circle is steep enough to amplify rounding. */
static bool steep(double value_A, double shifted_A)
{
    return fabs(voltage_V(value_A, shifted_A) - usable_V()) < 0.05 * usable_V();
}

static void assert_inside_current_circle(void)
{
    const double beyond_A = support_length(r.i_A) - (double)config.current_max_A;
    TEST_ASSERT_DOUBLE_WITHIN(TOL_CIRCLE_A, 0.0, fmax(beyond_A, 0.0));
}

static void test_room_on_the_circle_is_told_for_the_next_period(void)
{
    use_filter(0.2f); /* id moves */
    for (int n = 0; n < CASES; n++) {
        draw_fast_case();
        update();
        TEST_ASSERT_DOUBLE_WITHIN(TOL_CIRCLE_A, circle_A(&r), (double)r.iq_circle_A);
    }
}

static void test_reset_starts_everything_at_zero(void)
{
    current_ref_t used = {{1.0f, 2.0f}, {3.0f, 4.0f}, 5.0f, 6.0f, 7.0f, 8.0f};

    current_ref_reset(&used, &config);

    TEST_ASSERT_TRUE((used.i_A.d == 0.0f) && (used.i_A.q == 0.0f));
    TEST_ASSERT_TRUE((used.iq_lo_A == 0.0f) && (used.iq_hi_A == 0.0f));
    TEST_ASSERT_TRUE(used.iq_circle_A == config.current_max_A); /* all of it is left */
    TEST_ASSERT_TRUE(used.v_low_Aps == CHECK_LARGEST);          /* the first voltage is the least */
    TEST_ASSERT_TRUE((used.i_dot_Aps.d == 0.0f) && (used.i_dot_Aps.q == 0.0f));
}

static void test_rest_without_disturbance_asks_for_no_current(void)
{
    update();

    TEST_ASSERT_TRUE((r.i_A.d == 0.0f) && (r.i_A.q == 0.0f));
    TEST_ASSERT_TRUE((r.i_dot_Aps.d == 0.0f) && (r.i_dot_Aps.q == 0.0f));
}

/* Oracle: of all (id, iq) with the same torque, the shortest, by golden search over id. */
static double shortest_A(double torque)
{
    double lo = -8.0;
    double hi = 0.0;
    for (int n = 0; n < 120; n++) {
        const double left     = hi - (0.618034 * (hi - lo));
        const double right    = lo + (0.618034 * (hi - lo));
        const double of_left  = torque / ((double)motor.l1 + ((double)motor.l11 * left));
        const double of_right = torque / ((double)motor.l1 + ((double)motor.l11 * right));
        if (hypot(left, of_left) < hypot(right, of_right)) {
            hi = right;
        } else {
            lo = left;
        }
    }
    const double id_A = 0.5 * (lo + hi);
    return hypot(id_A, torque / ((double)motor.l1 + ((double)motor.l11 * id_A)));
}

/* Worst share of current above the shortest one over the whole range of torque. */
static double mtpa_excess(void)
{
    double worst = 0.0;
    for (int step = -35; step <= 35; step++) {
        const double iq_A = 0.1 * (double)step;
        r.i_A.q           = (float)iq_A;
        update();
        const double id_A   = (double)r.i_A.d;
        const double torque = iq_A * ((double)motor.l1 + ((double)motor.l11 * id_A));
        if (step != 0) {
            worst = fmax(worst, (hypot(id_A, iq_A) / shortest_A(torque)) - 1.0);
        }
    }
    return worst;
}

static void test_id_at_low_speed_gives_the_most_torque_per_ampere(void)
{
    config.mtpa_exact = true;
    TEST_ASSERT_TRUE(mtpa_excess() < 1.0e-4);
}

static void test_second_order_id_costs_some_percent_more_current(void)
{
    config.mtpa_exact = false;
    TEST_ASSERT_TRUE(mtpa_excess() < 3.0e-2);
    TEST_ASSERT_TRUE(mtpa_excess() > 1.0e-4);
}

static void test_id_follows_the_mtpa_curve_of_the_previous_reference(void)
{
    for (int exact = 0; exact < 2; exact++) {
        config.mtpa_exact = (exact == 1);
        for (int step = -33; step <= 33; step++) {
            const double iq_A  = 0.1 * (double)step;
            const double k     = si.flux_Wb / (2.0 * (si.lq_H - si.ld_H));
            const double curve = k - sqrt((k * k) + (iq_A * iq_A));
            r.i_A.q            = (float)iq_A;
            y.iq_A             = 1.7f; /* the actual current has no say */

            update();

            TEST_ASSERT_DOUBLE_WITHIN(TOL_A, (exact == 1) ? curve : (-iq_A * iq_A / (2.0 * k)),
                                      (double)r.i_A.d);
        }
    }
}

/* EQ-CURRENT-REF-8: a motor with next to no magnet keeps some d current, and the curve beyond it. */
static void test_id_stays_at_rest_current_without_load(void)
{
    config.id_rest_A = -0.5f;

    update();
    TEST_ASSERT_TRUE(r.i_A.d == -0.5f);

    est.d_omega = -8000.0f; /* a load that takes more than 0.5 A of the curve */
    for (int n = 0; n < 3; n++) {
        update();
    }
    TEST_ASSERT_TRUE(r.i_A.d < -0.5f);

    config.id_rest_A = 0.5f;
    TEST_ASSERT_FALSE(current_ref_check(&config));
}

static void test_surface_magnet_motor_needs_no_id_at_low_speed(void)
{
    motor_reduced_t m = speed_tables_drive.motor;
    m.l10             = 1.0f;
    m.l9              = 1.0f;
    m.l11             = 0.0f;
    use_motor(m);
    r.i_A.q = 3.0f;

    update();

    TEST_ASSERT_TRUE(fabsf(r.i_A.d) < 1.0e-7f);
}

static void test_id_matches_search_in_volts_at_high_speed(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_fast_case();
        const double before_A = (double)r.i_A.q;
        const double wanted_A = (double)support_uniform(&random_state, -3.3f, 3.3f);
        r.i_A.d               = 0.0f; /* leaves the whole current to the wish */
        config.mtpa_exact     = (n % 2) == 0;
        ask_for(wanted_A);
        const double expected = oracle_id_A(before_A, wanted_A);

        update();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, expected, (double)r.i_A.d);
    }
}

static void test_id_makes_room_for_the_current_that_the_speed_error_asks_for(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_fast_case();
        const double before_A = (double)r.i_A.q;
        iq_speed_A            = support_uniform(&random_state, -6.0f, 6.0f);
        ask_for(0.5);
        r.i_A.d               = support_uniform(&random_state, -3.9f, 0.0f);
        const double limit_A  = sqrt(16.0 - ((double)r.i_A.d * (double)r.i_A.d));
        const double wanted_A = support_limit(0.5 + (double)iq_speed_A, -limit_A, limit_A);
        const double expected = oracle_id_A(before_A, wanted_A);

        update();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_STEEP_A, expected, (double)r.i_A.d);
    }
}

static void test_limits_of_iq_match_search_in_volts_at_high_speed(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_fast_case();
        ask_for((double)support_uniform(&random_state, -3.3f, 3.3f));

        update();

        const double lo_A = oracle_iq_limit_A(-1.0, (double)r.i_A.d);
        const double hi_A = oracle_iq_limit_A(1.0, (double)r.i_A.d);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_STEEP_A, lo_A, (double)r.iq_lo_A);
        TEST_ASSERT_DOUBLE_WITHIN(TOL_STEEP_A, hi_A, (double)r.iq_hi_A);
        if (!steep((double)y.id_A, 0.5 * (lo_A + hi_A))) {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_A, lo_A, (double)r.iq_lo_A);
            TEST_ASSERT_DOUBLE_WITHIN(TOL_A, hi_A, (double)r.iq_hi_A);
        }
    }
}

/* The references settle where a motor that follows them is on or inside the voltage circle. */
static void test_steady_references_need_no_more_than_the_usable_voltage(void)
{
    for (int speed = -1500; speed <= 1500; speed += 50) {
        for (int load = -3; load <= 3; load++) {
            setUp();
            use_filter(0.2f);
            y.omega_e_radps     = (float)speed;
            w_ref.omega_e_radps = (float)speed;
            est.d_omega         = 2500.0f * (float)load;
            for (int n = 0; n < 400; n++) {
                update();
                y.id_A += 0.2f * (r.i_A.d - y.id_A);
                y.iq_A += 0.2f * (r.i_A.q - y.iq_A);
            }

            const double v_V = voltage_V((double)r.i_A.d, (double)r.i_A.q);

            TEST_ASSERT_DOUBLE_WITHIN(TOL_V, 0.0, fmax(v_V - usable_V(), 0.0));
        }
    }
}

static void test_low_speed_ignores_the_voltage_circle(void)
{
    const double base_radps = usable_V() / si.flux_Wb;
    for (int sign = -1; sign <= 1; sign++) {
        y.omega_e_radps = (float)(0.249 * base_radps) * (float)sign;
        est.d_d         = 3.0e3f; /* more than the circle holds */

        update();

        TEST_ASSERT_TRUE((r.iq_hi_A == config.iq_max_A) && (r.iq_lo_A == -config.iq_max_A));
    }
}

static void test_voltage_circle_counts_from_a_quarter_of_the_base_speed(void)
{
    const double base_radps = usable_V() / si.flux_Wb;
    for (int sign = -1; sign <= 1; sign += 2) {
        y.omega_e_radps = (float)(0.251 * base_radps) * (float)sign;
        est.d_d         = 3.0e3f; /* more than the circle holds */

        update();

        TEST_ASSERT_TRUE((r.iq_hi_A == 0.0f) || (r.iq_lo_A == 0.0f));
    }
}

static void test_tiny_speeds_give_finite_references(void)
{
    static const float speeds[] = {0.0f, -0.0f, 1.0e-30f, -1.0e-30f, 1.0e-3f, -1.0e-3f};
    for (int i = 0; i < SUPPORT_COUNT(speeds); i++) {
        y.omega_e_radps = speeds[i];
        ask_for(1.0);

        update();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 1.0, (double)r.i_A.q);
        TEST_ASSERT_TRUE(isfinite(r.i_A.d));
    }
}

/* (40) put back into the speed equation of (4): the reference gives the wanted acceleration. */
static void test_iq_gives_the_wanted_acceleration(void)
{
    for (int n = 0; n < CASES; n++) {
        y.id_A                   = support_uniform(&random_state, -3.0f, 2.0f);
        w_ref.omega_e_radps      = support_uniform(&random_state, -300.0f, 300.0f);
        w_ref.omega_dot_e_radps2 = support_uniform(&random_state, -2.0e3f, 2.0e3f);
        est.d_omega              = support_uniform(&random_state, -2.0e3f, 2.0e3f);

        update();

        const double iq  = (double)r.i_A.q;
        const double dot = ((double)motor.l1 * iq) -
                           ((double)motor.l2 * (double)w_ref.omega_e_radps) +
                           ((double)motor.l11 * (double)y.id_A * iq) + (double)est.d_omega;
        TEST_ASSERT_DOUBLE_WITHIN(TOL_RADPS2, (double)w_ref.omega_dot_e_radps2, dot);
    }
}

static void test_positive_id_never_turns_the_division_round(void)
{
    for (int step = 0; step <= 100; step++) {
        y.id_A                   = 0.1f * (float)step; /* l1 + l11 id is zero at 4.96 A */
        w_ref.omega_dot_e_radps2 = 1000.0f;
        const double gain =
            fmax((double)motor.l1 + ((double)motor.l11 * (double)y.id_A), (double)config.l1_min);

        update();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_A, 1000.0 / gain, (double)r.i_A.q);
    }
}

static void test_references_never_leave_the_current_circle(void)
{
    use_filter(0.2f);
    for (int n = 0; n < 20 * CASES; n++) {
        const float iq_before_A = r.i_A.q;
        draw_fast_case();
        r.i_A.q         = iq_before_A;
        y.omega_e_radps = support_uniform(&random_state, -1500.0f, 1500.0f);
        iq_speed_A      = support_uniform(&random_state, -10.0f, 10.0f);
        ask_for((double)support_uniform(&random_state, -9.0f, 9.0f));

        update();

        assert_inside_current_circle();
        TEST_ASSERT_TRUE(fabsf(r.i_A.q) <= config.iq_max_A);
        TEST_ASSERT_TRUE(r.i_A.d <= 0.0f);
        TEST_ASSERT_TRUE((r.iq_lo_A <= 0.0f) && (r.iq_hi_A >= 0.0f));
        TEST_ASSERT_TRUE(base_in_range(r.i_A.q, r.iq_lo_A, r.iq_hi_A));
    }
}

static void test_large_demand_is_met_up_to_the_limit(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        ask_for(9.0 * (double)sign);

        update();

        TEST_ASSERT_TRUE(r.i_A.q == (float)sign * config.iq_max_A);
    }
}

static void test_full_weakening_leaves_no_q_current(void)
{
    config.current_max_A = 2.0f;
    config.iq_max_A      = 1.9f;
    y.omega_e_radps      = 1569.0f;
    y.id_A               = -2.0f;
    ask_for(1.0);

    update();

    TEST_ASSERT_TRUE((r.i_A.d == -2.0f) && (r.i_A.q == 0.0f));
}

/* Speed, q quantities and the disturbances of their equations mirrored: motoring stays motoring. */
static void test_reversed_rotation_mirrors_the_references(void)
{
    use_filter(0.2f);
    for (int n = 0; n < CASES; n++) {
        draw_fast_case();
        y.omega_e_radps     = support_uniform(&random_state, -1500.0f, 1500.0f);
        iq_speed_A          = support_uniform(&random_state, -2.0f, 2.0f);
        current_ref_t start = r;
        ask_for((double)support_uniform(&random_state, -3.0f, 3.0f));
        w_ref.omega_2dot_e_radps3 = support_uniform(&random_state, -4.0e6f, 4.0e6f);
        config.regen_max_W_norm   = support_uniform(&random_state, 0.0f, 2.0e6f);
        update();
        const current_ref_t forwards = r;

        r                           = start;
        r.i_A.q                     = -start.i_A.q;
        y.omega_e_radps             = -y.omega_e_radps;
        y.iq_A                      = -y.iq_A;
        est.d_omega                 = -est.d_omega;
        est.d_q                     = -est.d_q;
        iq_speed_A                  = -iq_speed_A;
        w_ref.omega_e_radps         = -w_ref.omega_e_radps;
        w_ref.omega_dot_e_radps2    = -w_ref.omega_dot_e_radps2;
        w_ref.accel_wanted_e_radps2 = -w_ref.accel_wanted_e_radps2;
        w_ref.omega_2dot_e_radps3   = -w_ref.omega_2dot_e_radps3;
        update();

        TEST_ASSERT_TRUE((r.i_A.d == forwards.i_A.d) && (r.i_A.q == -forwards.i_A.q));
        TEST_ASSERT_TRUE((r.iq_lo_A == -forwards.iq_hi_A) && (r.iq_hi_A == -forwards.iq_lo_A));
        TEST_ASSERT_TRUE(r.i_dot_Aps.q == -forwards.i_dot_Aps.q);
        r = forwards;
    }
}

/* First-order response to a constant target, (1 - (1 - k)^n). */
static void test_id_approaches_its_target_exponentially(void)
{
    use_filter(0.2f);
    y.omega_e_radps       = 1200.0f;
    const double target_A = oracle_id_A(0.0, 0.0);
    for (int n = 1; n <= 60; n++) {
        const double expected = target_A * (1.0 - pow(0.8, (double)n));

        ask_for(0.0);
        update();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_FILTER_A, expected, (double)r.i_A.d);
    }
}

static void test_derivative_of_id_is_its_difference_quotient(void)
{
    use_filter(0.2f);
    for (int n = 0; n < CASES; n++) {
        const double before_A = (double)r.i_A.d;
        const float  iq_A     = r.i_A.q;
        draw_fast_case();
        r.i_A.q = iq_A;
        ask_for((double)support_uniform(&random_state, -3.0f, 3.0f));

        update();

        TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, ((double)r.i_A.d - before_A) / TS_s,
                                  (double)r.i_dot_Aps.d);
    }
}

/* d/dt of EQ-CURRENT-REF-1, and none while a limit holds iq. */
static void test_derivative_of_iq_is_that_of_the_wanted_acceleration(void)
{
    int held = 0;
    for (int n = 0; n < CASES; n++) {
        y.id_A                    = support_uniform(&random_state, -3.0f, 2.0f);
        w_ref.omega_2dot_e_radps3 = support_uniform(&random_state, -4.0e6f, 4.0e6f);
        d_omega_dot               = support_uniform(&random_state, -4.0e6f, 4.0e6f);
        ask_for((double)support_uniform(&random_state, -5.0f, 5.0f));
        const double gain   = (double)motor.l1 + ((double)motor.l11 * (double)y.id_A);
        const double wanted = (double)w_ref.omega_2dot_e_radps3 - (double)d_omega_dot;

        update();

        if ((r.i_A.q == r.iq_lo_A) || (r.i_A.q == r.iq_hi_A)) {
            TEST_ASSERT_TRUE(r.i_dot_Aps.q == 0.0f);
            held++;
        } else {
            TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, wanted / gain, (double)r.i_dot_Aps.q);
        }
    }
    TEST_ASSERT_TRUE((held > 100) && (held < CASES - 100));
}

/* Mechanical power into the dc link, divided by J / np^2, of both ends of the range of iq. */
static void test_regeneration_never_feeds_back_more_than_allowed(void)
{
    config = law_constants_near_optimal(&gain_tables_drive)->current_ref;
    for (int n = 0; n < 5 * CASES; n++) {
        draw_fast_case();
        y.omega_e_radps         = support_uniform(&random_state, -1500.0f, 1500.0f);
        config.regen_max_W_norm = support_uniform(&random_state, 0.0f, 3.0e6f);
        dc_link_V               = support_uniform(&random_state, 300.0f, 390.0f);
        ask_for((double)support_uniform(&random_state, -5.0f, 5.0f));
        const double share = support_limit(
            1.0 - ((double)config.regen_per_V * ((double)dc_link_V - (double)config.regen_start_V)),
            0.0, 1.0);
        const double allowed = share * (double)config.regen_max_W_norm;
        const double torque_gain =
            fmax((double)motor.l1 + ((double)motor.l11 * (double)y.id_A), (double)config.l1_min);

        update();

        const double w      = (double)y.omega_e_radps;
        const float  ends[] = {r.iq_lo_A, r.iq_hi_A, r.i_A.q};
        for (int k = 0; k < SUPPORT_COUNT(ends); k++) {
            const double power = -(double)ends[k] * w * torque_gain;
            TEST_ASSERT_TRUE(power <= (allowed * (1.0 + 1.0e-5)) + 5.0);
        }
    }
}

static void test_full_dc_link_takes_nothing_back_but_leaves_motoring(void)
{
    config.regen_max_W_norm = 1.0e6f;
    dc_link_V               = config.regen_start_V + (1.01f / config.regen_per_V);
    for (int sign = -1; sign <= 1; sign += 2) {
        y.omega_e_radps = 150.0f * (float)sign;

        update();

        TEST_ASSERT_TRUE(((sign > 0) ? r.iq_lo_A : r.iq_hi_A) == 0.0f);
        TEST_ASSERT_TRUE(((sign > 0) ? r.iq_hi_A : -r.iq_lo_A) == config.iq_max_A);
    }
}

/* Across base speed, where the circle begins to count, and zero speed: small steps give small changes. Where
 * id takes nearly the whole current, iq is a root without a bound of its slope. */
static void test_references_are_continuous_in_the_speed(void)
{
    config = law_constants_near_optimal(&gain_tables_drive)->current_ref;
    use_filter(1.0f);
    for (int load = -3; load <= 3; load++) {
        dq_t before_A = {0.0f, 0.0f};
        for (int step = -12000; step <= 12000; step++) {
            y.omega_e_radps = 0.1f * (float)step;
            y.id_A          = -0.5f;
            y.iq_A          = (float)load;
            r.i_A.q         = (float)load;
            r.i_A.d         = 0.0f;
            ask_for((double)load);

            update();

            if (step > -12000) {
                TEST_ASSERT_TRUE(fabsf(r.i_A.d - before_A.d) < 6.0e-2f);
                TEST_ASSERT_TRUE((r.i_A.d < -3.9f) || (fabsf(r.i_A.q - before_A.q) < 3.0e-2f));
            }
            before_A = r.i_A;
        }
    }
}

/* EQ-CURRENT-REF-1 at the ends of the range of iq, and the jerk of the free voltage. */
static void test_speed_limits_are_the_accelerations_of_the_current_range(void)
{
    for (int n = 0; n < CASES; n++) {
        draw_fast_case();
        config.torque_share  = support_uniform(&random_state, 0.1f, 1.0f);
        r.i_A.d              = support_uniform(&random_state, -4.0f, 0.0f);
        r.iq_lo_A            = support_uniform(&random_state, -3.3f, 0.0f);
        r.iq_hi_A            = support_uniform(&random_state, 0.0f, 3.3f);
        const float  command = support_uniform(&random_state, -1500.0f, 1500.0f);
        const double gain    = ((double)motor.l1 + ((double)motor.l11 * (double)r.i_A.d)) *
                            (double)config.torque_share;
        const double free_radps2 =
            (double)est.d_omega - ((double)motor.l2 * (double)y.omega_e_radps);
        const double highest   = fmax((double)y.omega_e_radps, (double)command);
        const double lowest    = fmin((double)y.omega_e_radps, (double)command);
        const double up_V      = usable_V() - (si.flux_Wb * highest); /* left for diq/dt > 0 */
        const double down_V    = usable_V() + (si.flux_Wb * lowest);
        const float  v_max_Aps = motor_Aps();
        const current_ref_input_t in = {&est, &y, iq_speed_A, dc_link_V, v_max_Aps, 0.0f, 0.0f};

        const speed_ref_limits_t limits =
            current_ref_speed_limits(&r, &config, &motor, &in, command);

        TEST_ASSERT_DOUBLE_WITHIN(1.0e-2, fmax(free_radps2 + (gain * (double)r.iq_hi_A), 0.0),
                                  (double)limits.accel_hi_e_radps2);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-2, fmin(free_radps2 + (gain * (double)r.iq_lo_A), 0.0),
                                  (double)limits.accel_lo_e_radps2);
        const double per_V = (double)motor.l1 / si.lq_H;
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, fmin(fmax(up_V / usable_V(), 0.4), 1.0),
                                  (double)limits.jerk_up_e_radps3 / (per_V * usable_V()));
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-5, fmin(fmax(down_V / usable_V(), 0.4), 1.0),
                                  (double)limits.jerk_down_e_radps3 / (per_V * usable_V()));
        TEST_ASSERT_TRUE(limits.near_e_radps == config.near_e_radps);
    }
}

/* Without resistance and disturbance, a wish beyond the circle settles at maximum torque per volt. */
static void test_wish_beyond_the_circle_ends_at_maximum_torque_per_volt(void)
{
    config.current_max_A = 60.0f;
    config.iq_max_A      = 60.0f;
    for (int speed = 400; speed <= 1500; speed += 100) {
        y.omega_e_radps   = (float)speed;
        const double f_A  = weakening_V() / ((double)speed * si.lq_H);
        const double id_A = -(si.flux_Wb + (oracle_mtpv_A(f_A) * si.lq_H)) / si.ld_H;
        r.i_A.d           = 0.0f;
        ask_for(30.0);

        update();

        TEST_ASSERT_DOUBLE_WITHIN(1.0e-4, id_A, (double)r.i_A.d);
    }
}

static void test_steady_references_have_no_derivative(void)
{
    use_filter(0.2f);
    y.omega_e_radps = 900.0f;
    ask_for(1.0);

    for (int n = 0; n < 400; n++) {
        update();
    }

    TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, 0.0, (double)r.i_dot_Aps.d);
    TEST_ASSERT_DOUBLE_WITHIN(TOL_Aps, 0.0, (double)r.i_dot_Aps.q);
}

static void test_bad_estimates_give_finite_references_inside_the_circle(void)
{
    for (int i = 0; i < SUPPORT_COUNT(support_not_finite); i++) {
        float *const fields[] = {&est.d_omega,
                                 &est.d_q,
                                 &est.d_d,
                                 &iq_speed_A,
                                 &w_ref.omega_e_radps,
                                 &w_ref.omega_dot_e_radps2,
                                 &w_ref.accel_wanted_e_radps2,
                                 &dc_link_V};
        for (int k = 0; k < SUPPORT_COUNT(fields); k++) {
            for (int speed = 0; speed <= 1200; speed += 600) {
                setUp();
                y.omega_e_radps = (float)speed;
                *fields[k]      = support_not_finite[i];

                update();

                assert_inside_current_circle();
                TEST_ASSERT_TRUE(isfinite(r.i_dot_Aps.d) && isfinite(r.i_dot_Aps.q));
                TEST_ASSERT_TRUE(base_in_range(r.iq_lo_A, -config.iq_max_A, 0.0f));
                TEST_ASSERT_TRUE(base_in_range(r.iq_hi_A, 0.0f, config.iq_max_A));
            }
        }
    }
}

/* EQ-CURRENT-REF-10: a drop acts at once, a rise a share per period, and the iq range has the present voltage. */
static void test_weakening_has_the_least_voltage_of_the_last_periods(void)
{
    const float share = 1.0f / 64.0f;
    double      low   = 0.0;

    y.omega_e_radps = 900.0f;
    use_filter(share);
    for (int k = 0; k < 400; k++) {
        const double              ripple = 1.0 + (0.3 * sin(0.1 * k)) + ((k > 200) ? -0.4 : 0.0);
        const float               v_max  = (float)ripple * motor_Aps();
        const current_ref_input_t in     = {
                .est = &est, .state = &y, .dc_link_V = dc_link_V, .v_max_Aps = v_max};
        low = (k == 0) ? (double)v_max : fmin(fmax(low, 0.8 * (double)v_max), (double)v_max);

        /* The same with a constant link of that voltage, and no range of iq. */
        current_ref_t             steady = r;
        const current_ref_input_t same   = {
              .est = &est, .state = &y, .dc_link_V = dc_link_V, .v_max_Aps = (float)low};
        steady.v_low_Aps = CHECK_LARGEST;
        current_ref_update(&steady, &config, &motor, &w_ref, &same);
        current_ref_update(&r, &config, &motor, &w_ref, &in);

        TEST_ASSERT_DOUBLE_WITHIN(2.0e-5, (double)steady.i_A.d, (double)r.i_A.d);
        low += (double)share * ((double)v_max - low);
        TEST_ASSERT_DOUBLE_WITHIN(1.0e-6 * (double)v_max, low, (double)r.v_low_Aps);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_room_on_the_circle_is_told_for_the_next_period);
    RUN_TEST(test_reset_starts_everything_at_zero);
    RUN_TEST(test_rest_without_disturbance_asks_for_no_current);
    RUN_TEST(test_id_at_low_speed_gives_the_most_torque_per_ampere);
    RUN_TEST(test_second_order_id_costs_some_percent_more_current);
    RUN_TEST(test_id_follows_the_mtpa_curve_of_the_previous_reference);
    RUN_TEST(test_id_stays_at_rest_current_without_load);
    RUN_TEST(test_surface_magnet_motor_needs_no_id_at_low_speed);
    RUN_TEST(test_id_matches_search_in_volts_at_high_speed);
    RUN_TEST(test_id_makes_room_for_the_current_that_the_speed_error_asks_for);
    RUN_TEST(test_limits_of_iq_match_search_in_volts_at_high_speed);
    RUN_TEST(test_steady_references_need_no_more_than_the_usable_voltage);
    RUN_TEST(test_low_speed_ignores_the_voltage_circle);
    RUN_TEST(test_voltage_circle_counts_from_a_quarter_of_the_base_speed);
    RUN_TEST(test_tiny_speeds_give_finite_references);
    RUN_TEST(test_iq_gives_the_wanted_acceleration);
    RUN_TEST(test_positive_id_never_turns_the_division_round);
    RUN_TEST(test_references_never_leave_the_current_circle);
    RUN_TEST(test_large_demand_is_met_up_to_the_limit);
    RUN_TEST(test_full_weakening_leaves_no_q_current);
    RUN_TEST(test_reversed_rotation_mirrors_the_references);
    RUN_TEST(test_id_approaches_its_target_exponentially);
    RUN_TEST(test_derivative_of_id_is_its_difference_quotient);
    RUN_TEST(test_derivative_of_iq_is_that_of_the_wanted_acceleration);
    RUN_TEST(test_regeneration_never_feeds_back_more_than_allowed);
    RUN_TEST(test_full_dc_link_takes_nothing_back_but_leaves_motoring);
    RUN_TEST(test_references_are_continuous_in_the_speed);
    RUN_TEST(test_speed_limits_are_the_accelerations_of_the_current_range);
    RUN_TEST(test_wish_beyond_the_circle_ends_at_maximum_torque_per_volt);
    RUN_TEST(test_steady_references_have_no_derivative);
    RUN_TEST(test_bad_estimates_give_finite_references_inside_the_circle);
    RUN_TEST(test_weakening_has_the_least_voltage_of_the_last_periods);
    return UNITY_END();
}
