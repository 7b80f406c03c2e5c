/* SPDX-License-Identifier: MIT */
/* When the gates are on, for the analyser (docs/assurance.md): under a law that answers anything, and leaves anything in its
 * state, on a drive in any state. What holds here holds under every law. */
#include "drive_tick.h"

/* The analyser reads any bits from what is volatile; in what is not it starts with any value of its type. */
volatile int             any_int;
volatile law_output_t    any_answer;
volatile drive_t         any_drive;
volatile drive_sample_t  any_sample;
volatile drive_command_t any_command;
drive_config_t           config;
drive_t                  drive;

static bool any_bool(void)
{
    return any_int != 0;
}

static bool check(const drive_config_t *c)
{
    (void)c;
    return any_bool();
}

static void reset(law_state_t *state, const drive_config_t *c, const drive_sample_t *sample)
{
    (void)c;
    (void)sample;
    state->own[0] = 0.0f;
}

static void step(law_state_t *state, const drive_config_t *c, const law_input_t *in,
                 law_output_t *out)
{
    (void)state;
    (void)c;
    (void)in;
    *out               = any_answer;
    out->plausible     = any_bool();
    out->without_angle = any_bool();
}

static const law_t any_law = {.check = check, .reset = reset, .step = step};

void prove_gate(void)
{
    drive                     = any_drive;
    drive.config              = any_bool() ? &config : NULL;
    drive.state               = any_bool() ? DRIVE_OFF : (any_bool() ? DRIVE_RUN : DRIVE_FAULT);
    drive.wanted.plausible    = any_bool();
    drive.current_gate.jumped = any_bool();
    config.law                = &any_law;
    config.overmodulation     = any_bool();

    const drive_state_t before  = drive.state;
    drive_sample_t      sample  = any_sample;
    drive_command_t     command = any_command;
    sample.valid                = any_bool();
    command.run                 = any_bool();

    const bridge_t out = drive_tick(&drive, &sample, &command);

    if (out.gate_enable) {
        //@ check only_running: drive.state == DRIVE_RUN;
        //@ check wanted: command.run != 0;
        //@ check valid: sample.valid != 0;
        //@ check bound: drive.config == &config;
        //@ check no_fault_left: before != DRIVE_FAULT;
        //@ check plausible: drive.wanted.plausible != 0;
    } else {
        //@ check off: drive.config == \null || drive.state != DRIVE_RUN;
        //@ check halves: out.duty.a == 0.5 && out.duty.b == 0.5 && out.duty.c == 0.5;
    }
    if (before == DRIVE_FAULT) {
        //@ check latched: drive.state == DRIVE_FAULT;
    }
}
