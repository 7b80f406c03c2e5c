/* SPDX-License-Identifier: MIT */
/* How commission.c ends a stage: by its time limit, and by results that are no numbers. */
#include <string.h>

#include "commission.h"

#include "unit_support.h"
#include "unity.h"

#define TS_s 2.0e-4f

static commission_config_t config;
static commission_t        module;
static commission_sample_t sample;

/* Time limits, written anew. */
static const struct {
    commission_stage_t stage;
    float              most_s;
} limits[] = {{COMMISSION_WATCH, 1.0f},  {COMMISSION_LOOK, 20.0f}, {COMMISSION_RESISTANCE, 250.0f},
              {COMMISSION_DRAG, 400.0f}, {COMMISSION_MAP, 20.0f},  {COMMISSION_SPIN, 200.0f},
              {COMMISSION_RING, 150.0f}};

void setUp(void)
{
    const commission_config_t c = {.ts_s              = TS_s,
                                   .current_max_A     = 8.0f,
                                   .speed_max_m_radps = 150.0f,
                                   .dc_link_min_V     = 400.0f,
                                   .dc_link_max_V     = 700.0f,
                                   .counts_per_turn   = 10000};
    const commission_sample_t s = {.dc_link_V = 540.0f, .valid = true};
    config                      = c;
    sample                      = s;
    (void)memset(&module, 0, sizeof module);
    TEST_ASSERT_EQUAL_INT(CTL_OK, commission_init(&module, &config));
    commission_start(&module);
    (void)commission_tick(&module, &sample, true); /* the watch of the shaft has begun */
}

void tearDown(void) {}

/* In a stage from its start, with results of a motor. */
static void go(commission_stage_t stage)
{
    const commission_signal_t quiet = {.dc_link_V = 540.0f};

    setUp();
    module.found.r_Ohm.value = 3.0f;
    module.found.ld_H.value  = 0.03f;
    module.found.lq_H.value  = 0.05f;
    module.found.pole_pairs  = 2;
    module.checked           = true;
    module.admittance.aa     = 1.0f / 0.03f;
    module.admittance.bb     = 1.0f / 0.05f;
    module.stage             = stage;
    module.ticks             = 1L;
    switch ((int)stage) {
    case COMMISSION_RESISTANCE:
        commission_resistance_start(&module.work.resistance, &config, &module.found);
        break;
    case COMMISSION_DRAG:
        commission_drag_start(&module.work.drag, &config, &module.found);
        break;
    case COMMISSION_SPIN:
        commission_spin_start(&module.work.spin, &config, &quiet, &module.found);
        break;
    case COMMISSION_RING:
        commission_ring_start(&module.work.ring, &config, &quiet, &module.found);
        break;
    default:
        commission_inductance_start(&module.work.inductance, 1.0e9f, 0.0f);
        break;
    }
}

static void test_every_stage_has_its_time_limit(void)
{
    for (int k = 0; k < SUPPORT_COUNT(limits); k++) {
        const int32_t most = commission_ticks(limits[k].most_s, TS_s);

        go(limits[k].stage);
        module.ticks = most;
        (void)commission_tick(&module, &sample, true);
        TEST_ASSERT_NOT_EQUAL_INT(COMMISSION_REASON_TIMEOUT, module.reason);

        go(limits[k].stage);
        module.ticks       = most + 1L;
        const bridge_t out = commission_tick(&module, &sample, true);
        TEST_ASSERT_FALSE(out.gate_enable);
        TEST_ASSERT_EQUAL_INT(COMMISSION_REASON_TIMEOUT, module.reason);
        TEST_ASSERT_EQUAL_INT(COMMISSION_ABORTED, module.stage);
        TEST_ASSERT_EQUAL_INT(limits[k].stage, module.last_stage);
    }
}

/* RING gives up when the shaft swings beyond its limit, or does not turn. */
static void test_ring_has_two_reasons(void)
{
    for (int rings = 0; rings < 2; rings++) {
        go(COMMISSION_RING);
        module.found.inertia_kgm2.value     = 1.0f;
        module.found.counts_per_turn        = 10000;
        module.found.direction              = 1;
        module.work.ring.slow_m_radps       = 15.0f;
        module.work.ring.block.at           = module.work.ring.block.samples - 1L;
        module.work.ring.block.way_cnt.re   = 1.0e9f;
        module.work.ring.block.torque_Nm.re = 1.0f;
        module.work.ring.part               = (rings == 1) ? 1 : 0;
        module.work.ring.ticks              = 1000000L;
        (void)commission_tick(&module, &sample, true);
        TEST_ASSERT_EQUAL_INT((rings == 1) ? COMMISSION_REASON_RING : COMMISSION_REASON_SPIN,
                              module.reason);
    }
}

/* The next tick ends RESISTANCE with this value. */
static void go_to_the_end_of_resistance(float r_Ohm)
{
    go(COMMISSION_RESISTANCE);
    module.work.resistance.angle = COMMISSION_ANGLES;
    for (int k = 0; k < COMMISSION_ANGLES; k++) {
        module.work.resistance.lines[k].valid = true;
        module.work.resistance.lines[k].x0    = r_Ohm;
    }
}

static void expect_end(commission_stage_t stage, commission_reason_t reason)
{
    const bridge_t out = commission_tick(&module, &sample, true);

    TEST_ASSERT_EQUAL_INT(stage, module.stage);
    TEST_ASSERT_EQUAL_INT(reason, module.reason);
    TEST_ASSERT_EQUAL_INT(stage != COMMISSION_ABORTED, out.gate_enable);
}

static void test_a_result_that_is_no_number_ends_it(void)
{
    commission_result_t *const f = &module.found;
    float *const values[] = {&f->ld_H.value,         &f->lq_H.value,         &f->flux_Wb.value,
                             &f->inertia_kgm2.value, &f->friction_Nms.value, &f->coulomb_Nm.value,
                             &f->offset_rad.value};
    const float  bad[]    = {NAN, INFINITY, -INFINITY, 1.1e9f, -1.1e9f};

    go_to_the_end_of_resistance(3.0f);
    expect_end(COMMISSION_DRAG, COMMISSION_REASON_NONE);
    for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
        for (int n = 0; n < SUPPORT_COUNT(values); n++) {
            go_to_the_end_of_resistance(3.0f);
            *values[n] = bad[k];
            expect_end(COMMISSION_ABORTED, COMMISSION_REASON_NUMERIC);
        }
    }
    go_to_the_end_of_resistance(1.1e9f);
    expect_end(COMMISSION_ABORTED, COMMISSION_REASON_NUMERIC);
    go_to_the_end_of_resistance(-1.0f);
    expect_end(COMMISSION_ABORTED, COMMISSION_REASON_RESISTANCE);
}

/* LOOK drives one axis alone: its first wave is along alpha, the second along beta. */
static void test_a_voltage_that_is_no_number_ends_it(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 2.0e9f, -2.0e9f};

    for (int16_t beta = 0; beta < 2; beta++) {
        for (int k = 0; k < SUPPORT_COUNT(bad); k++) {
            go(COMMISSION_LOOK);
            commission_inductance_t *const l = &module.work.inductance;

            l->axis = beta;
            for (int n = 0; n < 210; n++) {
                (void)commission_tick(&module, &sample, true);
            }
            TEST_ASSERT_EQUAL_INT(COMMISSION_LOOK, module.stage);
            l->direction.cos = (beta != 0) ? 0.0f : bad[k];
            l->direction.sin = (beta != 0) ? bad[k] : 0.0f;
            expect_end(COMMISSION_ABORTED, COMMISSION_REASON_NUMERIC);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_stage_has_its_time_limit);
    RUN_TEST(test_ring_has_two_reasons);
    RUN_TEST(test_a_result_that_is_no_number_ends_it);
    RUN_TEST(test_a_voltage_that_is_no_number_ends_it);
    return UNITY_END();
}
