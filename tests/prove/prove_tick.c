/* SPDX-License-Identifier: MIT */
/* One period of the core, for the analyser (docs/assurance.md): every number of samples, commands, constants and state is
 * any 32 bits, NaN and infinities included; whole numbers and booleans are what the types and drive_init() let them be. */
#include <stddef.h>

#include "any.h"
#include "drive_tick.h"

#define JOINED(a, b) a##b
#define NAMED(a, b)  JOINED(a, b)

/* Of the law that is analysed: PROVE_LAW is noc, noc_h .. */
typedef NAMED(NAMED(law_, PROVE_LAW), _config_t) constants_t;
typedef NAMED(NAMED(law_, PROVE_LAW), _state_t) state_t;

volatile float              any_float;
volatile constants_t        any_constants;
volatile state_t            any_state;
volatile drive_t            any_drive_bits;
volatile drive_sample_t     any_sample;
volatile drive_command_t    any_command;
volatile position_command_t any_position;
volatile torque_command_t   any_torque;
drive_config_t              config;
constants_t                 constants;
drive_t                     drive;

/* What position.h keeps turns in. */
static int32_t any_turns(void)
{
    return any_long_between(-POSITION_TURNS_MAX, POSITION_TURNS_MAX);
}

/* Constants. */

static void any_near_optimal(near_optimal_config_t *c)
{
    c->current_ref.mtpa_exact = any_between(0, 1);
    c->nosc.order             = any_between(0, NOSC_ORDER_MAX);
    c->position.nosc.order    = any_between(0, NOSC_ORDER_MAX);
}

static void any_config(void)
{
#if defined PROVE_noc || defined PROVE_noc_iron
    any_near_optimal(&constants.near_optimal);
    constants.nodo.order = any_between(0, NODO_ORDER_MAX);
#elif defined PROVE_noc_speed
    any_near_optimal(&constants.near_optimal);
    constants.nodo.order = any_between(0, NODO_ORDER_MAX);
#elif defined PROVE_noc_h
    any_near_optimal(&constants.near_optimal);
    constants.nodo.n_pairs = any_between(0, NODO_HARMONIC_PAIRS_MAX);
    constants.nodo.n_nodes = any_between(2, NODO_HARMONIC_NODES_MAX);
    for (int i = 0; i < NODO_HARMONIC_PAIRS_MAX; i++) {
        constants.nodo.pair[i].channel = any_between(NODO_HARMONIC_SENSOR, NODO_HARMONIC_VOLTAGE_D);
        constants.nodo.pair[i].order   = base_clamp(any_float, -1.0e3f, 1.0e3f); /* as checked */
    }
#elif defined PROVE_noc_shaft
    any_near_optimal(&constants.near_optimal);
    constants.nodo.motor.order = 1;
#elif defined PROVE_conventional
    any_near_optimal(&constants.near_optimal);
    constants.gains.nosc_order = any_between(0, DOUBLE_SERIES_ORDER_MAX);
    constants.gains.nodo_order = any_between(0, DOUBLE_SERIES_ORDER_MAX);
#elif defined PROVE_dobc
    constants.dobc.n_x = any_between(1, DOBC_N_X_MAX);
#elif defined PROVE_pi_foc || defined PROVE_ladrc
    constants.speed.periods = any_between(1, SPEED_DIFFERENCE_PERIODS_MAX);
#elif !defined                        PROVE_pid
#error "which law?"
#endif
    config.overmodulation = any_between(0, 1);
    config.positions      = any_between(0, 1);
    config.torques        = any_between(0, 1);
    config.law            = &NAMED(law_, PROVE_LAW);
    config.constants      = &constants;
}

/* State: what is said of its whole numbers is given before the tick and shown after it. */

static void any_drive(void)
{
    state_t state = any_state;

    drive = any_drive_bits;
#if defined PROVE_noc || defined PROVE_noc_speed || defined PROVE_noc_h ||                         \
    defined PROVE_noc_shaft || defined PROVE_noc_iron || defined PROVE_conventional
    state.near_optimal.follows               = (near_optimal_follows_t)any_between(0, 2);
    state.near_optimal.position_ref.arrived  = any_between(0, 1);
    state.near_optimal.position_ref.waits    = any_between(0, 1);
    state.near_optimal.position_ref.at.turns = any_turns();
#endif
#if defined PROVE_noc || defined PROVE_noc_h || defined PROVE_noc_shaft || defined PROVE_noc_iron
    state.gate.beyond   = any_between(0, ANGLE_GATE_HOLD);
    state.gate.standing = any_between(0, ANGLE_GATE_HOLD);
    state.gate.lost     = any_between(0, 1);
#elif defined PROVE_pi_foc || defined PROVE_ladrc
    state.speed.oldest   = any_between(0, constants.speed.periods - 1);
#endif
#if defined PROVE_pid
    state.pid.running   = any_between(0, 1);
    state.id_pi.running = any_between(0, 1);
#elif defined PROVE_dobc
    state.dobc.running   = any_between(0, 1);
    state.id_pi.running  = any_between(0, 1);
#endif
    drive.law.PROVE_LAW        = state;
    drive.config               = &config;
    drive.config_again         = &config;
    drive.law_again            = config.law;
    drive.constants_again      = config.constants;
    drive.state                = any_between(DRIVE_OFF, DRIVE_FAULT);
    drive.fault                = any_between(DRIVE_FAULT_NONE, DRIVE_FAULT_MEMORY);
    drive.answer.plausible     = any_between(0, 1);
    drive.answer.without_angle = any_between(0, 1);
    drive.v_limited            = any_between(0, 1);
    drive.answer.predicted     = any_between(0, 1);
    drive.answer.arrived       = any_between(0, 1);
    drive.answer.waits         = any_between(0, 1);
    drive.current_gate.jumped  = any_between(0, 1);
    drive.current_watch.models = any_between(0, 1);
    drive.motion_watch.look    = (motion_watch_look_t)any_between(0, 3);
}

static void state_is_kept(void)
{
    //@ check state: DRIVE_OFF <= drive.state <= DRIVE_FAULT;
    //@ check fault: DRIVE_FAULT_NONE <= drive.fault <= DRIVE_FAULT_MEMORY;
#if defined PROVE_noc || defined PROVE_noc_h || defined PROVE_noc_shaft || defined PROVE_noc_iron
    //@ check beyond: 0 <= drive.law.PROVE_LAW.gate.beyond <= ANGLE_GATE_HOLD;
    //@ check standing: 0 <= drive.law.PROVE_LAW.gate.standing <= ANGLE_GATE_HOLD;
    //@ check lost: 0 <= drive.law.PROVE_LAW.gate.lost <= 1;
#elif defined PROVE_pi_foc || defined PROVE_ladrc
    //@ check oldest: 0 <= drive.law.PROVE_LAW.speed.oldest < SPEED_DIFFERENCE_PERIODS_MAX;
#endif
}

static void is_ratio(float duty)
{
    //@ check ratio: 0.0 <= duty <= 1.0;
}

/* Entry: a tick of a drive in any state. */
void prove_tick(void)
{
    any_config();
    any_drive();
    drive_sample_t  sample  = any_sample;
    drive_command_t command = any_command;
    sample.valid            = any_between(0, 1);
    command.run             = any_between(0, 1);

    position_command_t position =
        any_position; /* drive_tick() refuses other turns: unit.position_run */
    position.actual.turns    = any_turns();
    position.target.turns    = any_turns();
    position.moves           = any_between(0, 1);
    position.motion.at.turns = any_turns();
    torque_command_t torque  = any_torque;
    law_aim_t        aim;
    aim.position = any_between(0, 1) ? &position : NULL;
    aim.torque   = any_between(0, 1) ? &torque : NULL;
    command.aim  = any_between(0, 1) ? &aim : NULL;

    bridge_t out;
#if defined PROVE_dobc
    //@ split constants.dobc.n_x;
#endif
    out = drive_tick(&drive, &sample, &command);

    is_ratio(out.duty.a);
    is_ratio(out.duty.b);
    is_ratio(out.duty.c);
    state_is_kept();
}

static void any_bits(void)
{
    constants = any_constants;
#if defined PROVE_noc || defined PROVE_noc_speed || defined PROVE_noc_h ||                         \
    defined PROVE_noc_shaft || defined PROVE_noc_iron || defined PROVE_conventional
    constants.near_optimal.current_ref.mtpa_exact = any_between(0, 1);
#endif
    config.law       = &NAMED(law_, PROVE_LAW);
    config.constants = &constants;
    config.positions = any_between(0, 1);
    config.torques   = any_between(0, 1);
}

/* Entry: constants that are any bits. */
void prove_init(void)
{
    any_bits();
    if (any_int != 0) {
        config.constants = NULL;
    }
    if (drive_init(&drive, &config) == CTL_OK) {
        //@ check bound: drive.config == &config;
    } else {
        //@ check unbound: drive.config == \null;
    }
    //@ check off: drive.state == DRIVE_OFF;
}

/* One whole constant out of the range that prove_tick() takes it for. */
#define REFUSED(constant, lo, hi)                                                                  \
    any_bits();                                                                                    \
    (constant) = any_between(INT16_MIN, (lo)-1);                                                   \
    refused();                                                                                     \
    (constant) = any_between((hi) + 1, INT16_MAX);                                                 \
    refused()

static void refused(void)
{
    const ctl_status_t status = drive_init(&drive, &config);
    //@ check refused: status == CTL_BAD_CONFIG;
}

/* Entry: drive_init() lets no other whole constants pass, whatever the others are. */
void prove_refused(void)
{
#if defined PROVE_noc || defined PROVE_noc_speed
    REFUSED(constants.near_optimal.nosc.order, 0, NOSC_ORDER_MAX);
    REFUSED(constants.nodo.order, 0, NODO_ORDER_MAX);
#elif defined PROVE_noc_h
    REFUSED(constants.near_optimal.nosc.order, 0, NOSC_ORDER_MAX);
    REFUSED(constants.nodo.n_pairs, 0, NODO_HARMONIC_PAIRS_MAX);
    REFUSED(constants.nodo.n_nodes, 2, NODO_HARMONIC_NODES_MAX);
#elif defined PROVE_noc_shaft
    REFUSED(constants.near_optimal.nosc.order, 0, NOSC_ORDER_MAX);
    REFUSED(constants.nodo.motor.order, 1, 1);
#elif defined PROVE_conventional
    REFUSED(constants.gains.nosc_order, 0, DOUBLE_SERIES_ORDER_MAX);
    REFUSED(constants.gains.nodo_order, 0, DOUBLE_SERIES_ORDER_MAX);
#elif defined PROVE_dobc
    REFUSED(constants.dobc.n_x, 1, DOBC_N_X_MAX);
#elif defined PROVE_pi_foc || defined PROVE_ladrc
    REFUSED(constants.speed.periods, 1, SPEED_DIFFERENCE_PERIODS_MAX);
#endif
}
