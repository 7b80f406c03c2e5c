/* SPDX-License-Identifier: MIT */
#include "drive_config.h"

#include <stddef.h>

#include "gain_tables.h"
#include "harmonic_tables.h"
#include "law_constants.h"
#include "speed_tables.h"
#include "unit_support.h"
#include "unity.h"

#define TOO_LARGE      1.0e13f /* beyond any constant of a drive */
#define TOO_LARGE_GAIN 1.0e19f /* but for an observer's gains of 1/s^3 */

static drive_config_t   config;
static test_constants_t constants; /* of config */

/* Allowed sign of a constant. */
typedef enum { POSITIVE, ZERO_OR_MORE, ZERO_OR_LESS } range_t;

typedef struct {
    float  *constant;
    range_t range;
} entry_t;

static const entry_t entries[] = {
    {&config.ts_s, POSITIVE},
    {&config.current_max_A, POSITIVE},
    {&config.rated_current_A, POSITIVE},
    {&config.rated_torque_Nm, POSITIVE},
    {&config.trip_current_A, POSITIVE},
    {&config.trip_speed_e_radps, POSITIVE},
    {&config.speed_max_e_radps, POSITIVE},
    {&config.dc_link_min_V, POSITIVE},
    {&config.dc_link_max_V, POSITIVE},
    {&config.motor.l1, ZERO_OR_MORE},
    {&config.motor.l2, ZERO_OR_MORE},
    {&config.motor.l3, POSITIVE},
    {&config.motor.l4, POSITIVE},
    {&config.motor.l5, ZERO_OR_MORE},
    {&config.motor.l6, POSITIVE},
    {&config.motor.l7, POSITIVE},
    {&config.motor.l8, POSITIVE},
    {&config.motor.l9, POSITIVE},
    {&config.motor.l10, POSITIVE},
    {&config.motor.l11, ZERO_OR_LESS},
    {&config.motor.inv_l6, POSITIVE},
    {&config.motor.inv_l8, POSITIVE},
    {&constants.near_optimal.current_ref.current_max_A, POSITIVE},
    {&constants.near_optimal.current_ref.iq_max_A, POSITIVE},
    {&constants.near_optimal.current_ref.mtpa_A, POSITIVE},
    {&constants.near_optimal.current_ref.mtpa_half_1pA, POSITIVE},
    {&constants.near_optimal.current_ref.circle_ApVs, POSITIVE},
    {&constants.near_optimal.current_ref.torque_share, POSITIVE},
    {&constants.near_optimal.current_ref.near_e_radps, POSITIVE},
    {&constants.near_optimal.current_ref.l1_min, POSITIVE},
    {&constants.near_optimal.current_ref.mtpa_per_period, POSITIVE},
    {&constants.near_optimal.current_ref.weakening_per_period, POSITIVE},
    {&constants.near_optimal.current_ref.chord_from, ZERO_OR_MORE},
    {&constants.near_optimal.current_ref.chord_slope, ZERO_OR_MORE},
    {&constants.near_optimal.current_ref.samples_1ps, POSITIVE},
    {&constants.near_optimal.current_ref.regen_max_W_norm, ZERO_OR_MORE},
    {&constants.near_optimal.current_ref.regen_start_V, POSITIVE},
    {&constants.near_optimal.current_ref.regen_per_V, POSITIVE},
    {&config.dead_time.share, ZERO_OR_MORE},
    {&config.dead_time.inv_fade_1pA, POSITIVE},
    {&config.hardware.dead_time_s, ZERO_OR_MORE},
    {&constants.near_optimal.nosc.iq_error_max_A, POSITIVE},
    {&constants.near_optimal.nosc.iq_speed_max_A, POSITIVE},
};

static const entry_t speed_entries[] = {
    {&constants.noc_speed.nodo.iq_max_A, POSITIVE},
    {&constants.noc_speed.nodo.iq_certified_A, POSITIVE},
};

static const entry_t encoder_entries[] = {
    {&constants.noc.nodo.iq_max_A, POSITIVE},     {&constants.noc.plausible.angle_rad, POSITIVE},
    {&constants.noc.plausible.d_omega, POSITIVE}, {&constants.noc.rare.omega_1ps, POSITIVE},
    {&constants.noc.rare.d_omega_1ps2, POSITIVE}, {&constants.noc.rare.count_rad, POSITIVE},
};

static const entry_t harmonic_entries[] = {
    {&constants.noc_h.plausible.angle_rad, POSITIVE},
    {&constants.noc_h.plausible.d_omega, POSITIVE},
    {&constants.noc_h.rare.omega_1ps, POSITIVE},
    {&constants.noc_h.rare.d_omega_1ps2, POSITIVE},
    {&constants.noc_h.rare.count_rad, POSITIVE},
};

void setUp(void)
{
    config = law_constants_copy(&constants, &speed_tables_drive);
}

void tearDown(void) {}

/* Puts x in place of one constant; the others are those of `base`. */
static ctl_status_t check_in(const drive_config_t *base, float *constant, float x)
{
    config    = law_constants_copy(&constants, base);
    *constant = x;
    return drive_config_check(&config);
}

static ctl_status_t check_with(float *constant, float x)
{
    return check_in(&speed_tables_drive, constant, x);
}

static void assert_refused(const drive_config_t *base, float *constant, float x)
{
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_in(base, constant, x));
}

/* Not finite, beyond physics, zero where it has no meaning, of the wrong sign. */
static void assert_entry_checked(const drive_config_t *base, const entry_t *entry)
{
    const ctl_status_t at_zero = (entry->range == POSITIVE) ? CTL_BAD_CONFIG : CTL_OK;
    const float        wrong   = (entry->range == ZERO_OR_LESS) ? 1.0e-6f : -1.0e-6f;

    for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
        assert_refused(base, entry->constant, support_not_finite[k]);
    }
    assert_refused(base, entry->constant, TOO_LARGE);
    assert_refused(base, entry->constant, -TOO_LARGE);
    assert_refused(base, entry->constant, wrong);
    TEST_ASSERT_EQUAL_INT(at_zero, check_in(base, entry->constant, 0.0f));
    TEST_ASSERT_EQUAL_INT(at_zero, check_in(base, entry->constant, -0.0f));
}

static void test_shipped_drives_are_accepted(void)
{
    TEST_ASSERT_TRUE(speed_tables_drive.law == &law_noc_speed);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&speed_tables_drive));
    TEST_ASSERT_TRUE(gain_tables_drive.law == &law_noc);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&gain_tables_drive));
    TEST_ASSERT_TRUE(harmonic_tables_drive.law == &law_noc_h);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&harmonic_tables_drive));
    TEST_ASSERT_TRUE(conventional_tables_drive.law == &law_conventional);
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&conventional_tables_drive));
}

/* Where a constant that the laws share is in those of one of them: noc_h does not begin with it. */
static entry_t in_law(const drive_config_t *base, const entry_t *shared)
{
    const uintptr_t begin = (uintptr_t)&constants.near_optimal;
    const uintptr_t words = ((uintptr_t)shared->constant - begin) / sizeof(float);
    entry_t         entry = *shared;

    if ((base->law == &law_noc_h) && (words < (sizeof(near_optimal_config_t) / sizeof(float)))) {
        entry.constant = (float *)&constants.noc_h.near_optimal + words;
    }
    return entry;
}

static void test_every_constant_is_checked_with_every_law(void)
{
    const drive_config_t *const all[] = {&speed_tables_drive, &gain_tables_drive,
                                         &harmonic_tables_drive, &conventional_tables_drive};

    for (int i = 0; i < SUPPORT_COUNT(entries); i++) {
        for (int k = 0; k < SUPPORT_COUNT(all); k++) {
            const entry_t entry = in_law(all[k], &entries[i]);
            assert_entry_checked(all[k], &entry);
        }
    }
}

static void test_constants_of_the_observer_are_checked(void)
{
    for (int i = 0; i < SUPPORT_COUNT(speed_entries); i++) {
        assert_entry_checked(&speed_tables_drive, &speed_entries[i]);
    }
    for (int i = 0; i < SUPPORT_COUNT(encoder_entries); i++) {
        assert_entry_checked(&gain_tables_drive, &encoder_entries[i]);
    }
    for (int i = 0; i < SUPPORT_COUNT(harmonic_entries); i++) {
        assert_entry_checked(&harmonic_tables_drive, &harmonic_entries[i]);
    }
}

static void test_drive_without_a_law_is_refused(void)
{
    config.law = NULL;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&config));

    setUp();
    config.constants = NULL;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&config));

    config.law = NULL;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_config_check(&config));
}

/* The references ask for what the drive allows: one number in two places. */
static void test_current_limit_of_the_references_is_that_of_the_drive(void)
{
    const float limit_A = config.current_max_A;

    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          check_with(&config.current_max_A, nextafterf(limit_A, 0.0f)));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          check_with(&config.current_max_A, nextafterf(limit_A, INFINITY)));
    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(&config.current_max_A, limit_A));
}

static void assert_bounds(float *constant, float lo, float hi)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(constant, lo));
    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(constant, hi));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(constant, nextafterf(lo, 0.0f)));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(constant, nextafterf(hi, INFINITY)));
}

static ctl_status_t check_with_period(float ts_s)
{
    setUp();
    config.ts_s                                    = ts_s;
    constants.near_optimal.current_ref.samples_1ps = 1.0f / ts_s;
    return drive_config_check(&config);
}

static void test_control_period_has_its_documented_bounds(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with_period(1.0e-5f));
    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with_period(1.0e-2f));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_period(nextafterf(1.0e-5f, 0.0f)));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_period(nextafterf(1.0e-2f, INFINITY)));
}

/* The same number in two places, one the inverse of the other. */
static void test_inverses_are_those_of_their_constants(void)
{
    current_ref_config_t *const ref     = &constants.near_optimal.current_ref;
    float *const                again[] = {&ref->samples_1ps, &ref->mtpa_half_1pA};

    for (int i = 0; i < SUPPORT_COUNT(again); i++) {
        const float good = *again[i];

        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(again[i], 1.002f * good));
        TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(again[i], 0.998f * good));
        TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(again[i], good));
    }
}

static void test_shares_end_at_one(void)
{
    assert_bounds(&constants.near_optimal.current_ref.torque_share, 1.0e-3f, 1.0f);
    assert_bounds(&constants.near_optimal.current_ref.mtpa_per_period, 1.0e-6f, 1.0f);
    assert_bounds(&constants.near_optimal.current_ref.weakening_per_period, 1.0e-6f, 1.0f);
    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(&constants.near_optimal.current_ref.chord_from, 1.0f));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(&constants.near_optimal.current_ref.chord_from,
                                                     nextafterf(1.0f, INFINITY)));
}

static void test_implausible_angle_ends_at_half_a_turn(void)
{
    const drive_config_t *const all[] = {&gain_tables_drive, &harmonic_tables_drive};

    for (int k = 0; k < SUPPORT_COUNT(all); k++) {
        float *const angle =
            (k == 0) ? &constants.noc.plausible.angle_rad : &constants.noc_h.plausible.angle_rad;
        TEST_ASSERT_EQUAL_INT(CTL_OK, check_in(all[k], angle, 1.0e-6f));
        TEST_ASSERT_EQUAL_INT(CTL_OK, check_in(all[k], angle, BASE_PI));
        assert_refused(all[k], angle, nextafterf(1.0e-6f, 0.0f));
        assert_refused(all[k], angle, nextafterf(BASE_PI, INFINITY));
    }
}

static void test_dead_time_ends_at_a_tenth_of_the_period(void)
{
    float *const share = &config.dead_time.share;

    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(share, 0.1f));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(share, nextafterf(0.1f, 1.0f)));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(share, -nextafterf(0.0f, 1.0f)));
}

static void test_certified_range_contains_the_range_of_the_series(void)
{
    const float range_A = law_constants_noc_speed(&speed_tables_drive)->nodo.iq_max_A;

    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(&constants.noc_speed.nodo.iq_certified_A, range_A));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(&constants.noc_speed.nodo.iq_certified_A,
                                                     nextafterf(range_A, 0.0f)));
}

static void test_trip_current_lies_beyond_the_current_limit(void)
{
    const float limit_A = config.current_max_A;

    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(&config.trip_current_A, limit_A));
    TEST_ASSERT_EQUAL_INT(CTL_OK,
                          check_with(&config.trip_current_A, nextafterf(limit_A, INFINITY)));
}

static void test_no_command_may_lead_to_the_trip_speed(void)
{
    const float trip = config.trip_speed_e_radps;

    TEST_ASSERT_EQUAL_INT(CTL_OK, check_with(&config.speed_max_e_radps, trip));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG,
                          check_with(&config.speed_max_e_radps, nextafterf(trip, INFINITY)));
}

static void test_dc_link_range_is_not_empty(void)
{
    const float lowest_V = config.dc_link_min_V;

    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(&config.dc_link_max_V, lowest_V));
    TEST_ASSERT_EQUAL_INT(CTL_OK,
                          check_with(&config.dc_link_max_V, nextafterf(lowest_V, INFINITY)));
}

static void test_iq_limit_lies_within_the_current_circle(void)
{
    const float limit_A = config.current_max_A;

    TEST_ASSERT_EQUAL_INT(CTL_OK,
                          check_with(&constants.near_optimal.current_ref.iq_max_A, limit_A));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(&constants.near_optimal.current_ref.iq_max_A,
                                                     nextafterf(limit_A, INFINITY)));
}

static ctl_status_t check_with_nosc_order(int16_t order)
{
    constants.near_optimal.nosc.order = order;
    return drive_config_check(&config);
}

static ctl_status_t check_with_nodo_order(int16_t order)
{
    constants.noc_speed.nodo.order = order;
    return drive_config_check(&config);
}

static ctl_status_t check_with_encoder_order(int16_t order)
{
    config                   = law_constants_copy(&constants, &gain_tables_drive);
    constants.noc.nodo.order = order;
    return drive_config_check(&config);
}

static void test_orders_that_no_table_can_hold_are_refused(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_nosc_order(-1));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_nosc_order(NOSC_ORDER_MAX + 1));
    setUp();
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_nodo_order(-1));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_nodo_order(NODO_ORDER_MAX + 1));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_encoder_order(-1));
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with_encoder_order(NODO_ORDER_MAX + 1));
}

static void test_every_order_that_a_table_can_hold_is_accepted(void)
{
    for (int16_t order = 0; order <= NOSC_ORDER_MAX; order++) {
        TEST_ASSERT_EQUAL_INT(CTL_OK, check_with_nosc_order(order));
    }
    for (int16_t order = 0; order <= NODO_ORDER_MAX; order++) {
        TEST_ASSERT_EQUAL_INT(CTL_OK, check_with_nodo_order(order));
    }
    for (int16_t order = 0; order <= NODO_ORDER_MAX; order++) {
        TEST_ASSERT_EQUAL_INT(CTL_OK, check_with_encoder_order(order));
    }
}

/* A drive of noc_h whose table may be changed. */
static nodo_harmonic_gains_t *const table = &constants.noc_h.nodo;

static void use_harmonics(void)
{
    config = law_constants_copy(&constants, &harmonic_tables_drive);
}

static void assert_harmonics(ctl_status_t expected)
{
    TEST_ASSERT_EQUAL_INT(expected, drive_config_check(&config));
}

static void test_noc_h_needs_references_and_feedback_too(void)
{
    use_harmonics();
    assert_harmonics(CTL_OK);
    constants.noc_h.near_optimal.nosc.order = -1;
    assert_harmonics(CTL_BAD_CONFIG);
    use_harmonics();
    constants.noc_h.near_optimal.current_ref.mtpa_A = NAN;
    assert_harmonics(CTL_BAD_CONFIG);
}

static void test_counts_of_harmonics_are_those_of_a_table(void)
{
    const int16_t bad_pairs[] = {-1, NODO_HARMONIC_PAIRS_MAX + 1};
    const int16_t bad_nodes[] = {-1, 0, 1, NODO_HARMONIC_NODES_MAX + 1};

    for (int i = 0; i < SUPPORT_COUNT(bad_pairs); i++) {
        use_harmonics();
        table->n_pairs = bad_pairs[i];
        assert_harmonics(CTL_BAD_CONFIG);
    }
    for (int i = 0; i < SUPPORT_COUNT(bad_nodes); i++) {
        use_harmonics();
        table->n_nodes = bad_nodes[i];
        assert_harmonics(CTL_BAD_CONFIG);
    }
    use_harmonics();
    table->n_pairs = 0;
    table->n_nodes = 2;
    assert_harmonics(CTL_OK);
    table->n_pairs = NODO_HARMONIC_PAIRS_MAX; /* what the drive has not is zero */
    assert_harmonics(CTL_OK);
}

static void test_constants_of_harmonics_are_checked(void)
{
    float *const numbers[] = {&table->iq_max_A, &table->nodes_per_root, &table->keep,
                              &table->keep_fast};

    for (int i = 0; i < SUPPORT_COUNT(numbers); i++) {
        const float bad[] = {0.0f, -1.0f, TOO_LARGE, NAN, INFINITY};
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            use_harmonics();
            *numbers[i] = bad[k];
            assert_harmonics(CTL_BAD_CONFIG);
        }
    }
    use_harmonics();
    table->keep = 1.0f;
    assert_harmonics(CTL_OK);
    table->keep = nextafterf(1.0f, 2.0f);
    assert_harmonics(CTL_BAD_CONFIG);
    use_harmonics();
    table->keep_fast = nextafterf(1.0f, 2.0f);
    assert_harmonics(CTL_BAD_CONFIG);
}

static void test_orders_of_the_pairs_in_use_are_checked(void)
{
    const float bad[] = {1001.0f, -1001.0f, NAN, -INFINITY};

    use_harmonics();
    for (int i = 0; i < table->n_pairs; i++) {
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            use_harmonics();
            table->pair[i].order = bad[k];
            assert_harmonics(CTL_BAD_CONFIG);
        }
    }
    use_harmonics();
    table->n_pairs--;
    table->pair[table->n_pairs].order = NAN;
    assert_harmonics(CTL_OK);
}

static void test_channels_of_the_pairs_are_checked(void)
{
    use_harmonics();
    for (int i = 0; i < table->n_pairs; i++) {
        use_harmonics();
        table->pair[i].channel = (nodo_harmonic_channel_t)((int)NODO_HARMONIC_VOLTAGE_D +
                                                           1); /* the first that is none */
        assert_harmonics(CTL_BAD_CONFIG);
    }
}

static void test_every_gain_of_the_harmonics_in_use_is_checked(void)
{
    use_harmonics();
    const int rows  = NODO_HARMONIC_N_BASE + (2 * table->n_pairs);
    const int nodes = table->n_nodes;

    for (int n = 0; n < nodes * rows * NODO_HARMONIC_N_G; n++) {
        float *const gain = &table->gain[(n / NODO_HARMONIC_N_G) % rows]
                                        [n / (rows * NODO_HARMONIC_N_G)][n % NODO_HARMONIC_N_G];
        const float good = *gain;
        for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
            *gain = support_not_finite[k];
            assert_harmonics(CTL_BAD_CONFIG);
        }
        *gain = -TOO_LARGE;
        assert_harmonics(CTL_BAD_CONFIG);
        *gain = good;
    }
    table->n_pairs--; /* the last two rows are now unused */
    table->gain[rows - 1][0][0] = NAN;
    assert_harmonics(CTL_OK);
}

static void test_every_gain_of_the_controller_in_use_is_checked(void)
{
    for (int n = 0; n <= law_constants_near_optimal(&speed_tables_drive)->nosc.order; n++) {
        for (int row = 0; row < NOSC_N_U; row++) {
            for (int column = 0; column < NOSC_N_E; column++) {
                float *const gain = &constants.near_optimal.nosc.lambda[n][row][column];

                for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
                    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(gain, support_not_finite[k]));
                }
                TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(gain, TOO_LARGE));
                TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(gain, -TOO_LARGE));
            }
        }
    }
}

static void test_every_gain_of_the_observer_in_use_is_checked(void)
{
    for (int n = 0; n <= law_constants_noc_speed(&speed_tables_drive)->nodo.order; n++) {
        for (int row = 0; row < NODO_N_X; row++) {
            for (int column = 0; column < NODO_N_Y; column++) {
                float *const gain = &constants.noc_speed.nodo.gain[n][row][column];

                for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
                    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(gain, support_not_finite[k]));
                }
                TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(gain, TOO_LARGE));
                TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, check_with(gain, -TOO_LARGE));
            }
        }
    }
}

static void test_every_gain_of_the_encoder_observer_in_use_is_checked(void)
{
    const drive_config_t *const base = &gain_tables_drive;
    for (int n = 0; n <= law_constants_noc(base)->nodo.order; n++) {
        for (int row = 0; row < NODO_ENCODER_N_X; row++) {
            for (int column = 0; column < NODO_ENCODER_N_Y; column++) {
                float *const gain = &constants.noc.nodo.gain[n][row][column];

                for (int k = 0; k < SUPPORT_COUNT(support_not_finite); k++) {
                    assert_refused(base, gain, support_not_finite[k]);
                }
                assert_refused(base, gain, TOO_LARGE_GAIN);
                assert_refused(base, gain, -TOO_LARGE_GAIN);
            }
        }
    }
}

static void test_powers_beyond_the_order_are_not_looked_at(void)
{
    nosc_gains_t *const         nosc    = &constants.near_optimal.nosc;
    nodo_gains_t *const         nodo    = &constants.noc_speed.nodo;
    nodo_encoder_gains_t *const encoder = &constants.noc.nodo;

    nosc->lambda[nosc->order + 1][0][0] = NAN;
    nodo->gain[nodo->order + 1][0][0]   = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&config));

    config                                  = law_constants_copy(&constants, &gain_tables_drive);
    encoder->gain[encoder->order + 1][0][0] = NAN;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_config_check(&config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_shipped_drives_are_accepted);
    RUN_TEST(test_every_constant_is_checked_with_every_law);
    RUN_TEST(test_constants_of_the_observer_are_checked);
    RUN_TEST(test_drive_without_a_law_is_refused);
    RUN_TEST(test_current_limit_of_the_references_is_that_of_the_drive);
    RUN_TEST(test_control_period_has_its_documented_bounds);
    RUN_TEST(test_inverses_are_those_of_their_constants);
    RUN_TEST(test_shares_end_at_one);
    RUN_TEST(test_implausible_angle_ends_at_half_a_turn);
    RUN_TEST(test_dead_time_ends_at_a_tenth_of_the_period);
    RUN_TEST(test_certified_range_contains_the_range_of_the_series);
    RUN_TEST(test_trip_current_lies_beyond_the_current_limit);
    RUN_TEST(test_no_command_may_lead_to_the_trip_speed);
    RUN_TEST(test_dc_link_range_is_not_empty);
    RUN_TEST(test_iq_limit_lies_within_the_current_circle);
    RUN_TEST(test_orders_that_no_table_can_hold_are_refused);
    RUN_TEST(test_every_order_that_a_table_can_hold_is_accepted);
    RUN_TEST(test_every_gain_of_the_controller_in_use_is_checked);
    RUN_TEST(test_every_gain_of_the_observer_in_use_is_checked);
    RUN_TEST(test_every_gain_of_the_encoder_observer_in_use_is_checked);
    RUN_TEST(test_powers_beyond_the_order_are_not_looked_at);
    RUN_TEST(test_noc_h_needs_references_and_feedback_too);
    RUN_TEST(test_counts_of_harmonics_are_those_of_a_table);
    RUN_TEST(test_constants_of_harmonics_are_checked);
    RUN_TEST(test_orders_of_the_pairs_in_use_are_checked);
    RUN_TEST(test_channels_of_the_pairs_are_checked);
    RUN_TEST(test_every_gain_of_the_harmonics_in_use_is_checked);
    return UNITY_END();
}
