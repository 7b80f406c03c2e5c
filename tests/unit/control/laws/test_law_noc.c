/* SPDX-License-Identifier: MIT */
#include "law_noc.h"

#include "gain_tables.h"
#include "law_answer.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define CASES 2000

static support_random_t        random_state;
static const drive_config_t   *drive;
static const law_noc_config_t *config;
static law_state_t             state;
static law_noc_state_t *const  s = &state.noc;
static drive_sample_t          sample;
static law_input_t             in;

/* A motor's next sample: near what the observer expects. */
static void draw(void)
{
    const float angle    = s->theta_hat_rad + support_uniform(&random_state, -0.01f, 0.01f);
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
    drive              = &gain_tables_drive;
    config             = law_constants_noc(drive);
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
    const nodo_t     *x = &s->observer;
    TEST_ASSERT_TRUE((x->omega_e_radps == 300.0f) && (x->iq_A == y.iq_A) && (x->id_A == y.id_A));
    TEST_ASSERT_TRUE((x->d_omega == 0.0f) && (x->d_q == 0.0f) && (x->d_d == 0.0f));
    TEST_ASSERT_TRUE(s->theta_hat_rad == frames_wrap(5.0f)); /* -1.28 */
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
        law_noc_state_t           want  = *s;
        const float               error = encoder_form_error_rad(&sample, want.theta_hat_rad);
        const angle_gate_result_t angle =
            angle_gate_pass(&want.gate, &config->gate, sample.theta_e_rad, error,
                            want.observer.omega_e_radps, drive->ts_s);
        want.theta_hat_rad = frames_wrap(want.theta_hat_rad + angle.jump_rad);
        const dq_t i_A     = sample_current_A(&sample, want.theta_hat_rad);
        bool       knows   = true;
        if (want.gate.lost != 0) {
            knows = nodo_current_correct(&want.without, &want.observer, &want.theta_hat_rad,
                                         &config->currents, &drive->motor, i_A);
        } else {
            nodo_encoder_correct(&want.observer, &want.theta_hat_rad, &config->nodo, i_A,
                                 angle.innovation_rad, drive->ts_s);
        }
        nodo_encoder_predict(&want.observer, &want.theta_hat_rad, &drive->motor, in.v_V,
                             drive->ts_s);
        near_optimal_view_t view = encoder_form_view(
            &config->plausible, &want.observer, want.theta_hat_rad,
            ((want.gate.lost != 0) || (want.gate.beyond > 1)) ? 0.0f : error, drive->ts_s);
        view.plausible = view.plausible && knows;
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
            (s->theta_hat_rad == want.theta_hat_rad) &&
            (s->near_optimal.current_ref.i_dot_Aps.q == want.near_optimal.current_ref.i_dot_Aps.q));
        TEST_ASSERT_EQUAL_UINT16(want.gate.ignored, out.ignored_angles);
        TEST_ASSERT_TRUE(out.without_angle == want.gate.lost);
        TEST_ASSERT_TRUE(out.predicted != out.without_angle);
        if ((n % 50) == 49) { /* random samples drive the estimates away */
            start();
        }
    }
}

/* With any disturbance allowed, so that the angle alone decides. */
static void test_angle_far_from_its_estimate_is_not_plausible(void)
{
    test_constants_t     constants;
    const drive_config_t tolerant = law_constants_copy(&constants, drive);

    constants.noc.plausible.d_omega = 1.0e12f;
    for (int sign = -1; sign <= 1; sign += 2) {
        const float limit_rad = (float)sign * config->plausible.angle_rad;
        start();
        sample.theta_e_rad = s->theta_hat_rad + (0.99f * limit_rad);
        TEST_ASSERT_TRUE(law_answer(&tolerant, &state, &in).plausible);
        start();
        sample.theta_e_rad = s->theta_hat_rad + (1.01f * limit_rad);
        TEST_ASSERT_FALSE(law_answer(&tolerant, &state, &in).plausible);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_start_takes_over_the_sample_whatever_the_past);
    RUN_TEST(test_step_is_made_of_its_parts);
    RUN_TEST(test_angle_far_from_its_estimate_is_not_plausible);
    return UNITY_END();
}
