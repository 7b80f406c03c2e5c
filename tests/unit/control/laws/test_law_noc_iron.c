/* SPDX-License-Identifier: MIT */
#include "law_noc_iron.h"

#include "gain_tables.h"
#include "iron_tables.h"
#include "law_answer.h"
#include "law_constants.h"
#include "unit_support.h"
#include "unity.h"

#define CASES 2000

static support_random_t             random_state;
static const drive_config_t        *drive;
static const law_noc_iron_config_t *config;
static law_state_t                  state;
static law_noc_iron_state_t *const  s = &state.noc_iron;
static drive_sample_t               sample;
static law_input_t                  in;

/* A motor's next sample: near what the observer expects. */
static void draw(void)
{
    const float angle    = s->theta_hat_rad + support_uniform(&random_state, -0.01f, 0.01f);
    sample.theta_e_rad   = frames_wrap(angle);
    sample.ia_A          = support_uniform(&random_state, -3.0f, 3.0f);
    sample.ib_A          = support_uniform(&random_state, -3.0f, 3.0f);
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

    random_state.state = 67u;
    drive              = &iron_tables_drive;
    config             = drive->constants;
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

    const nodo_meas_t    y = sample_measurement(&sample);
    const nodo_t        *x = &s->observer;
    const iron_tangent_t t = iron_tangent(&config->iron, &drive->motor, y.id_A, y.iq_A);
    TEST_ASSERT_TRUE((x->omega_e_radps == 300.0f) && (x->iq_A == y.iq_A) && (x->id_A == y.id_A));
    TEST_ASSERT_TRUE((x->d_omega == 0.0f) && (x->d_q == 0.0f) && (x->d_d == 0.0f));
    TEST_ASSERT_TRUE(s->theta_hat_rad == frames_wrap(5.0f));
    TEST_ASSERT_TRUE(s->near_optimal.speed_ref.omega_e_radps == 300.0f);
    TEST_ASSERT_TRUE((s->tangent.motor.l6 == t.motor.l6) && (s->tangent.psi_q_Wb == t.psi_q_Wb));
}

/* The law by its parts, in the order of a period; EQ-IRON-3 and 4 in double precision. */
static law_output_t by_parts(law_noc_iron_state_t *want)
{
    const float               error = encoder_form_error_rad(&sample, want->theta_hat_rad);
    const angle_gate_result_t angle =
        angle_gate_pass(&want->gate, &config->gate, sample.theta_e_rad, error,
                        want->observer.omega_e_radps, drive->ts_s);
    want->theta_hat_rad = frames_wrap(want->theta_hat_rad + angle.jump_rad);
    const dq_t i_A      = sample_current_A(&sample, want->theta_hat_rad);
    bool       knows    = true;
    if (want->gate.lost != 0) {
        knows = nodo_current_correct(&want->without, &want->observer, &want->theta_hat_rad,
                                     &config->currents, &want->tangent.motor, i_A);
    } else {
        nodo_encoder_correct(&want->observer, &want->theta_hat_rad, &config->nodo, i_A,
                             angle.innovation_rad, drive->ts_s);
    }
    const iron_tangent_t before = want->tangent;
    nodo_t               seen   = want->observer;
    iron_predict(&seen, &want->theta_hat_rad, &config->iron, &before, in.v_V, drive->ts_s);
    want->tangent            = iron_tangent(&config->iron, &drive->motor, seen.id_A, seen.iq_A);
    const double lq          = (double)want->tangent.motor.inv_l6;
    const double ld          = (double)want->tangent.motor.inv_l8;
    const nodo_t x           = {.d_omega = want->observer.d_omega,
                                .d_q = (float)((double)want->observer.d_q * (double)before.motor.inv_l6 / lq),
                                .d_d = (float)((double)want->observer.d_d * (double)before.motor.inv_l8 / ld),
                                .omega_e_radps = seen.omega_e_radps,
                                .iq_A          = seen.iq_A,
                                .id_A          = seen.id_A};
    want->observer           = x;
    const bool          held = (want->gate.lost != 0) || (want->gate.beyond > 1);
    near_optimal_view_t view = encoder_form_view(
        &config->plausible, &want->observer, want->theta_hat_rad, held ? 0.0f : error, drive->ts_s);
    view.plausible = view.plausible && knows;

    const double          q_share = lq / (double)drive->motor.inv_l6;
    const double          d_share = ld / (double)drive->motor.inv_l8;
    near_optimal_config_t law     = config->near_optimal;
    drive_config_t        iron    = *drive;
    nodo_t                est     = iron_estimates(&config->iron, &want->tangent, &want->observer);
    law.current_ref.circle_ApVs   = (float)((double)law.current_ref.circle_ApVs / q_share);
    law.current_ref.flux_A        = (float)((double)law.current_ref.flux_A / q_share);
    law.current_ref.l1_min        = (float)((double)law.current_ref.l1_min * fmin(q_share, 1.0));
    law.nosc.lambda[0][0][1]      = (float)((double)law.nosc.lambda[0][0][1] * q_share);
    iron.motor                    = want->tangent.motor;
    view.est                      = &est;
    const nosc_error_t e = near_optimal_error(&want->near_optimal, &law, &iron, &view, &in);
    const dq_t         u = nosc_feedback_V(&config->near_optimal.nosc, &e);
    const double       m = (double)want->tangent.m_H;
    const dq_t         v = {
                .d = (float)(((double)u.d * d_share) + (m * (double)drive->motor.l6 * (double)u.q)),
                .q = (float)(((double)u.q * q_share) + (m * (double)drive->motor.l8 * (double)u.d))};
    law_output_t all;
    near_optimal_answer(&want->near_optimal, &law, &iron.motor, &view, &e, v, &in, &all);
    return all;
}

static void close_to(double want, double got, double scale)
{
    TEST_ASSERT_DOUBLE_WITHIN(2.0e-4 * (fabs(want) + scale), want, got);
}

static void test_step_is_made_of_its_parts(void)
{
    for (int n = 0; n < CASES; n++) {
        draw();
        law_noc_iron_state_t want = *s;
        const law_output_t   all  = by_parts(&want);
        const law_output_t   out  = law_answer(drive, &state, &in);

        close_to((double)all.v_V.d, (double)out.v_V.d, 10.0);
        close_to((double)all.v_V.q, (double)out.v_V.q, 10.0);
        TEST_ASSERT_TRUE((out.theta_rad == all.theta_rad) && (out.plausible == all.plausible));
        close_to((double)want.observer.d_omega, (double)out.d_omega, 1.0);
        close_to((double)want.observer.d_q, (double)out.d_q, 1.0);
        close_to((double)want.observer.d_d, (double)out.d_d, 1.0);
        TEST_ASSERT_TRUE((out.now.omega_e_radps == all.now.omega_e_radps) &&
                         (out.now.iq_A == all.now.iq_A) && (out.now.id_A == all.now.id_A));
        TEST_ASSERT_TRUE((s->observer.iq_A == want.observer.iq_A) &&
                         (s->observer.d_omega == want.observer.d_omega));
        TEST_ASSERT_TRUE(s->theta_hat_rad == want.theta_hat_rad);
        TEST_ASSERT_TRUE(out.without_angle == want.gate.lost);
        TEST_ASSERT_TRUE(out.predicted != out.without_angle);
        TEST_ASSERT_EQUAL_UINT16(want.gate.ignored, out.ignored_angles);
        if ((n % 25) == 24) { /* random samples drive the estimates away */
            start();
        }
    }
}

/* The map of constant inductances. */
static iron_map_t constant_iron(const drive_config_t *of)
{
    const motor_reduced_t *m   = &of->motor;
    iron_map_t             map = config->iron;
    const float            pm  = m->l5 * m->inv_l6;

    for (int i = 0; i < IRON_NODES_D; i++) {
        for (int j = 0; j < IRON_NODES_Q; j++) {
            float *node      = map.node[i][j];
            node[IRON_PSI_D] = pm - (m->inv_l8 * map.A_per_node_d * (float)i);
            node[IRON_PSI_Q] = m->inv_l6 * map.A_per_node_q * (float)j;
            node[IRON_LD]    = m->inv_l8;
            node[IRON_LQ]    = m->inv_l6;
            node[IRON_LDQ]   = 0.0f;
        }
    }
    return map;
}

/* The oracle is law_noc: a motor without saturation is its motor. */
static void test_constant_inductances_give_the_answers_of_noc(void)
{
    static law_noc_iron_config_t constants;
    const law_noc_config_t      *plain  = law_constants_noc(&gain_tables_drive);
    drive_config_t               mapped = gain_tables_drive;
    law_state_t                  other;

    constants.near_optimal = plain->near_optimal;
    constants.plausible    = plain->plausible;
    constants.gate         = plain->gate;
    constants.rare         = plain->rare;
    constants.nodo         = plain->nodo;
    constants.currents     = plain->currents;
    constants.iron         = constant_iron(&gain_tables_drive);
    mapped.law             = &law_noc_iron;
    mapped.torques         = false;
    mapped.positions       = false;
    mapped.constants       = &constants;
    drive                  = &mapped;
    TEST_ASSERT_TRUE(mapped.law->check(&mapped));
    for (int n = 0; n < CASES; n++) {
        if ((n % 10) == 0) {
            start();
            gain_tables_drive.law->reset(&other, &gain_tables_drive, &sample);
        }
        draw();
        const law_output_t a = law_answer(&mapped, &state, &in);
        const law_output_t b = law_answer(&gain_tables_drive, &other, &in);

        close_to((double)b.v_V.d, (double)a.v_V.d, 10.0);
        close_to((double)b.v_V.q, (double)a.v_V.q, 10.0);
        close_to((double)b.now.iq_A, (double)a.now.iq_A, 1.0);
        close_to((double)b.now.id_A, (double)a.now.id_A, 1.0);
        close_to((double)b.d_omega, (double)a.d_omega, 1.0e3);
        close_to((double)b.d_q, (double)a.d_q, 1.0e3);
        close_to((double)b.d_d, (double)a.d_d, 1.0e3);
        close_to((double)b.i_ref_A.q, (double)a.i_ref_A.q, 1.0);
        close_to((double)b.i_ref_A.d, (double)a.i_ref_A.d, 1.0);
    }
}

static void test_check_wants_every_part(void)
{
    static law_noc_iron_config_t bad;
    drive_config_t               copy = *drive;

    copy.constants = &bad;
    bad            = *config;
    TEST_ASSERT_TRUE(copy.law->check(&copy));
    copy.positions = true;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    copy.positions               = false;
    bad.iron.node[3][4][IRON_LQ] = NAN;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    bad               = *config;
    bad.nodo.iq_max_A = NAN;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    bad            = *config;
    bad.rare.theta = 0.0f;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    bad                       = *config;
    bad.currents.from_e_radps = -1.0f;
    TEST_ASSERT_FALSE(copy.law->check(&copy));
    bad            = *config;
    bad.nodo.order = NODO_ORDER_MAX + 1;
    TEST_ASSERT_FALSE(copy.law->counts_ok(&copy));
    bad.nodo.order = -1;
    TEST_ASSERT_FALSE(copy.law->counts_ok(&copy));
    bad.nodo.order = 1;
    TEST_ASSERT_TRUE(copy.law->counts_ok(&copy));
    bad.near_optimal.nosc.order = NOSC_ORDER_MAX + 1;
    TEST_ASSERT_FALSE(copy.law->counts_ok(&copy));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_start_takes_over_the_sample_whatever_the_past);
    RUN_TEST(test_step_is_made_of_its_parts);
    RUN_TEST(test_constant_inductances_give_the_answers_of_noc);
    RUN_TEST(test_check_wants_every_part);
    return UNITY_END();
}
