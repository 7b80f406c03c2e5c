/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 600 /* the timer that plays the interrupt */

#include "app.h"
#include "app_control.h"
#include "app_line.h"
#include "app_registers.h"

#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

#include "app_modes.h"
#include "app_slow.h"
#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"
#include "modbus_frame.h"
#include "speed_tables.h"
#include "test_motor.h"
#include "unit_support.h"
#include "unity.h"

#define READY_TICKS       (250 + 1280 + 2)
#define TOL_ENCODER_RADPS 0.15 /* rad/s, mean of 0.2 s; worst 0.074 */
/* The same, speed form: one count is 6.3 rad/s there, which drives the law from limit to limit. Worst 1.6, and
 * as much with drive_tick() alone in the loop. */
#define TOL_SPEED_FORM_RADPS 3.0
#define TOL_ANGLE            0.002 /* rad, half a count of two pole pairs is 0.0006 */
#define MARK_RAD             0.7   /* mechanical angle of the index mark */

static app_config_t config;
static test_motor_t motor;
static double       in_force[3]; /* duty ratios of this period */
static bool         index_on;    /* the encoder has an index */
static double       offset_A[2]; /* of the current sensors */
static double       tolerance_radps;

void setUp(void)
{
    fake_board_reset();
    config      = board_config;
    motor       = test_motor_390w();
    index_on    = true;
    offset_A[0] = 0.0;
    offset_A[1] = 0.0;
    for (int x = 0; x < 3; x++) {
        in_force[x] = 0.5;
    }
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &speed_tables_drive));
}

void tearDown(void) {}

static void both(int count)
{
    for (int n = 0; n < count; n++) {
        app_tick();
        app_background();
    }
}

static void command(float omega_e_radps, bool run)
{
    app_objects_t o = app_control_default(&speed_tables_drive);
    o.omega_e_radps = omega_e_radps;
    o.controlword   = run ? APP_CONTROL_ENABLE_OPERATION : APP_CONTROL_SHUT_DOWN;
    TEST_ASSERT_TRUE(app_command_write(&o));
}

static void reset_fault(void)
{
    app_objects_t o = app_control_default(&speed_tables_drive);
    o.controlword   = APP_CONTROL_FAULT_RESET;
    TEST_ASSERT_TRUE(app_command_write(&o));
    both(2);
    command(0.0f, false);
    both(2);
}

static app_mode_t mode(void)
{
    return app_status_read().mode;
}

static void pass_the_index(void)
{
    both(READY_TICKS);
    fake_board.sample.index_seen = true;
    both(1);
    fake_board.sample.index_seen = false;
}

static void go_run(void)
{
    pass_the_index();
    command(0.0f, false);
    both(2);
    command(0.0f, true);
    both(3);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_TRUE(fake_board.gate);
}

/* 385 V and 375 V at 450 V of range. */
static void with_chopper(void)
{
    const app_chopper_config_t chopper = {
        .on_cnt = 3504U, .off_cnt = 3413U, .per_V2 = 2.0e-4f, .tau_s = 2.0f};

    config.board.chopper = 1U;
    config.chopper       = chopper;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &speed_tables_drive));
}

static void test_chopper_follows_the_link_in_every_mode(void)
{
    with_chopper();
    both(2); /* BOOT */
    TEST_ASSERT_EQUAL_INT(0, fake_board.chopper_writes);
    for (int n = 0; n < 3; n++) {
        const uint16_t rest           = fake_board.sample.dc_link_cnt;
        fake_board.sample.dc_link_cnt = 3505U;
        both(1);
        TEST_ASSERT_TRUE(fake_board.chopper);
        const int before = fake_board.chopper_writes;
        both(3); /* each period, or the pin goes low */
        TEST_ASSERT_EQUAL_INT(before + 3, fake_board.chopper_writes);
        TEST_ASSERT_EQUAL_INT(APP_CHOPPER_ON, app_status_read().chopper);
        fake_board.sample.valid = false;
        both(1);
        TEST_ASSERT_FALSE(fake_board.chopper);
        fake_board.sample.valid = true;
        both(1);
        TEST_ASSERT_TRUE(fake_board.chopper);
        fake_board.sample.dc_link_cnt = 3413U;
        both(1);
        TEST_ASSERT_FALSE(fake_board.chopper);
        const int after               = fake_board.chopper_writes;
        fake_board.sample.dc_link_cnt = rest;
        both(50);
        TEST_ASSERT_EQUAL_INT(after, fake_board.chopper_writes);
        TEST_ASSERT_EQUAL_INT(APP_CHOPPER_OFF, app_status_read().chopper);
        if (n == 0) {
            both(READY_TICKS);
            TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode());
        } else {
            fake_board_fail(BOARD_FAULT_TRIP); /* FAULT, or READY with the input active */
            both(5);
        }
    }
}

static void test_a_hot_chopper_is_a_condition(void)
{
    with_chopper();
    both(READY_TICKS);
    fake_board.sample.dc_link_cnt = 3600U;
    both(500); /* 65 ms to the rated heat */
    TEST_ASSERT_FALSE(fake_board.chopper);
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_HOT, app_status_read().chopper);
    TEST_ASSERT_TRUE((app_registers_conditions(&app_line.registers) & 16384U) != 0U);
    TEST_ASSERT_TRUE((app_registers_statusword(&app_line.registers) & 128U) != 0U);
}

static void test_refused_constants_keep_the_chopper_off(void)
{
    with_chopper();
    config.chopper.off_cnt = config.chopper.on_cnt;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_init(&config, &speed_tables_drive));
    fake_board.sample.dc_link_cnt = 4000U;
    both(100);
    TEST_ASSERT_EQUAL_INT(0, fake_board.chopper_writes);
    TEST_ASSERT_EQUAL_INT(APP_CHOPPER_NONE, app_status_read().chopper);
}

static void test_gates_are_enabled_once_and_after_everything_else(void)
{
    go_run();
    fake_board.event_count = 0;
    both(1);
    const fake_board_event_t on[] = {FAKE_BOARD_SAMPLE, FAKE_BOARD_FAULT, FAKE_BOARD_DUTY};
    TEST_ASSERT_EQUAL_INT(3, fake_board.event_count);
    for (int i = 0; i < 3; i++) {
        TEST_ASSERT_EQUAL_INT(on[i], fake_board.events[i]);
    }

    command(0.0f, false);
    both(3); /* a run reads a command first, and obeys it a period later */
    command(0.0f, true);
    both(1);
    fake_board.event_count = 0;
    both(1);
    TEST_ASSERT_EQUAL_INT(4, fake_board.event_count);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_DUTY, fake_board.events[2]);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_ENABLE, fake_board.events[3]);
}

static void test_gates_are_off_before_the_duty_changes(void)
{
    go_run();
    fake_board.sample.valid = false;
    fake_board.event_count  = 0;
    app_tick();
    TEST_ASSERT_FALSE(fake_board.gate);
    TEST_ASSERT_EQUAL_INT(4, fake_board.event_count);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_TRIP, fake_board.events[2]);
    TEST_ASSERT_EQUAL_INT(FAKE_BOARD_DUTY, fake_board.events[3]);
    TEST_ASSERT_TRUE((fake_board.duty.a_cnt == 3750U) && (fake_board.duty.b_cnt == 3750U) &&
                     (fake_board.duty.c_cnt == 3750U));
}

static void test_board_fault_opens_the_bridge_and_enabling_clears_it(void)
{
    go_run();
    fake_board_fail(BOARD_FAULT_OVERRUN);
    app_tick();
    TEST_ASSERT_FALSE(fake_board.gate);
    app_background();
    TEST_ASSERT_EQUAL_INT(APP_FAULT_BOARD, app_status_read().fault);

    fake_board.causes = 0U;
    reset_fault();
    command(0.0f, true);
    both(4);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_TRUE(fake_board.gate);
}

static void test_fault_that_is_still_there_trips_again(void)
{
    go_run();
    fake_board_fail(BOARD_FAULT_TRIP);
    both(1);
    reset_fault();
    command(0.0f, true);
    both(4);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
    TEST_ASSERT_FALSE(fake_board.gate);
}

static void test_reset_acts_once(void)
{
    both(READY_TICKS);
    reset_fault();
    for (int n = 0; n < 60; n++) { /* stopped background: fault */
        app_tick();
    }
    both(5);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
}

static void test_watchdog_is_served_only_when_ticks_go_on(void)
{
    both(10);
    TEST_ASSERT_EQUAL_INT(10, fake_board.served);
    for (int n = 0; n < 100; n++) {
        app_background();
    }
    TEST_ASSERT_EQUAL_INT(10, fake_board.served);
    both(1);
    TEST_ASSERT_EQUAL_INT(11, fake_board.served);
}

static void test_tick_trips_when_the_background_stands_still(void)
{
    go_run();
    for (int n = 0; n < 16; n++) { /* 3 ms, and the first still sees the sign of the last pass */
        app_tick();
        TEST_ASSERT_TRUE(fake_board.gate);
    }
    app_tick();
    TEST_ASSERT_FALSE(fake_board.gate);
    app_background();
    TEST_ASSERT_EQUAL_INT(APP_FAULT_BACKGROUND, app_status_read().fault);
}

static void test_background_that_lives_late_is_enough(void)
{
    go_run();
    for (int n = 0; n < 20; n++) {
        for (int k = 0; k < 15; k++) {
            app_tick();
        }
        app_background();
    }
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
}

static void test_spoilt_end_of_the_stack_opens_the_bridge_at_once(void)
{
    go_run();
    both(1);
    TEST_ASSERT_TRUE(fake_board.gate);
    fake_board.stack_spoilt = true;
    app_background();
    TEST_ASSERT_FALSE(fake_board.gate);
    app_tick();
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
    TEST_ASSERT_EQUAL_INT(APP_FAULT_MEMORY, app_status_read().fault);
}

/* The modes that the tick keeps, around the drive that app_drive() shows. */
static app_modes_t *modes_inside(void)
{
    return (app_modes_t *)((uintptr_t)app_drive() - offsetof(app_modes_t, drive));
}

/* One pointer after the other leads elsewhere: nothing is read through it, and the bridge opens. */
static void test_each_pointer_of_the_tick_alone_opens_the_bridge(void)
{
    static app_config_t   elsewhere;
    static drive_config_t other;
    app_modes_t *const    m          = modes_inside();
    const void **const    pointers[] = {
           (const void **)&m->config,       (const void **)&m->scale.config,
           (const void **)&m->angle.config, (const void **)&m->align.config,
           (const void **)&m->stop.config,  (const void **)&m->drive.config,
    };

    elsewhere = config;
    for (int i = 0; i <= SUPPORT_COUNT(pointers); i++) {
        setUp();
        go_run();
        app_config_t *const constants = (app_config_t *)(uintptr_t)m->config;
        if (i < SUPPORT_COUNT(pointers)) {
            *pointers[i] = (i < 5) ? (const void *)&elsewhere : (const void *)&other;
        } else {
            constants->scale.ntc_degC = &elsewhere.pwm_period_s;
        }
        app_tick();
        TEST_ASSERT_FALSE(fake_board.gate);
        TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, m->mode);
        TEST_ASSERT_EQUAL_INT(APP_FAULT_MEMORY, m->fault);
        app_tick();
        TEST_ASSERT_FALSE(fake_board.gate);
    }
}

/* Sink and thermal model, once in five periods, and never in one: whatever is commanded meanwhile. */
static void test_slow_work_comes_once_in_a_millisecond_and_one_piece_in_a_period(void)
{
    const app_modes_t *const m = modes_inside();

    go_run();
    for (int way = 0; way < 2; way++) {
        int sinks = 0, heats = 0;
        fake_board.sample.ia_cnt = 2100U;
        for (int n = 0; n < 100; n++) {
            const float    x      = m->heat.motor.x;
            const uint16_t before = m->phase_errors;
            fake_board.sample.phase_errors++;
            if ((way == 1) && ((n % 5) == 0)) {
                command(0.0f, true);
            }
            both(1);
            const bool heat = m->heat.motor.x != x;
            const bool sink = m->phase_errors != before;
            TEST_ASSERT_FALSE(heat && sink);
            heats += heat ? 1 : 0;
            sinks += sink ? 1 : 0;
        }
        TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
        TEST_ASSERT_INT_WITHIN(1, 20, sinks);
        TEST_ASSERT_INT_WITHIN(1, 20, heats);
    }
}

static void test_broken_sensor_trips_within_a_millisecond_in_every_phase(void)
{
    for (int phase = 0; phase < 5; phase++) {
        setUp();
        go_run();
        both(phase);
        fake_board.sample.temperature_cnt = 0U;
        both(5);
        TEST_ASSERT_FALSE(fake_board.gate);
        TEST_ASSERT_EQUAL_INT(APP_FAULT_TEMPERATURE_SENSOR, app_status_read().fault);
    }
}

/* Oracle: 1 - exp(-t / tau) of the squared ratio; in a fault, where every period has time for all. */
static void test_thermal_model_keeps_time(void)
{
    const double current_A = 400.0 * 20.0 / 4096.0, per_nominal = current_A / 2.6;

    config.heat.motor_s = 0.5f;
    config.heat.motor_A = 2.6f;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &speed_tables_drive));
    both(READY_TICKS);
    fake_board.sample.ia_cnt = (uint16_t)(fake_board.sample.ia_cnt + 400U);
    fake_board.sample.ib_cnt = (uint16_t)(fake_board.sample.ib_cnt - 200U);
    both(2500);
    TEST_ASSERT_DOUBLE_WITHIN(0.004, per_nominal * per_nominal * (1.0 - exp(-1.0)),
                              (double)app_status_read().motor_heat);
}

static float demand(void)
{
    return app_status_read().demand_e_radps;
}

/* In every period by one step, from the third after the command on, through zero, exactly to the end. */
static void test_ramp_of_a_run_has_no_steps(void)
{
    static const float TS_s = 200.0e-6f, ACCEL = 1000.0f, DECEL = 500.0f, WORST = 1000.0f;
    app_objects_t      o = app_control_default(&speed_tables_drive);

    o.controlword    = APP_CONTROL_ENABLE_OPERATION;
    o.accel_e_radps2 = ACCEL;
    o.decel_e_radps2 = DECEL;
    for (int phase = 0; phase < 5; phase++) {
        setUp();
        go_run();
        both(phase);
        static const float ends[] = {5.0f, -5.0f, 0.0f};
        for (int k = 0; k < 3; k++) {
            const float from = demand(), end = ends[k];
            const float way_s = (fabsf(from) / DECEL) + (fabsf(end) / ACCEL);
            const int   most  = (int)(way_s / TS_s) + 8;
            int         still = 0, n = 0;
            o.omega_e_radps = end;
            TEST_ASSERT_TRUE(app_command_write(&o));
            for (; (n < most) && (demand() != end); n++) {
                const float before = demand();
                app_tick();
                TEST_ASSERT_TRUE(fabsf(demand() - before) <= (WORST * TS_s * 1.001f));
                still += (demand() == before) ? 1 : 0;
                app_background();
            }
            TEST_ASSERT_TRUE(demand() == end);
            TEST_ASSERT_INT_WITHIN(6, (int)(way_s / TS_s) + 2, n);
            TEST_ASSERT_TRUE(still <= 3);
            both(10);
            TEST_ASSERT_TRUE(demand() == end);
        }
    }
}

/* A command that comes just before the aim of the decision before it waits for that. */
static void test_command_begins_its_ramp_in_the_third_or_fourth_period(void)
{
    for (int phase = 0; phase < 5; phase++) {
        app_objects_t o = app_control_default(&speed_tables_drive);
        int           n = 0;

        setUp();
        go_run();
        both(phase);
        o.controlword    = APP_CONTROL_ENABLE_OPERATION;
        o.accel_e_radps2 = 1000.0f;
        o.omega_e_radps  = 50.0f;
        TEST_ASSERT_TRUE(app_command_write(&o));
        for (; (n < 10) && (demand() == 0.0f); n++) {
            both(1);
        }
        TEST_ASSERT_EQUAL_INT((phase == 4) ? 4 : 3, n);
    }
}

static void test_slow_periods_of_every_rate(void)
{
    TEST_ASSERT_EQUAL_UINT(5U, app_slow_periods(200.0e-6f));
    TEST_ASSERT_EQUAL_UINT(10U, app_slow_periods(100.0e-6f));
    TEST_ASSERT_EQUAL_UINT(40U, app_slow_periods(25.0e-6f));
    TEST_ASSERT_EQUAL_UINT(5U,
                           app_slow_periods(1.0f / 2289.0f)); /* a piece never finds no period */
    TEST_ASSERT_EQUAL_UINT(100U, app_slow_periods(0.0f));
    TEST_ASSERT_UINT_WITHIN(48U, 53U, app_slow_periods(NAN));
}

static void test_changed_constants_open_the_bridge_within_some_passes(void)
{
    go_run();
    both(100);
    TEST_ASSERT_TRUE(fake_board.gate);
    app_config_t *const constants = (app_config_t *)(uintptr_t)modes_inside()->config;
    constants->zero_drift_A += 0.01f;
    for (int n = 0; n < 200; n++) {
        app_background();
    }
    TEST_ASSERT_FALSE(fake_board.gate);
    app_tick();
    TEST_ASSERT_EQUAL_INT(APP_FAULT_MEMORY, app_status_read().fault);
}

static void test_background_opens_the_bridge_when_ticks_stand_still(void)
{
    go_run();
    fake_board.cycles_per_read = 1U;
    both(1);
    fake_board.cycles += 70000U;
    app_background();
    TEST_ASSERT_TRUE(fake_board.gate);
    fake_board.cycles += 10000U;
    app_background();
    TEST_ASSERT_FALSE(fake_board.gate);
    both(1);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
    TEST_ASSERT_EQUAL_INT(APP_FAULT_TICK, app_status_read().fault);
}

static void test_second_command_waits_until_the_first_was_taken(void)
{
    app_objects_t first = app_control_default(&speed_tables_drive);
    first.omega_e_radps = 10.0f;
    TEST_ASSERT_TRUE(app_command_write(&first));
    TEST_ASSERT_FALSE(app_command_write(&first));
    app_tick();
    TEST_ASSERT_TRUE(app_command_write(&first));
}

static void test_cycles_of_last_and_worst_tick_are_shown(void)
{
    fake_board.cycles          = 0xFFFFFFF0UL; /* wraps */
    fake_board.cycles_per_read = 1000U;
    both(1);
    TEST_ASSERT_EQUAL_UINT(1000U, app_status_read().tick_cycles);
    fake_board.cycles_per_read = 3000U;
    both(1);
    fake_board.cycles_per_read = 100U;
    both(1);
    TEST_ASSERT_EQUAL_UINT(100U, app_status_read().tick_cycles);
    TEST_ASSERT_EQUAL_UINT(3000U, app_status_read().tick_cycles_worst);
    fake_board.cycles_per_read = 100000U;
    both(1);
    TEST_ASSERT_EQUAL_UINT(65535U, app_status_read().tick_cycles_worst);
}

static void test_bad_constants_keep_the_bridge_off_and_are_told(void)
{
    config.modbus_address = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_init(&config, &speed_tables_drive));
    setUp();
    config.dead_time_s = 1.0e-6f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_init(&config, &speed_tables_drive));
    both(READY_TICKS);
    command(0.0f, true);
    both(10);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_CONFIG, app_status_read().fault);
    TEST_ASSERT_FALSE(fake_board.gate);
    TEST_ASSERT_TRUE(fake_board.served > READY_TICKS); /* alive, to be asked why */
}

static void test_a_drive_without_a_law_keeps_the_bridge_off(void)
{
    drive_config_t none = speed_tables_drive;
    none.law            = NULL;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, app_init(&config, &none));
    both(READY_TICKS);
    command(0.0f, true);
    both(10);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_CONFIG, app_status_read().fault);
    TEST_ASSERT_FALSE(fake_board.gate);
}

static void test_init_forgets_everything(void)
{
    fake_board.cycles_per_read = 500U;
    go_run();
    command(5.0f, true);
    const int served = fake_board.served;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &speed_tables_drive));
    app_background();
    TEST_ASSERT_EQUAL_INT(served, fake_board.served); /* no tick yet */
    TEST_ASSERT_EQUAL_UINT(0U, app_status_read().board_faults);
    command(0.0f, false); /* there is room: the one before is gone */
    fake_board.cycles_per_read = 100U;
    both(1);
    TEST_ASSERT_EQUAL_UINT(100U, app_status_read().tick_cycles_worst);
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &speed_tables_drive));
    TEST_ASSERT_EQUAL_INT(APP_MODE_BOOT, mode());
    TEST_ASSERT_EQUAL_UINT(0U, (unsigned)app_status_read().ticks);
    both(READY_TICKS + 10);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode());
}

/* The CRC is tested in test_app_modbus.c. */
static void modbus_write(int address, int value)
{
    int      frame[8] = {1, 6, 0, address, (value >> 8) & 0xFF, value & 0xFF, 0, 0};
    unsigned crc      = 0xFFFFu;
    for (int i = 0; i < 6; i++) {
        crc ^= (unsigned)frame[i];
        for (int bit = 0; bit < 8; bit++) {
            crc = ((crc & 1u) != 0u) ? ((crc >> 1) ^ 0xA001u) : (crc >> 1);
        }
    }
    frame[6] = (int)(crc & 0xFFu);
    frame[7] = (int)(crc >> 8);
    fake_board_receive(frame, 8);
    both(14);
}

static void test_modbus_starts_stops_and_resets(void)
{
    pass_the_index();
    modbus_write(APP_REGISTERS_SPEED_RPM_16, 100);
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode()); /* it has to be shut down first */
    modbus_write(APP_REGISTERS_CONTROLWORD, 6);
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_TRUE(fake_board.gate);
    TEST_ASSERT_TRUE(app_drive()->law.noc.near_optimal.speed_ref.omega_e_radps > 0.0f);
    fake_board.sample.dc_link_cnt = 0U;
    both(1);
    fake_board.sample.dc_link_cnt = 2685U;
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
    modbus_write(APP_REGISTERS_CONTROLWORD, 128 + 15);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode());
    both(20);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode()); /* a run has to be asked for anew */
    modbus_write(APP_REGISTERS_CONTROLWORD, 6);
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
}

static void test_command_of_modbus_is_given_once(void)
{
    go_run();
    modbus_write(APP_REGISTERS_SPEED_RPM_16, 0);
    command(0.0f, false);
    both(2);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode());
    command(0.0f, true);
    both(20);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY + 2, (int)mode()); /* not withdrawn again */

    fake_board.sample.dc_link_cnt = 0U;
    both(1);
    fake_board.sample.dc_link_cnt = 2685U;
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
    modbus_write(APP_REGISTERS_CONTROLWORD, 0);
    TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, mode());
}

/* With the shipped drive, whose law can. The way there and back, while the motor stands under control. */
static void test_inertia_start_brings_the_second_set_of_constants(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &gain_tables_drive));
    pass_the_index();
    modbus_write(APP_REGISTERS_CONTROLWORD, 6);
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_TRUE(app_drive()->config == &gain_tables_drive);

    modbus_write(APP_REGISTERS_INERTIA_START, 2000);
    both(15); /* a run takes one piece in a period */
    const drive_config_t *const second = app_drive()->config;
    TEST_ASSERT_TRUE(second != &gain_tables_drive);
    TEST_ASSERT_FLOAT_WITHIN(1.0f, 0.5f * gain_tables_drive.motor.l1, second->motor.l1);
    both(500);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_TRUE(app_drive()->config == second);

    modbus_write(APP_REGISTERS_INERTIA_START, 3000); /* by way of the drive's own */
    both(15);                                        /* a run takes one piece in a period */
    TEST_ASSERT_TRUE(app_drive()->config == second);
    TEST_ASSERT_FLOAT_WITHIN(1.0f, gain_tables_drive.motor.l1 / 3.0f, second->motor.l1);
    both(500);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());

    modbus_write(APP_REGISTERS_INERTIA_START, 0);
    both(15); /* a run takes one piece in a period */
    TEST_ASSERT_TRUE(app_drive()->config == &gain_tables_drive);
    both(500);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_TRUE(fake_board.gate);
}

/* A run to a position has the drive's own inertia. The mode and its constants come together. */
static void test_a_position_never_meets_the_second_set(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &gain_tables_drive));
    both(READY_TICKS);
    modbus_write(APP_REGISTERS_INERTIA_START, 2000);
    TEST_ASSERT_TRUE(app_drive()->config != &gain_tables_drive);
    modbus_write(APP_REGISTERS_MODE_OF_OPERATION, 1);
    TEST_ASSERT_TRUE(app_drive()->config == &gain_tables_drive);
    modbus_write(APP_REGISTERS_MODE_OF_OPERATION, 3);
    TEST_ASSERT_TRUE(app_drive()->config != &gain_tables_drive);
}

static void test_a_changed_second_set_opens_the_bridge(void)
{
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, &gain_tables_drive));
    pass_the_index();
    modbus_write(APP_REGISTERS_INERTIA_START, 2000);
    modbus_write(APP_REGISTERS_CONTROLWORD, 6);
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    both(400);
    TEST_ASSERT_TRUE(fake_board.gate);
    drive_config_t *const second = (drive_config_t *)(uintptr_t)app_drive()->config;
    TEST_ASSERT_TRUE(second != &gain_tables_drive);
    second->motor.l2 += 0.01f;
    for (int n = 0; n < 400; n++) {
        app_background();
    }
    TEST_ASSERT_FALSE(fake_board.gate);
}

static void tick_as_interrupt(int signal)
{
    (void)signal;
    fake_board.sample.position_cnt = (uint16_t)((fake_board.sample.position_cnt + 1U) % 10000U);
    app_tick();
}

/* Ticks interrupt the background anywhere: each sets the position to its own number. */
static void test_status_is_copied_whole_though_ticks_interrupt(void)
{
    const struct itimerval every = {.it_interval = {.tv_usec = 100}, .it_value = {.tv_usec = 100}};
    const struct itimerval never = {.it_value = {.tv_usec = 0}};
    uint32_t               last  = 0U;

    struct sigaction action;
    (void)memset(&action, 0, sizeof action);
    action.sa_handler = tick_as_interrupt;
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGALRM, &action, NULL));
    TEST_ASSERT_EQUAL_INT(0, setitimer(ITIMER_REAL, &every, NULL));
    bool whole = true;
    while (whole && (last < 3000U)) {
        const app_status_t s = app_status_read();
        whole = (s.ticks >= last) && (s.position_cnt == (uint16_t)(s.ticks % 10000U));
        last  = s.ticks;
    }
    TEST_ASSERT_EQUAL_INT(0, setitimer(ITIMER_REAL, &never, NULL));
    TEST_ASSERT_TRUE(whole);
}

static void test_lost_communication_opens_the_bridge(void)
{
    pass_the_index();
    modbus_write(APP_REGISTERS_CONTROLWORD, 6);
    modbus_write(APP_REGISTERS_CONTROLWORD, 15);
    both(2480);
    TEST_ASSERT_TRUE(fake_board.gate);
    both(30);
    TEST_ASSERT_FALSE(fake_board.gate);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, mode());
}

static uint16_t code(double current_A)
{
    return (uint16_t)(2048 + (int)lround(current_A * 4096.0 / 20.0));
}

/* One period of the whole loop: samples at its start, the duty ratios written now act in the next one. */
static void period(void)
{
    const int before               = fake_board.sample.position_cnt;
    const int now                  = test_motor_position(&motor, MARK_RAD);
    fake_board.sample.ia_cnt       = code(test_motor_phase_A(&motor, 0) + offset_A[0]);
    fake_board.sample.ib_cnt       = code(test_motor_phase_A(&motor, 1) + offset_A[1]);
    fake_board.sample.dc_link_cnt  = (uint16_t)(motor.v_dc_V * 4096.0 / 450.0);
    fake_board.sample.index_seen   = index_on && (abs(now - before) > 5000);
    fake_board.sample.index_cnt    = 0U;
    fake_board.sample.position_cnt = (uint16_t)now;
    fake_board.sample.edge_seen    = now != before;
    fake_board.sample.edge_age_cnt =
        (uint16_t)fmin(test_motor_edge_age_s(&motor, MARK_RAD) * BOARD_CAPTURE_Hz, 65535.0);
    both(1);
    test_motor_period(&motor, in_force, fake_board.gate);
    in_force[0] = (double)fake_board.duty.a_cnt / 7500.0;
    in_force[1] = (double)fake_board.duty.b_cnt / 7500.0;
    in_force[2] = (double)fake_board.duty.c_cnt / 7500.0;
}

static void periods(int count)
{
    for (int n = 0; n < count; n++) {
        period();
    }
}

static double mean_speed_radps(int count)
{
    double sum = 0.0;
    for (int n = 0; n < count; n++) {
        period();
        sum += 2.0 * motor.omega_m_radps;
    }
    return sum / (double)count;
}

/* The mark is MARK_RAD from the d axis: 2 x 0.7 rad electrical. */
static void start_motor(const drive_config_t *drive)
{
    config.angle.index_theta_e_rad = (float)(2.0 * MARK_RAD);
    tolerance_radps = (drive->law == &law_noc) ? TOL_ENCODER_RADPS : TOL_SPEED_FORM_RADPS;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_init(&config, drive));
}

static void assert_runs_at(float omega_e_radps)
{
    if (app_status_read().state != APP_CONTROL_OPERATION_ENABLED) {
        command(0.0f, false);
        periods(2);
    }
    command(omega_e_radps, true);
    periods(3000);
    TEST_ASSERT_EQUAL_INT(APP_FAULT_NONE, app_status_read().fault);
    TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
    TEST_ASSERT_DOUBLE_WITHIN(tolerance_radps, (double)omega_e_radps, mean_speed_radps(1000));
}

/* Counts to compare values around a motor, both observers, both directions, sensors with an offset. */
static void test_whole_loop_runs_from_the_index_and_follows_the_command(void)
{
    const drive_config_t *const drives[] = {&speed_tables_drive, &gain_tables_drive};
    for (int i = 0; i < SUPPORT_COUNT(drives); i++) {
        setUp();
        start_motor(drives[i]);
        offset_A[0]         = 0.3;
        offset_A[1]         = -0.4;
        motor.omega_m_radps = 20.0; /* turned by hand until the mark has passed */
        motor.load_Nm       = 0.0;
        periods(READY_TICKS + 500);
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, app_status_read().reference);
        assert_runs_at(200.0f);
        motor.load_Nm = 0.5;
        assert_runs_at(200.0f);
        assert_runs_at(-150.0f);
        TEST_ASSERT_EQUAL_UINT(0U, app_status_read().index_corrections);
        /* with the offsets taken away, MTPA at 0.5 N m is 0.87 A */
        TEST_ASSERT_TRUE(hypot(motor.id_A, motor.iq_A) < 1.2);
    }
}

/* Registers 96 and 97: function 4, two of them. */
static void test_whole_loop_shows_the_inertia_of_its_motor(void)
{
    const int request[] = {1, 4, 0, 96, 0, 2};
    int       answer[9] = {0};

    start_motor(&gain_tables_drive);
    motor.omega_m_radps = 20.0;
    motor.load_Nm       = 0.0;
    periods(READY_TICKS + 500);
    assert_runs_at(200.0f);
    assert_runs_at(-150.0f);
    while (fake_board_sent() >= 0) {
    }
    modbus_frame_receive(request, 6);
    periods(14);
    for (int i = 0; i < SUPPORT_COUNT(answer); i++) {
        answer[i] = fake_board_sent();
    }
    TEST_ASSERT_EQUAL_INT(4, answer[2]); /* octets */
    TEST_ASSERT_INT_WITHIN(60, 1000, (256 * answer[3]) + answer[4]);
    TEST_ASSERT_EQUAL_INT(1, (256 * answer[5]) + answer[6]); /* a start has no rest before it */
}

static void test_whole_loop_aligns_without_an_index_and_runs(void)
{
    const drive_config_t *const drives[] = {&speed_tables_drive, &gain_tables_drive};
    for (int i = 0; i < SUPPORT_COUNT(drives); i++) {
        setUp();
        start_motor(drives[i]);
        index_on          = false;
        motor.theta_m_rad = 2.3;
        motor.coulomb_Nm  = 0.01;
        periods(READY_TICKS);
        command(0.0f, false);
        periods(2);
        command(0.0f, true);
        periods(14105);
        TEST_ASSERT_EQUAL_INT(APP_ANGLE_ALIGNED, app_status_read().reference);
        TEST_ASSERT_EQUAL_INT(APP_MODE_RUN, mode());
        assert_runs_at(150.0f);
    }
}

static void test_index_after_alignment_takes_over_on_the_run(void)
{
    start_motor(&speed_tables_drive);
    motor.theta_m_rad = 2.3;
    index_on          = false;
    periods(READY_TICKS);
    command(0.0f, false);
    periods(2);
    command(0.0f, true);
    periods(14105);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_ALIGNED, app_status_read().reference);
    index_on = true;
    assert_runs_at(100.0f);
    TEST_ASSERT_EQUAL_INT(APP_ANGLE_INDEX, app_status_read().reference);
    const double sampled_rad = 2.0 * motor.theta_m_rad; /* what the next tick samples */
    period();
    TEST_ASSERT_DOUBLE_WITHIN(
        TOL_ANGLE, 0.0,
        remainder((double)app_status_read().theta_e_rad - sampled_rad, 6.283185307179586));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_chopper_follows_the_link_in_every_mode);
    RUN_TEST(test_a_hot_chopper_is_a_condition);
    RUN_TEST(test_refused_constants_keep_the_chopper_off);
    RUN_TEST(test_gates_are_enabled_once_and_after_everything_else);
    RUN_TEST(test_gates_are_off_before_the_duty_changes);
    RUN_TEST(test_board_fault_opens_the_bridge_and_enabling_clears_it);
    RUN_TEST(test_fault_that_is_still_there_trips_again);
    RUN_TEST(test_reset_acts_once);
    RUN_TEST(test_watchdog_is_served_only_when_ticks_go_on);
    RUN_TEST(test_tick_trips_when_the_background_stands_still);
    RUN_TEST(test_background_that_lives_late_is_enough);
    RUN_TEST(test_spoilt_end_of_the_stack_opens_the_bridge_at_once);
    RUN_TEST(test_each_pointer_of_the_tick_alone_opens_the_bridge);
    RUN_TEST(test_slow_work_comes_once_in_a_millisecond_and_one_piece_in_a_period);
    RUN_TEST(test_broken_sensor_trips_within_a_millisecond_in_every_phase);
    RUN_TEST(test_thermal_model_keeps_time);
    RUN_TEST(test_ramp_of_a_run_has_no_steps);
    RUN_TEST(test_command_begins_its_ramp_in_the_third_or_fourth_period);
    RUN_TEST(test_slow_periods_of_every_rate);
    RUN_TEST(test_changed_constants_open_the_bridge_within_some_passes);
    RUN_TEST(test_background_opens_the_bridge_when_ticks_stand_still);
    RUN_TEST(test_second_command_waits_until_the_first_was_taken);
    RUN_TEST(test_cycles_of_last_and_worst_tick_are_shown);
    RUN_TEST(test_bad_constants_keep_the_bridge_off_and_are_told);
    RUN_TEST(test_a_drive_without_a_law_keeps_the_bridge_off);
    RUN_TEST(test_init_forgets_everything);
    RUN_TEST(test_modbus_starts_stops_and_resets);
    RUN_TEST(test_command_of_modbus_is_given_once);
    RUN_TEST(test_inertia_start_brings_the_second_set_of_constants);
    RUN_TEST(test_a_position_never_meets_the_second_set);
    RUN_TEST(test_a_changed_second_set_opens_the_bridge);
    RUN_TEST(test_status_is_copied_whole_though_ticks_interrupt);
    RUN_TEST(test_lost_communication_opens_the_bridge);
    RUN_TEST(test_whole_loop_runs_from_the_index_and_follows_the_command);
    RUN_TEST(test_whole_loop_shows_the_inertia_of_its_motor);
    RUN_TEST(test_whole_loop_aligns_without_an_index_and_runs);
    RUN_TEST(test_index_after_alignment_takes_over_on_the_run);
    return UNITY_END();
}
