/* SPDX-License-Identifier: MIT */
#include "law_noc_shaft.h"

#include "gain_tables.h"
#include "law_answer.h"
#include "law_constants.h"
#include "shaft_tables.h"
#include "unit_support.h"
#include "unity.h"

#define CASES 2000

static support_random_t              random_state;
static const drive_config_t         *drive;
static const law_noc_shaft_config_t *config;
static law_state_t                   state;
static law_noc_shaft_state_t *const  s = &state.noc_shaft;
static drive_sample_t                sample;
static law_input_t                   in;

/* A motor's next sample: near what the observer expects. */
static void draw(void)
{
    const float angle    = s->observer.theta_rad + support_uniform(&random_state, -0.01f, 0.01f);
    sample.theta_e_rad   = frames_wrap(angle);
    sample.ia_A          = support_uniform(&random_state, -2.0f, 2.0f);
    sample.ib_A          = support_uniform(&random_state, -2.0f, 2.0f);
    sample.dc_link_V     = support_uniform(&random_state, 200.0f, 398.0f);
    sample.omega_e_radps = support_uniform(&random_state, -900.0f, 900.0f);
    in.command_e_radps   = support_uniform(&random_state, -900.0f, 900.0f);
    in.v_V.d             = support_uniform(&random_state, -100.0f, 100.0f);
    in.v_V.q             = support_uniform(&random_state, -100.0f, 100.0f);
}

static void start(void)
{
    const drive_sample_t at = {.ia_A          = 0.4f,
                               .ib_A          = -0.3f,
                               .dc_link_V     = 295.0f,
                               .theta_e_rad   = 5.0f,
                               .omega_e_radps = 300.0f,
                               .valid         = true};

    sample = at;
    drive->law->reset(&state, drive, &sample);
}

void setUp(void)
{
    const law_input_t of_sample = {
        .sample = &sample, .command_e_radps = 310.0f, .v_V = {.d = 0.0f, .q = 0.0f}};

    random_state.state = 61u;
    drive              = &shaft_tables_drive;
    config             = law_constants_noc_shaft(drive);
    in                 = of_sample;
    start();
}

void tearDown(void) {}

static void test_start_takes_over_the_sample_whatever_the_past(void)
{
    for (int n = 0; n < 20; n++) {
        draw();
        (void)law_answer(drive, &state, &in);
    }

    start();

    const nodo_meas_t y = sample_measurement(&sample);
    const nodo_t     *x = &s->observer.motor;
    TEST_ASSERT_TRUE((x->omega_e_radps == 300.0f) && (x->iq_A == y.iq_A) && (x->id_A == y.id_A));
    TEST_ASSERT_TRUE((x->d_omega == 0.0f) && (x->d_q == 0.0f) && (x->d_d == 0.0f));
    TEST_ASSERT_TRUE((s->observer.load_e_radps == 300.0f) && (s->observer.twist_rad == 0.0f));
    TEST_ASSERT_TRUE(s->observer.theta_rad == frames_wrap(5.0f));
    TEST_ASSERT_TRUE(s->near_optimal.speed_ref.omega_e_radps == 300.0f);
}

/* The law by its parts, in the order of a period. `shaft_A` is EQ-SHAFT-3 in double precision. */
static law_output_t by_parts(law_noc_shaft_state_t *want, float rare_share, float innovation_rad,
                             float error_rad, double *shaft_A, double *allowed_A)
{
    const law_noc_shaft_feedback_t *f   = &config->shaft;
    nodo_shaft_t                   *o   = &want->observer;
    const dq_t                      i_A = sample_current_A(&sample, o->theta_rad);

    nodo_shaft_correct(o, &config->nodo, i_A, rare_share * innovation_rad, drive->ts_s);
    nodo_shaft_predict(o, &config->nodo, &drive->motor, in.v_V, drive->ts_s);
    near_optimal_view_t view =
        encoder_form_view(&config->plausible, &o->motor, o->theta_rad, error_rad, drive->ts_s);
    view.plausible = view.plausible && (want->gate.lost == 0);
    nosc_error_t e =
        near_optimal_error(&want->near_optimal, &config->near_optimal, drive, &view, &in);

    const current_ref_t *ref     = &want->near_optimal.current_ref;
    const double         slip    = (double)o->load_e_radps - (double)o->motor.omega_e_radps;
    const double         accel   = (double)want->near_optimal.speed_ref.omega_dot_e_radps2;
    const double         at_rest = (double)f->twist_per_accel *
                           (accel - ((double)f->accel_per_d_omega * (double)o->motor.d_omega));
    const double asked = -((double)f->slip_A_per_radps * slip) -
                         ((double)f->twist_A_per_rad * ((double)o->twist_rad - at_rest));
    const double iq = (double)ref->i_A.q - ((double)config->near_optimal.nosc.speed_A_per_radps *
                                            (double)e.omega_e_radps);
    *shaft_A        = asked;
    *allowed_A      = support_limit(asked, fmin((double)ref->iq_lo_A - iq, 0.0),
                                    fmax((double)ref->iq_hi_A - iq, 0.0));
    e.iq_A -= (float)*allowed_A;
    const dq_t   fb = nosc_feedback_V(&config->near_optimal.nosc, &e);
    law_output_t all;
    near_optimal_answer(&want->near_optimal, &config->near_optimal, &drive->motor, &view, &e, fb,
                        &in, &all);
    return all;
}

static void test_step_is_made_of_its_parts(void)
{
    int limited = 0;
    int free    = 0;

    for (int n = 0; n < CASES; n++) {
        draw();
        law_noc_shaft_state_t     want  = *s;
        const float               error = encoder_form_error_rad(&sample, want.observer.theta_rad);
        const angle_gate_result_t angle =
            angle_gate_pass(&want.gate, &config->gate, sample.theta_e_rad, error,
                            want.observer.motor.omega_e_radps, drive->ts_s);
        want.observer.theta_rad = frames_wrap(want.observer.theta_rad + angle.jump_rad);
        double             asked_A;
        double             allowed_A;
        const law_output_t all =
            by_parts(&want, 1.0f, angle.innovation_rad, error, &asked_A, &allowed_A);

        const law_output_t out = law_answer(drive, &state, &in);

        limited += (fabs(asked_A - allowed_A) > 1.0e-3) ? 1 : 0;
        free += ((fabs(asked_A) > 0.1) && (fabs(asked_A - allowed_A) < 1.0e-6)) ? 1 : 0;
        TEST_ASSERT_FLOAT_WITHIN(2.0e-3f, all.v_V.q, out.v_V.q);
        TEST_ASSERT_FLOAT_WITHIN(2.0e-3f, all.v_V.d, out.v_V.d);
        TEST_ASSERT_TRUE((out.theta_rad == all.theta_rad) && (out.plausible == all.plausible));
        TEST_ASSERT_TRUE((out.d_omega == all.d_omega) && (out.d_q == all.d_q) &&
                         (out.d_d == all.d_d));
        TEST_ASSERT_TRUE((s->observer.load_e_radps == want.observer.load_e_radps) &&
                         (s->observer.twist_rad == want.observer.twist_rad));
        TEST_ASSERT_EQUAL_UINT16(want.gate.ignored, out.ignored_angles);
        TEST_ASSERT_EQUAL(want.gate.lost != 0, out.without_angle);
        TEST_ASSERT_FALSE(out.predicted);
        if ((n % 20) == 19) { /* random samples drive the estimates away */
            start();
        }
    }
    TEST_ASSERT_TRUE(limited > 20);
    TEST_ASSERT_TRUE(free > 20);
}

/* Edges that come less often than samples correct with gains of their own first. */
static void test_rare_edges_have_gains_of_their_own(void)
{
    for (int n = 0; n < 200; n++) {
        start();
        draw();
        sample.edge_gap_s              = support_uniform(&random_state, 1.5f, 20.0f) * drive->ts_s;
        law_noc_shaft_state_t     want = *s;
        const angle_gate_result_t angle =
            encoder_form_innovation(&want.gate, &want.edges, &config->gate, &sample,
                                    &want.observer.motor, want.observer.theta_rad, drive->ts_s);
        const dq_t  i_A = sample_current_A(&sample, want.observer.theta_rad);
        const float left =
            encoder_form_correct_rare(&want.observer.motor, &want.observer.theta_rad, &config->rare,
                                      angle.innovation_rad, sample.edge_gap_s, drive->ts_s);
        nodo_shaft_correct(&want.observer, &config->nodo, i_A, left * angle.innovation_rad,
                           drive->ts_s);
        nodo_shaft_predict(&want.observer, &config->nodo, &drive->motor, in.v_V, drive->ts_s);

        (void)law_answer(drive, &state, &in);
        TEST_ASSERT_TRUE((s->observer.theta_rad == want.observer.theta_rad) &&
                         (s->observer.motor.omega_e_radps == want.observer.motor.omega_e_radps) &&
                         (s->observer.twist_rad == want.observer.twist_rad));
        sample.edge_gap_s = 0.0f;
    }
}

static void test_angle_far_from_its_estimate_is_not_plausible(void)
{
    law_noc_shaft_config_t tolerant = *config;
    drive_config_t         copy     = *drive;

    copy.constants             = &tolerant;
    tolerant.plausible.d_omega = 1.0e12f;
    for (int sign = -1; sign <= 1; sign += 2) {
        const float limit_rad = (float)sign * config->plausible.angle_rad;
        start();
        sample.theta_e_rad = s->observer.theta_rad + (0.99f * limit_rad);
        TEST_ASSERT_TRUE(law_answer(&copy, &state, &in).plausible);
        start();
        sample.theta_e_rad = s->observer.theta_rad + (1.01f * limit_rad);
        TEST_ASSERT_FALSE(law_answer(&copy, &state, &in).plausible);
    }
}

static void test_check_refuses_positions_and_wrong_constants(void)
{
    law_noc_shaft_config_t bad       = *config;
    drive_config_t         copy      = *drive;
    float *const           numbers[] = {&bad.shaft.slip_A_per_radps,
                                        &bad.shaft.twist_A_per_rad,
                                        &bad.shaft.twist_per_accel,
                                        &bad.shaft.accel_per_d_omega,
                                        &bad.nodo.step[1][2],
                                        &bad.plausible.d_omega,
                                        &bad.rare.theta,
                                        &bad.gate.count_rad};

    copy.constants = &bad;
    TEST_ASSERT_TRUE(copy.law->check(&copy));
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const float good = *numbers[i];
        *numbers[i]      = NAN;
        TEST_ASSERT_FALSE(copy.law->check(&copy));
        *numbers[i] = good;
    }
    bad.shaft.twist_per_accel = -1.0f;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    bad.shaft = config->shaft;
    TEST_ASSERT_TRUE(copy.law->counts_ok(&copy));
    bad.nodo.motor.order = 2;
    TEST_ASSERT_FALSE(copy.law->counts_ok(&copy));
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    bad.nodo.motor.order      = 1;
    copy.positions            = true; /* with gains that are in range for noc */
    bad.near_optimal.position = law_constants_noc(&gain_tables_drive)->near_optimal.position;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_start_takes_over_the_sample_whatever_the_past);
    RUN_TEST(test_step_is_made_of_its_parts);
    RUN_TEST(test_rare_edges_have_gains_of_their_own);
    RUN_TEST(test_angle_far_from_its_estimate_is_not_plausible);
    RUN_TEST(test_check_refuses_positions_and_wrong_constants);
    return UNITY_END();
}
