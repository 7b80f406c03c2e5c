/* SPDX-License-Identifier: MIT */
#include "law_noc_h.h"

#include "harmonic_tables.h"
#include "law_answer.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define CASES 2000

static support_random_t          random_state;
static const drive_config_t     *drive;
static const law_noc_h_config_t *config;
static law_state_t               state;
static law_noc_h_state_t *const  s = &state.noc_h;
static drive_sample_t            sample;
static law_input_t               in;

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

    random_state.state = 53u;
    drive              = &harmonic_tables_drive;
    config             = law_constants_noc_h(drive);
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
    const nodo_t     *x = &s->observer.base;
    TEST_ASSERT_TRUE((x->omega_e_radps == 300.0f) && (x->iq_A == y.iq_A) && (x->id_A == y.id_A));
    TEST_ASSERT_TRUE((x->d_omega == 0.0f) && (x->d_q == 0.0f) && (x->d_d == 0.0f));
    TEST_ASSERT_TRUE(s->observer.theta_rad == frames_wrap(5.0f)); /* -1.28 */
    TEST_ASSERT_TRUE((s->observer.slope == 0.0f) && (s->observer.pair[0].a == 0.0f));
    TEST_ASSERT_TRUE((s->known.d_omega_dot == 0.0f) && (s->known.total.d_omega == 0.0f) &&
                     (s->known.total.omega_e_radps == 300.0f));
    TEST_ASSERT_TRUE(s->near_optimal.speed_ref.omega_e_radps == 300.0f);
    TEST_ASSERT_TRUE((s->near_optimal.current_ref.i_A.d == 0.0f) &&
                     (s->near_optimal.current_ref.i_A.q == 0.0f));
}

/* Order of a period: correct with this sample in the frame of the estimated angle, then predict
 * with the acting voltage. References, feedback and feed-forward follow on the prediction. */
static void test_step_is_made_of_its_parts(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();
        law_noc_h_state_t         want  = *s;
        const float               error = encoder_form_error_rad(&sample, want.observer.theta_rad);
        const angle_gate_result_t angle =
            angle_gate_pass(&want.gate, &config->gate, sample.theta_e_rad, error,
                            want.observer.base.omega_e_radps, drive->ts_s);
        want.observer.theta_rad = frames_wrap(want.observer.theta_rad + angle.jump_rad);
        const dq_t i_A          = sample_current_A(&sample, want.observer.theta_rad);
        nodo_harmonic_correct(&want.observer, &config->nodo, i_A, angle.innovation_rad);
        nodo_harmonic_view_t known;
        nodo_harmonic_predict(&want.observer, &config->nodo, &drive->motor, in.v_V, drive->ts_s,
                              &known);
        near_optimal_view_t view = encoder_form_view(&config->plausible, &known.total,
                                                     want.observer.theta_rad, error, drive->ts_s);
        view.d_omega_dot         = known.d_omega_dot;
        view.plausible           = view.plausible && (want.gate.lost == 0);
        const nosc_error_t e =
            near_optimal_error(&want.near_optimal, &config->near_optimal, drive, &view, &in);
        const dq_t   fb = nosc_feedback_V(&config->near_optimal.nosc, &e);
        law_output_t all;
        near_optimal_answer(&want.near_optimal, &config->near_optimal, &drive->motor, &view, &e, fb,
                            &in, &all);

        const law_output_t out = law_answer(drive, &state, &in);

        TEST_ASSERT_TRUE((out.v_V.d == all.v_V.d) && (out.v_V.q == all.v_V.q));
        TEST_ASSERT_TRUE((out.theta_rad == all.theta_rad) && (out.plausible == all.plausible));
        TEST_ASSERT_TRUE((out.d_omega == all.d_omega) && (out.d_q == all.d_q) &&
                         (out.d_d == all.d_d));
        TEST_ASSERT_TRUE((out.now.omega_e_radps == all.now.omega_e_radps) &&
                         (out.now.iq_A == all.now.iq_A) && (out.now.id_A == all.now.id_A));
        TEST_ASSERT_TRUE(
            (s->observer.theta_rad == want.observer.theta_rad) &&
            (s->near_optimal.current_ref.i_dot_Aps.q == want.near_optimal.current_ref.i_dot_Aps.q));
        TEST_ASSERT_EQUAL_UINT16(want.gate.ignored, out.ignored_angles);
        if ((n % 50) == 49) { /* random samples drive the estimates away */
            start();
        }
    }
}

/* Edges that come less often than samples correct with gains of their own first, and with what those leave of the error. */
static void test_rare_edges_have_gains_of_their_own(void)
{
    for (int n = 0; n < 200; n++) {
        start();
        draw();
        sample.edge_gap_s              = support_uniform(&random_state, 1.5f, 20.0f) * drive->ts_s;
        law_noc_h_state_t         want = *s;
        const angle_gate_result_t angle =
            encoder_form_innovation(&want.gate, &want.edges, &config->gate, &sample,
                                    &want.observer.base, want.observer.theta_rad, drive->ts_s);
        const dq_t  i_A = sample_current_A(&sample, want.observer.theta_rad);
        const float share =
            encoder_form_correct_rare(&want.observer.base, &want.observer.theta_rad, &config->rare,
                                      angle.innovation_rad, sample.edge_gap_s, drive->ts_s);
        nodo_harmonic_view_t known;
        nodo_harmonic_correct(&want.observer, &config->nodo, i_A, share * angle.innovation_rad);
        nodo_harmonic_predict(&want.observer, &config->nodo, &drive->motor, in.v_V, drive->ts_s,
                              &known);

        (void)law_answer(drive, &state, &in);

        TEST_ASSERT_TRUE((s->observer.theta_rad == want.observer.theta_rad) &&
                         (s->observer.base.omega_e_radps == want.observer.base.omega_e_radps) &&
                         (s->observer.base.d_omega == want.observer.base.d_omega));
        sample.edge_gap_s = 0.0f;
    }
}

/* With any disturbance allowed, so that the angle alone decides. */
static void test_angle_far_from_its_estimate_is_not_plausible(void)
{
    test_constants_t     constants;
    const drive_config_t tolerant = law_constants_copy(&constants, drive);

    constants.noc_h.plausible.d_omega = 1.0e12f;
    for (int sign = -1; sign <= 1; sign += 2) {
        const float limit_rad = (float)sign * config->plausible.angle_rad;
        start();
        sample.theta_e_rad = s->observer.theta_rad + (0.99f * limit_rad);
        TEST_ASSERT_TRUE(law_answer(&tolerant, &state, &in).plausible);
        start();
        sample.theta_e_rad = s->observer.theta_rad + (1.01f * limit_rad);
        TEST_ASSERT_FALSE(law_answer(&tolerant, &state, &in).plausible);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_start_takes_over_the_sample_whatever_the_past);
    RUN_TEST(test_step_is_made_of_its_parts);
    RUN_TEST(test_rare_edges_have_gains_of_their_own);
    RUN_TEST(test_angle_far_from_its_estimate_is_not_plausible);
    return UNITY_END();
}
