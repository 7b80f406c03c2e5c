/* SPDX-License-Identifier: MIT */
#include "gain_tables.h"

#include <string.h>

#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOL_CONSTANT 2.4e-7 /* ratio; worst 4.8e-8, rounding to single precision */

#define GRID 40

void setUp(void) {}
void tearDown(void) {}

static const drive_config_t        *drive;
static const near_optimal_config_t *shared; /* of its law's constants */
static const nodo_gains_t          *nodo;   /* of the speed form */

static void use(const drive_config_t *tables)
{
    drive  = tables;
    shared = law_constants_near_optimal(tables);
    nodo   = &law_constants_noc_speed(&speed_tables_drive)->nodo;
}

/* Runs a test on the shipped tables and on those of the other form. */
#define RUN_BOTH_FORMS(test)                                                                       \
    do {                                                                                           \
        use(&gain_tables_drive);                                                                   \
        RUN_TEST(test);                                                                            \
        use(&speed_tables_drive);                                                                  \
        RUN_TEST(test);                                                                            \
    } while (0)

static void assert_constant(double expected, float actual)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOL_CONSTANT, 1.0, (double)actual / expected);
}

/* One limit, wherever it is asked for. */
static void test_current_limit_of_the_references_is_that_of_the_drive(void)
{
    TEST_ASSERT_TRUE(drive->current_max_A == 4.0f);
    TEST_ASSERT_TRUE(shared->current_ref.current_max_A == drive->current_max_A);
}

static void test_tables_are_a_valid_drive_configuration(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(drive));
}

static void test_tables_name_their_drive(void)
{
    TEST_ASSERT_EQUAL_STRING("ipmsm_390w", GAIN_TABLES_NAME);
    TEST_ASSERT_EQUAL_INT(strlen("fnv1a64:") + 16, strlen(GAIN_TABLES_DIGEST));
    TEST_ASSERT_EQUAL_INT(1, GAIN_TABLES_SCHEMA);
}

/* Oracle: paper A (2) with the constants of its Table 2. */
static void test_reduced_parameters_are_those_of_the_motor(void)
{
    const double rs = 2.48, ld = 0.07498, lq = 0.11391, flux = 0.193, inertia = 4.2e-4, np = 2.0;

    const motor_reduced_t *m = &drive->motor;

    assert_constant(1.5 * np * np * flux / inertia, m->l1);
    assert_constant(1.0e-4 / inertia, m->l2);
    assert_constant(np / inertia, m->l3);
    assert_constant(rs / lq, m->l4);
    assert_constant(flux / lq, m->l5);
    assert_constant(1.0 / lq, m->l6);
    assert_constant(rs / ld, m->l7);
    assert_constant(1.0 / ld, m->l8);
    assert_constant(lq / ld, m->l9);
    assert_constant(ld / lq, m->l10);
    assert_constant(1.5 * np * np * (ld - lq) / inertia, m->l11);
    assert_constant(lq, m->inv_l6);
    assert_constant(ld, m->inv_l8);
}

static void test_constants_of_the_references_agree_with_the_motor(void)
{
    const current_ref_config_t *c = &shared->current_ref;

    assert_constant(0.193 / (2.0 * (0.11391 - 0.07498)), c->mtpa_A);
    assert_constant(0.5 / (double)c->mtpa_A, c->mtpa_half_1pA);
    assert_constant(1.0 / (double)drive->ts_s, c->samples_1ps);
    assert_constant(sqrt((1.0 + (double)c->chord_from) / (1.0 - (double)c->chord_from)),
                    c->chord_slope);
    assert_constant(0.5 * (double)drive->motor.l1, c->l1_min);
    assert_constant(2.0e-4, drive->ts_s);
}

static void test_tables_name_the_law_of_their_form(void)
{
    TEST_ASSERT_TRUE(gain_tables_drive.law == &law_noc);
    TEST_ASSERT_TRUE(law_constants_near_optimal(&gain_tables_drive)->current_ref.mtpa_exact);
    TEST_ASSERT_TRUE(speed_tables_drive.law == &law_noc_speed);
    TEST_ASSERT_TRUE(!law_constants_near_optimal(&speed_tables_drive)->current_ref.mtpa_exact);
}

/* Twice the speed error that asks for all the current which EQ-NOSC-3 lets it ask for. */
static void test_near_speed_is_twice_what_asks_for_all_its_current(void)
{
    const double ratio =
        (double)shared->nosc.lambda[0][0][0] / (double)shared->nosc.lambda[0][0][1];

    assert_constant(2.0 * (double)shared->nosc.iq_speed_max_A / ratio,
                    shared->current_ref.near_e_radps);
}

/* Regeneration is zero at the trip level of the dc link. */
static void test_regeneration_ends_before_the_dc_link_trips(void)
{
    const current_ref_config_t *c      = &shared->current_ref;
    const double                ends_V = (double)c->regen_start_V + (1.0 / (double)c->regen_per_V);

    TEST_ASSERT_TRUE(ends_V < (double)drive->dc_link_max_V);
    TEST_ASSERT_TRUE((double)c->regen_start_V > 295.0);
}

static void test_dead_time_is_its_share_of_the_pwm_period(void)
{
    assert_constant(3.0e-6 * 5000.0, drive->dead_time.share);
}

/* The largest iq of the MTPA curve on the current circle; the speed form keeps the second-order term. */
static void test_largest_q_current_lies_on_the_current_circle(void)
{
    const double iq   = (double)shared->current_ref.iq_max_A;
    const double k    = (double)shared->current_ref.mtpa_A;
    const double root = shared->current_ref.mtpa_exact ? hypot(k, iq) : k;
    const double id   = iq * iq / (k + root);

    assert_constant(hypot(id, iq), shared->current_ref.current_max_A);
}

/* Reversing the rotation must reverse v_q and keep v_d, so every other power of every entry is zero. */
static void test_gains_of_the_controller_have_the_symmetry_of_the_motor(void)
{
    for (int n = 0; n <= shared->nosc.order; n++) {
        for (int row = 0; row < NOSC_N_U; row++) {
            for (int column = 0; column < NOSC_N_E; column++) {
                const bool mirrored_row    = (row == 0);
                const bool mirrored_column = (column < 2);
                const bool odd             = ((n % 2) == 1);
                if ((mirrored_row != mirrored_column) != odd) {
                    TEST_ASSERT_TRUE(shared->nosc.lambda[n][row][column] == 0.0f);
                }
            }
        }
    }
}

static void test_gains_of_the_angle_observer_have_the_symmetry_of_the_motor(void)
{
    const nodo_encoder_gains_t *g = &law_constants_noc(&gain_tables_drive)->nodo;
    for (int n = 0; n <= g->order; n++) {
        for (int row = 0; row < NODO_ENCODER_N_X; row++) {
            for (int column = 0; column < NODO_ENCODER_N_Y; column++) {
                const bool mirrored_row    = ((row % 3) != 2);
                const bool mirrored_column = (column != 1);
                const bool odd             = ((n % 2) == 1);
                if ((mirrored_row != mirrored_column) != odd) {
                    TEST_ASSERT_TRUE(g->gain[n][row][column] == 0.0f);
                }
            }
        }
    }
}

static void test_gains_of_the_observer_have_the_symmetry_of_the_motor(void)
{
    for (int n = 0; n <= nodo->order; n++) {
        for (int row = 0; row < NODO_N_X; row++) {
            for (int column = 0; column < NODO_N_Y; column++) {
                const bool mirrored_row    = ((row % 3) != 2);
                const bool mirrored_column = (column < 2);
                const bool odd             = ((n % 2) == 1);
                if ((mirrored_row != mirrored_column) != odd) {
                    TEST_ASSERT_TRUE(nodo->gain[n][row][column] == 0.0f);
                }
            }
        }
    }
}

static void test_powers_beyond_the_order_are_empty(void)
{
    for (int n = shared->nosc.order + 1; n <= NOSC_ORDER_MAX; n++) {
        for (int i = 0; i < NOSC_N_U * NOSC_N_E; i++) {
            TEST_ASSERT_TRUE(shared->nosc.lambda[n][i / NOSC_N_E][i % NOSC_N_E] == 0.0f);
        }
    }
    for (int n = nodo->order + 1; n <= NODO_ORDER_MAX; n++) {
        for (int i = 0; i < NODO_N_X * NODO_N_Y; i++) {
            TEST_ASSERT_TRUE(nodo->gain[n][i / NODO_N_Y][i % NODO_N_Y] == 0.0f);
        }
    }
    const nodo_encoder_gains_t *encoder = &law_constants_noc(&gain_tables_drive)->nodo;
    for (int n = encoder->order + 1; n <= NODO_ORDER_MAX; n++) {
        for (int i = 0; i < NODO_ENCODER_N_X * NODO_ENCODER_N_Y; i++) {
            TEST_ASSERT_TRUE(encoder->gain[n][i / NODO_ENCODER_N_Y][i % NODO_ENCODER_N_Y] == 0.0f);
        }
    }
}

/* Six by six holds both loops; the controller uses the first three rows. */
typedef struct {
    double at[6][6];
} matrix_t;

static matrix_t product(const matrix_t *a, const matrix_t *b)
{
    matrix_t c;
    for (int row = 0; row < 6; row++) {
        for (int column = 0; column < 6; column++) {
            c.at[row][column] = 0.0;
            for (int k = 0; k < 6; k++) {
                c.at[row][column] += a->at[row][k] * b->at[k][column];
            }
        }
    }
    return c;
}

static double largest_entry(const matrix_t *a)
{
    double largest = 0.0;
    for (int i = 0; i < 36; i++) {
        largest = fmax(largest, fabs(a->at[i / 6][i % 6]));
    }
    return largest;
}

/* I + Ts a, raised to the power 4096 (0.8 s) by squaring: vanishes if and only if every mode decays. */
static double after_4096_periods(const matrix_t *a)
{
    matrix_t step;
    for (int i = 0; i < 36; i++) {
        const double unit     = ((i / 6) == (i % 6)) ? 1.0 : 0.0;
        step.at[i / 6][i % 6] = unit + ((double)drive->ts_s * a->at[i / 6][i % 6]);
    }
    for (int squaring = 0; squaring < 12; squaring++) {
        step = product(&step, &step);
    }
    return largest_entry(&step);
}

/* (10) with (26): A(e_iq) - B Lambda(e_iq). The unused half decays on its own. */
static void test_sampled_error_dynamics_decay_over_the_certified_range(void)
{
    const motor_reduced_t *m = &drive->motor;
    for (int step = -GRID; step <= GRID; step++) {
        const double eiq = (double)shared->nosc.iq_error_max_A * (double)step / GRID;
        matrix_t     a   = {{{-(double)m->l2, (double)m->l1, (double)m->l11 * eiq},
                             {-(double)m->l5, -(double)m->l4, 0.0},
                             {0.0, 0.0, -(double)m->l7},
                             {0.0, 0.0, 0.0, -1000.0},
                             {0.0, 0.0, 0.0, 0.0, -1000.0},
                             {0.0, 0.0, 0.0, 0.0, 0.0, -1000.0}}};
        for (int n = 0; n <= shared->nosc.order; n++) {
            for (int column = 0; column < NOSC_N_E; column++) {
                const double power = pow(eiq, (double)n);
                a.at[1][column] -=
                    (double)m->l6 * power * (double)shared->nosc.lambda[n][0][column];
                a.at[2][column] -=
                    (double)m->l8 * power * (double)shared->nosc.lambda[n][1][column];
            }
        }

        const double left = after_4096_periods(&a);

        TEST_ASSERT_TRUE(left < 1.0e-6);
    }
}

/* (31): A_d(iq) - L(iq) C_d. */
static void test_sampled_observer_decays_over_the_certified_range(void)
{
    const motor_reduced_t *m = &drive->motor;
    for (int step = -GRID; step <= GRID; step++) {
        const double iq = (double)nodo->iq_max_A * (double)step / GRID;
        matrix_t     a  = {{{0.0},
                            {0.0},
                            {0.0},
                            {1.0, 0.0, 0.0, -(double)m->l2, (double)m->l1, (double)m->l11 * iq},
                            {0.0, 1.0, 0.0, -(double)m->l5, -(double)m->l4, 0.0},
                            {0.0, 0.0, 1.0, (double)m->l9 * iq, 0.0, -(double)m->l7}}};
        for (int n = 0; n <= nodo->order; n++) {
            for (int row = 0; row < NODO_N_X; row++) {
                for (int column = 0; column < NODO_N_Y; column++) {
                    a.at[row][3 + column] -=
                        pow(iq, (double)n) * (double)nodo->gain[n][row][column];
                }
            }
        }

        const double left = after_4096_periods(&a);

        TEST_ASSERT_TRUE(left < 1.0e-6);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_BOTH_FORMS(test_tables_are_a_valid_drive_configuration);
    RUN_BOTH_FORMS(test_current_limit_of_the_references_is_that_of_the_drive);
    RUN_TEST(test_tables_name_their_drive);
    RUN_BOTH_FORMS(test_reduced_parameters_are_those_of_the_motor);
    RUN_BOTH_FORMS(test_constants_of_the_references_agree_with_the_motor);
    RUN_TEST(test_tables_name_the_law_of_their_form);
    RUN_BOTH_FORMS(test_near_speed_is_twice_what_asks_for_all_its_current);
    RUN_BOTH_FORMS(test_regeneration_ends_before_the_dc_link_trips);
    RUN_BOTH_FORMS(test_dead_time_is_its_share_of_the_pwm_period);
    RUN_BOTH_FORMS(test_largest_q_current_lies_on_the_current_circle);
    RUN_BOTH_FORMS(test_gains_of_the_controller_have_the_symmetry_of_the_motor);
    RUN_BOTH_FORMS(test_powers_beyond_the_order_are_empty);
    RUN_BOTH_FORMS(test_sampled_error_dynamics_decay_over_the_certified_range);
    RUN_TEST(test_gains_of_the_angle_observer_have_the_symmetry_of_the_motor);
    use(&speed_tables_drive);
    RUN_TEST(test_gains_of_the_observer_have_the_symmetry_of_the_motor);
    RUN_TEST(test_sampled_observer_decays_over_the_certified_range);
    return UNITY_END();
}
