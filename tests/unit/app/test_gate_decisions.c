/* SPDX-License-Identifier: MIT */
/* Every decision that can enable the gates (docs/assurance.md has their names): each of its conditions alone makes the
 * difference. A row is what is changed on a drive whose gates would be on; without the change they are. */
#include <string.h>

#include "app_modes.h"
#include "app_slow.h"
#include "board_config.h"
#include "gain_tables.h"
#include "unit_support.h"
#include "unity.h"

#define READY_TICKS (250 + 1280 + 1)

typedef struct {
    const char *what;
    void (*change)(void); /* or one of these becomes `to` */
    bool     *flag;
    float    *number;
    uint16_t *word;
    float     to;
    int       fault; /* what it is found as, where it is a fault */
} row_t;

static void apply(const row_t *row)
{
    if (row->change != NULL) {
        row->change();
    } else if (row->flag != NULL) {
        *row->flag = row->to != 0.0f;
    } else if (row->number != NULL) {
        *row->number = row->to;
    } else {
        *row->word = (uint16_t)row->to;
    }
}

/* The core, with a law that answers what a test wants. */

static law_output_t    answer;
static bool            counts_hold;
static drive_config_t  drive_config;
static drive_config_t  other_config;
static drive_t         drive;
static drive_sample_t  sample;
static drive_command_t command;

static bool check(const drive_config_t *c)
{
    return c != NULL;
}

static void reset(law_state_t *state, const drive_config_t *c, const drive_sample_t *s)
{
    (void)c;
    state->own[0] = s->theta_e_rad;
}

static void step(law_state_t *state, const drive_config_t *c, const law_input_t *in,
                 law_output_t *out)
{
    (void)state;
    (void)c;
    (void)in;
    *out = answer;
}

static bool counts_ok(const drive_config_t *c)
{
    return counts_hold && (c != NULL);
}

static const law_t plain_law = {.check = check, .reset = reset, .step = step};
static const law_t law = {.check = check, .reset = reset, .step = step, .counts_ok = counts_ok};

static void start_core(void)
{
    const law_output_t    good  = {.v_V = {.d = 1.0f, .q = 2.0f}, .plausible = true};
    const drive_sample_t  rest  = {.dc_link_V = 295.0f, .theta_e_rad = 1.0f, .valid = true};
    const drive_command_t going = {.omega_e_radps = 0.0f, .run = true};

    answer               = good;
    sample               = rest;
    command              = going;
    counts_hold          = true;
    drive_config         = gain_tables_drive;
    drive_config.law     = &law;
    drive_config.torques = false;
    other_config         = drive_config;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &drive_config));
}

static void no_config(void)
{
    drive_config.ts_s = 0.0f;
    TEST_ASSERT_EQUAL_INT(CTL_BAD_CONFIG, drive_init(&drive, &drive_config));
}

static void in_fault(void)
{
    drive.state = DRIVE_FAULT;
}

static void config_changed(void)
{
    drive.config = &other_config;
}

static void law_changed(void)
{
    drive_config.law = &plain_law;
}

static void constants_changed(void)
{
    drive_config.constants = &answer;
}

/* A watch needs some periods to trip: its state is set to one period before that. */
static void phase_without_current(void)
{
    drive.motion_watch.look        = MOTION_WATCH_LOOK_CURRENTS;
    drive.current_watch.ref_A.beta = 3.0f;
    drive.current_watch.empty_s    = 1.0f;
    drive.current_watch.empty      = 2; /* b */
}

static void current_of_another_motor(void)
{
    drive.current_watch.models              = true;
    drive.current_watch.phase[0].residual_A = 10.0f;
}

static void current_sensor_drifted(void)
{
    drive.motion_watch.look           = MOTION_WATCH_LOOK_CURRENTS;
    drive.current_watch.models        = true;
    drive.current_watch.drift_A.alpha = 10.0f;
    answer.predicted                  = true;
    answer.now.omega_e_radps          = 300.0f;
    sample.ia_A                       = 1.5f;
}

static void voltage_of_another_motor(void)
{
    drive.motion_watch.odd_s         = 1.0f;
    answer.predicted                 = true;
    drive.current_watch.d_slow_Aps.q = 1.0e6f;
}

static const row_t core_rows[] = {
    {"config", .change = no_config, .fault = DRIVE_FAULT_NONE},
    {"state", .change = in_fault, .fault = DRIVE_FAULT_NONE},
    {"config_again", .change = config_changed, .fault = DRIVE_FAULT_MEMORY},
    {"law_again", .change = law_changed, .fault = DRIVE_FAULT_MEMORY},
    {"constants_again", .change = constants_changed, .fault = DRIVE_FAULT_MEMORY},
    {"counts_ok", .flag = &counts_hold, .to = 0.0f, .fault = DRIVE_FAULT_MEMORY},
    {"valid", .flag = &sample.valid, .to = 0.0f, .fault = DRIVE_FAULT_SAMPLE},
    {"theta", .number = &sample.theta_e_rad, .to = 6.3f, .fault = DRIVE_FAULT_SAMPLE},
    {"band", .number = &sample.band_rad, .to = 3.2f, .fault = DRIVE_FAULT_SAMPLE},
    {"edge_gap", .number = &sample.edge_gap_s, .to = -1.0f, .fault = DRIVE_FAULT_SAMPLE},
    {"edge_age", .number = &sample.edge_age_s, .to = (float)NAN, .fault = DRIVE_FAULT_SAMPLE},
    {"currents", .number = &sample.ib_A, .to = (float)NAN, .fault = DRIVE_FAULT_OVER_CURRENT},
    {"dc link low", .number = &sample.dc_link_V, .to = 10.0f, .fault = DRIVE_FAULT_DC_LINK},
    {"dc link high", .number = &sample.dc_link_V, .to = 500.0f, .fault = DRIVE_FAULT_DC_LINK},
    {"omega", .number = &sample.omega_e_radps, .to = -1.0e5f, .fault = DRIVE_FAULT_OVER_SPEED},
    {"command", .number = &command.omega_e_radps, .to = 1.0e5f, .fault = DRIVE_FAULT_COMMAND},
    {"run", .flag = &command.run, .to = 0.0f, .fault = DRIVE_FAULT_NONE},
    {"plausible", .flag = &answer.plausible, .to = 0.0f, .fault = DRIVE_FAULT_ENCODER},
    {"now.omega", .number = &answer.now.omega_e_radps, .to = (float)NAN,
     .fault = DRIVE_FAULT_OVER_SPEED},
    {"v.d", .number = &answer.v_V.d, .to = (float)NAN, .fault = DRIVE_FAULT_NUMERIC},
    {"v.q", .number = &answer.v_V.q, .to = (float)NAN, .fault = DRIVE_FAULT_NUMERIC},
    {"phase", .change = phase_without_current, .fault = DRIVE_FAULT_PHASE},
    {"current sensor", .change = current_of_another_motor, .fault = DRIVE_FAULT_CURRENT_SENSOR},
    {"drift", .change = current_sensor_drifted, .fault = DRIVE_FAULT_CURRENT_SENSOR},
    {"motion", .change = voltage_of_another_motor, .fault = DRIVE_FAULT_MODEL},
};

static void test_each_condition_of_the_core_alone_keeps_the_gates_off(void)
{
    for (int i = 0; i < SUPPORT_COUNT(core_rows); i++) {
        for (int periods = 0; periods < 2; periods++) { /* at the start, and in a run */
            start_core();
            for (int n = 0; n < periods; n++) {
                TEST_ASSERT_TRUE(drive_tick(&drive, &sample, &command).gate_enable);
            }
            const drive_t before = drive;
            TEST_ASSERT_TRUE_MESSAGE(drive_tick(&drive, &sample, &command).gate_enable,
                                     core_rows[i].what);
            drive = before;
            if ((periods == 0) && (i >= SUPPORT_COUNT(core_rows) - 4)) {
                continue; /* a start resets the watches */
            }
            apply(&core_rows[i]);
            TEST_ASSERT_FALSE_MESSAGE(drive_tick(&drive, &sample, &command).gate_enable,
                                      core_rows[i].what);
            TEST_ASSERT_EQUAL_INT_MESSAGE(core_rows[i].fault, drive.fault, core_rows[i].what);
        }
    }
}

static void test_law_without_counts_runs(void)
{
    start_core();
    drive_config.law = &plain_law;
    TEST_ASSERT_EQUAL_INT(CTL_OK, drive_init(&drive, &drive_config));
    counts_hold = false;
    TEST_ASSERT_TRUE(drive_tick(&drive, &sample, &command).gate_enable);
}

/* Loop limits in the constants of the shipped laws. */

static law_noc_config_t          noc;
static law_noc_speed_config_t    noc_speed;
static law_noc_h_config_t        noc_h;
static law_conventional_config_t conventional;
static law_dobc_config_t         dobc;
static law_pi_foc_config_t       pi_foc;
static law_ladrc_config_t        ladrc;

static const struct {
    const law_t *law;
    const void  *constants;
    int16_t     *count;
    int16_t      least;
    int16_t      most;
} counts[] = {
    {&law_noc, &noc, &noc.near_optimal.nosc.order, 0, NOSC_ORDER_MAX},
    {&law_noc, &noc, &noc.nodo.order, 0, NODO_ORDER_MAX},
    {&law_noc_speed, &noc_speed, &noc_speed.near_optimal.nosc.order, 0, NOSC_ORDER_MAX},
    {&law_noc_speed, &noc_speed, &noc_speed.nodo.order, 0, NODO_ORDER_MAX},
    {&law_noc_h, &noc_h, &noc_h.near_optimal.nosc.order, 0, NOSC_ORDER_MAX},
    {&law_noc_h, &noc_h, &noc_h.nodo.n_pairs, 0, NODO_HARMONIC_PAIRS_MAX},
    {&law_noc_h, &noc_h, &noc_h.nodo.n_nodes, 2, NODO_HARMONIC_NODES_MAX},
    {&law_conventional, &conventional, &conventional.gains.nosc_order, 0, DOUBLE_SERIES_ORDER_MAX},
    {&law_conventional, &conventional, &conventional.gains.nodo_order, 0, DOUBLE_SERIES_ORDER_MAX},
    {&law_dobc, &dobc, &dobc.dobc.n_x, 1, DOBC_N_X_MAX},
    {&law_pi_foc, &pi_foc, &pi_foc.speed.periods, 1, SPEED_DIFFERENCE_PERIODS_MAX},
    {&law_ladrc, &ladrc, &ladrc.speed.periods, 1, SPEED_DIFFERENCE_PERIODS_MAX},
};

static void test_each_count_of_a_law_alone_is_found(void)
{
    for (int i = 0; i < SUPPORT_COUNT(counts); i++) {
        *counts[i].count = counts[i].least;
    }
    for (int i = 0; i < SUPPORT_COUNT(counts); i++) {
        const drive_config_t c = {.law = counts[i].law, .constants = counts[i].constants};
        TEST_ASSERT_TRUE(c.law->counts_ok(&c));
        *counts[i].count = counts[i].most;
        TEST_ASSERT_TRUE(c.law->counts_ok(&c));
        *counts[i].count = (int16_t)(counts[i].most + 1);
        TEST_ASSERT_FALSE(c.law->counts_ok(&c));
        *counts[i].count = (int16_t)(counts[i].least - 1);
        TEST_ASSERT_FALSE(c.law->counts_ok(&c));
        *counts[i].count = counts[i].least;
    }
}

/* The application. */

static app_config_t      config;
static app_modes_t       modes;
static board_sample_t    raw;
static app_modes_input_t in;
static bridge_t          out;
static uint16_t          step_cnt; /* per tick */

static void turn(int count)
{
    for (int n = 0; n < count; n++) {
        raw.position_cnt = (uint16_t)((raw.position_cnt + step_cnt) % 10000U);
        out              = app_modes_tick(&modes, &in);
    }
}

static void init(void)
{
    const board_sample_t    rest  = {.ia_cnt          = 2048U,
                                     .ib_cnt          = 2048U,
                                     .dc_link_cnt     = 2685U,
                                     .temperature_cnt = 3357U,
                                     .valid           = true};
    const app_modes_input_t quiet = {.raw = &raw, .slow = APP_SLOW_TURN};

    raw      = rest;
    in       = quiet;
    step_cnt = 0U;
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_modes_init(&modes, &config, &drive_config));
}

void setUp(void)
{
    config       = board_config;
    drive_config = gain_tables_drive;
}

void tearDown(void) {}

/* Ready, with a referenced angle; the run is not given yet. */
static void go_ready(void)
{
    init();
    turn(READY_TICKS);
    TEST_ASSERT_EQUAL_INT(APP_MODE_READY, modes.mode);
    raw.index_seen = true;
    turn(1);
    raw.index_seen = false;
}

static void go_run(void)
{
    go_ready();
    in.command.run = true;
    turn(2);
}

static void go_precharge(void)
{
    config.gate.precharge_ticks         = 7U;
    config.gate.precharge_speed_e_radps = 50.0f;
    go_run();
    TEST_ASSERT_EQUAL_INT(APP_MODE_PRECHARGE, modes.mode);
}

static void go_align(void)
{
    init();
    turn(READY_TICKS);
    in.command.run = true;
    turn(502);
    TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
}

static void go_stop(void)
{
    config.stop.reaction = APP_STOP_RAMP;
    go_ready();
    in.command.run           = true;
    in.command.omega_e_radps = 88.0f;
    step_cnt                 = 14U; /* 88 rad/s */
    turn(3);
    in.command.run = false;
    turn(1);
    TEST_ASSERT_EQUAL_INT(APP_MODE_STOP, modes.mode);
}

typedef struct {
    const char *mode;
    void (*go)(void);
} way_t;

static const way_t driving[] = {
    {"run", go_run}, {"precharge", go_precharge}, {"align", go_align}, {"stop", go_stop}};

static void fault_of_config(void)
{
    modes.fault = APP_FAULT_CONFIG;
}

static void mode_fault(void)
{
    modes.mode = APP_MODE_FAULT;
}

static void index_far_off(void)
{
    modes.angle.have_index      = true;
    modes.angle.reference       = APP_ANGLE_INDEX;
    modes.angle.since_index_cnt = 12500; /* none in a turn and 100 counts */
    raw.position_cnt            = (uint16_t)(raw.position_cnt + 1U);
}

static const row_t app_rows[] = {
    {"fault config", .change = fault_of_config, .fault = APP_FAULT_CONFIG},
    {"mode fault", .change = mode_fault, .fault = APP_FAULT_NONE},
    {"memory", .flag = &in.memory_changed, .to = 1.0f, .fault = APP_FAULT_MEMORY},
    {"background", .flag = &in.background_lost, .to = 1.0f, .fault = APP_FAULT_BACKGROUND},
    {"board faults", .word = &in.board_faults, .to = (float)BOARD_FAULT_OVERRUN,
     .fault = APP_FAULT_BOARD},
    {"tick missing", .flag = &in.tick_missing, .to = 1.0f, .fault = APP_FAULT_TICK},
    {"index", .change = index_far_off, .fault = APP_FAULT_INDEX},
    {"sample", .flag = &raw.valid, .to = 0.0f, .fault = APP_FAULT_SAMPLE},
    {"heat", .number = &modes.heat.motor.x, .to = 2.0f, .fault = APP_FAULT_HEAT},
    {"temperature sensor", .word = &raw.temperature_cnt, .to = 0.0f,
     .fault = APP_FAULT_TEMPERATURE_SENSOR},
    {"temperature", .word = &raw.temperature_cnt, .to = 1400.0f, .fault = APP_FAULT_TEMPERATURE},
    {"drive", .word = &raw.dc_link_cnt, .to = 100.0f, .fault = APP_FAULT_DRIVE},
};

static void test_each_condition_of_the_application_alone_opens_the_bridge(void)
{
    for (int w = 0; w < SUPPORT_COUNT(driving); w++) {
        setUp();
        driving[w].go();
        const app_modes_t    before        = modes;
        const board_sample_t sample_before = raw;
        turn(1);
        TEST_ASSERT_TRUE_MESSAGE(out.gate_enable, driving[w].mode);
        for (int i = 0; i < SUPPORT_COUNT(app_rows); i++) {
            const app_modes_input_t input_before = in;
            modes                                = before;
            raw                                  = sample_before;
            apply(&app_rows[i]);
            turn(1);
            TEST_ASSERT_FALSE_MESSAGE(out.gate_enable, app_rows[i].what);
            TEST_ASSERT_EQUAL_INT_MESSAGE(app_rows[i].fault, modes.fault, app_rows[i].what);
            in = input_before;
        }
    }
}

/* A start: the second tick after `run` has the gates on, unless something is in its way. */
static bool starts(const row_t *row)
{
    in.command.run = true;
    if (row != NULL) {
        apply(row);
    }
    turn(2);
    return out.gate_enable;
}

static void zero_a_moved(void)
{
    modes.timer_ticks = 100U;
    modes.zero_a_A    = 10.0f;
}

static void zero_b_moved(void)
{
    modes.timer_ticks = 100U;
    modes.zero_b_A    = -10.0f;
}

static const row_t start_rows[] = {
    {"run", .flag = &in.command.run, .to = 0.0f},
    {"armed", .flag = &modes.armed, .to = 0.0f},
    {"hot", .word = &raw.temperature_cnt, .to = 1700.0f},
    {"dc link", .word = &raw.dc_link_cnt, .to = 100.0f},
    {"trip input", .word = &in.board_faults, .to = (float)BOARD_FAULT_INPUT},
    {"zero a", .change = zero_a_moved},
    {"zero b", .change = zero_b_moved},
    {"speed", .word = &step_cnt, .to = 10.0f},
};

static void test_each_condition_of_a_start_alone_keeps_the_gates_off(void)
{
    config.gate.precharge_ticks         = 7U;
    config.gate.precharge_speed_e_radps = 50.0f;
    go_ready();
    const app_modes_t    before        = modes;
    const board_sample_t sample_before = raw;
    TEST_ASSERT_TRUE(starts(NULL));
    for (int i = 0; i < SUPPORT_COUNT(start_rows); i++) {
        modes           = before;
        raw             = sample_before;
        in.board_faults = 0U;
        step_cnt        = 0U;
        TEST_ASSERT_FALSE_MESSAGE(starts(&start_rows[i]), start_rows[i].what);
    }
}

/* One condition of a pair alone does not prevent a start. */
static void test_what_alone_is_not_in_the_way(void)
{
    go_ready();
    TEST_ASSERT_TRUE(starts(&start_rows[SUPPORT_COUNT(start_rows) - 1])); /* nothing to charge */
    go_ready();
    in.board_faults = BOARD_FAULT_TRIP; /* latched with the gates off: enabling clears it */
    TEST_ASSERT_TRUE(starts(NULL));
    go_ready();
    in.tick_missing = true;
    turn(1);
    in.tick_missing = false;
    TEST_ASSERT_TRUE(starts(NULL));
    go_ready();
    modes.zero_a_A    = 10.0f; /* currents may be on their way out */
    modes.timer_ticks = 0U;
    TEST_ASSERT_TRUE(starts(NULL));
    init();
    turn(READY_TICKS); /* no reference: ALIGN watches for a tenth of a second first */
    TEST_ASSERT_FALSE(starts(NULL));
    TEST_ASSERT_EQUAL_INT(APP_MODE_ALIGN, modes.mode);
}

static void align_failed(void)
{
    modes.align.stage = APP_ALIGN_FAILED;
}

static void align_watches(void)
{
    modes.align.stage       = APP_ALIGN_WATCH;
    modes.align.timer_ticks = 0U;
}

static const row_t align_rows[] = {
    {"run", .flag = &in.command.run, .to = 0.0f},
    {"failed", .change = align_failed},
    {"watch", .change = align_watches},
    {"current", .number = &modes.align.current_max2_A2, .to = -1.0f}};

static void test_each_condition_of_the_alignment_alone_opens_the_bridge(void)
{
    go_align();
    const app_modes_t before = modes;
    turn(1);
    TEST_ASSERT_TRUE(out.gate_enable);
    for (int i = 0; i < SUPPORT_COUNT(align_rows); i++) {
        modes          = before;
        in.command.run = true;
        apply(&align_rows[i]);
        turn(1);
        TEST_ASSERT_FALSE_MESSAGE(out.gate_enable, align_rows[i].what);
    }
}

/* The end of a run: the bridge stays closed while the drive runs and either its encoder is lost or it is too fast. */
static void test_each_condition_of_a_stop_alone_opens_the_bridge(void)
{
    static const struct {
        bool running, lost, fast, on;
    } rows[] = {{true, false, true, true},
                {true, false, false, false},
                {true, true, false, true},
                {false, false, true, false}};

    for (int i = 0; i < SUPPORT_COUNT(rows); i++) {
        config.stop.reaction      = APP_STOP_RAMP;
        config.stop.still_e_radps = rows[i].fast ? 50.0f : 100.0f;
        go_ready();
        in.command.run           = true;
        in.command.omega_e_radps = 88.0f;
        step_cnt                 = 14U;
        turn(4);
        TEST_ASSERT_TRUE(out.gate_enable);
        in.command.run                   = false;
        modes.drive.answer.without_angle = rows[i].lost;
        modes.drive.state                = rows[i].running ? DRIVE_RUN : DRIVE_OFF;
        turn(1);
        TEST_ASSERT_TRUE_MESSAGE(out.gate_enable == rows[i].on, "row");
    }
    config.stop.reaction = APP_STOP_COAST; /* slower than omega_link: opens */
    go_ready();
    in.command.run           = true;
    in.command.omega_e_radps = 88.0f;
    step_cnt                 = 14U;
    turn(4);
    in.command.run = false;
    turn(1);
    TEST_ASSERT_FALSE(out.gate_enable);
}

/* A fault beyond omega_link shorts the motor: the only gates that a fault enables. */
static app_stop_t       stop;
static float            fault_e_radps;
static drive_fault_t    drive_fault;
static uint16_t         board_faults;
static app_stop_input_t now;

static void over_current_fault(void)
{
    drive_fault = DRIVE_FAULT_OVER_CURRENT;
}

static const row_t short_rows[] = {
    {"short_circuit", .flag = &config.stop.short_circuit, .to = 0.0f},
    {"speed", .number = &fault_e_radps, .to = 1000.0f},
    {"over current", .change = over_current_fault},
    {"board", .word = &board_faults, .to = (float)BOARD_FAULT_TRIP},
    {"slow now", .number = &now.omega_e_radps, .to = 900.0f},
    {"over current now", .number = &now.ib_A, .to = 50.0f},
    {"board now", .word = &now.board_faults, .to = (float)BOARD_FAULT_TRIP}};

static bool shorts(const row_t *row, bool known)
{
    const app_stop_input_t fast = {.omega_e_radps = 1206.0f, .speed_known = known, .valid = known};

    config        = board_config;
    now           = fast;
    fault_e_radps = 1206.0f;
    drive_fault   = DRIVE_FAULT_NONE;
    board_faults  = 0U;
    if (row != NULL) {
        apply(row);
    }
    TEST_ASSERT_EQUAL_INT(CTL_OK, app_stop_init(&stop, &config.stop, &drive_config));
    app_stop_fault(&stop, fault_e_radps, drive_fault, board_faults);
    return app_stop_bridge(&stop, &now).gate_enable;
}

static void test_each_condition_of_the_short_circuit_alone_opens_the_bridge(void)
{
    TEST_ASSERT_TRUE(shorts(NULL, true));
    for (int i = 0; i < SUPPORT_COUNT(short_rows); i++) {
        TEST_ASSERT_FALSE_MESSAGE(shorts(&short_rows[i], true), short_rows[i].what);
    }
    TEST_ASSERT_TRUE(shorts(&short_rows[4], false)); /* nobody knows that it is slow, */
    TEST_ASSERT_TRUE(shorts(&short_rows[5], false)); /* or the current */
}

/* FAULT ends by a reset without run, and not from a short whose speed is known: the next run needs all of it. */
static void test_each_condition_of_leaving_a_fault(void)
{
    static const struct {
        bool reset, run, shorted, valid, leaves;
    } rows[] = {{true, false, false, true, true},
                {false, false, false, true, false},
                {true, true, false, true, false},
                {true, false, true, true, false},
                {true, false, true, false, true}};

    for (int i = 0; i < SUPPORT_COUNT(rows); i++) {
        go_ready();
        in.memory_changed = true;
        turn(1);
        TEST_ASSERT_EQUAL_INT(APP_MODE_FAULT, modes.mode);
        in.memory_changed       = false;
        modes.stop.shorted      = rows[i].shorted;
        modes.stop.link_e_radps = 0.0f; /* any speed is beyond it */
        step_cnt                = 10U;
        raw.valid               = rows[i].valid;
        in.command.reset        = rows[i].reset;
        in.command.run          = rows[i].run;
        turn(1);
        TEST_ASSERT_TRUE_MESSAGE((modes.mode == APP_MODE_READY) == rows[i].leaves, "row");
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_condition_of_the_core_alone_keeps_the_gates_off);
    RUN_TEST(test_law_without_counts_runs);
    RUN_TEST(test_each_count_of_a_law_alone_is_found);
    RUN_TEST(test_each_condition_of_the_application_alone_opens_the_bridge);
    RUN_TEST(test_each_condition_of_a_start_alone_keeps_the_gates_off);
    RUN_TEST(test_what_alone_is_not_in_the_way);
    RUN_TEST(test_each_condition_of_the_alignment_alone_opens_the_bridge);
    RUN_TEST(test_each_condition_of_a_stop_alone_opens_the_bridge);
    RUN_TEST(test_each_condition_of_the_short_circuit_alone_opens_the_bridge);
    RUN_TEST(test_each_condition_of_leaving_a_fault);
    return UNITY_END();
}
