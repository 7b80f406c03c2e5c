/* SPDX-License-Identifier: MIT */
/* When the gates are on, for the analyser (docs/assurance.md): under a law that answers anything, and leaves anything in its
 * state, on a drive in any state. What holds here holds under every law. */
#include "any_law.h"

volatile drive_t         any_drive;
volatile drive_sample_t  any_sample;
volatile drive_command_t any_command;
drive_config_t           config;
drive_t                  drive;

void prove_gate(void)
{
    config.constants           = &config; /* the law reads none */
    drive                      = any_drive;
    drive.config               = any_bool() ? &config : NULL;
    drive.config_again         = any_bool() ? &config : NULL;
    drive.law_again            = any_bool() ? &any_law : NULL;
    drive.constants_again      = any_bool() ? config.constants : NULL;
    drive.state                = any_bool() ? DRIVE_OFF : (any_bool() ? DRIVE_RUN : DRIVE_FAULT);
    drive.answer.plausible     = any_bool();
    drive.current_gate.jumped  = any_bool();
    drive.current_watch.models = any_bool();
    drive.answer.predicted     = any_bool();
    config.law                 = &any_law;
    config.overmodulation      = any_bool();
    config.positions           = any_bool();
    config.torques             = any_bool();
    drive.answer.arrived       = any_bool();
    drive.motion_watch.look    = (motion_watch_look_t)any_between(0, 3);
    drive.answer.waits         = any_bool();

    const drive_state_t before  = drive.state;
    drive_sample_t      sample  = any_sample;
    drive_command_t     command = any_command;
    sample.valid                = any_bool();
    command.run                 = any_bool();
    command.aim                 = NULL; /* of another law's inside */

    const bridge_t out = drive_tick(&drive, &sample, &command);

    if (out.gate_enable) {
        //@ check only_running: drive.state == DRIVE_RUN;
        //@ check wanted: command.run != 0;
        //@ check valid: sample.valid != 0;
        //@ check bound: drive.config == &config;
        //@ check whole: drive.config_again == &config && drive.law_again == &any_law && drive.constants_again == &config;
        //@ check no_fault_left: before != DRIVE_FAULT;
        //@ check plausible: drive.answer.plausible != 0;
    } else {
        //@ check off: drive.config == \null || drive.state != DRIVE_RUN;
        //@ check halves: out.duty.a == 0.5 && out.duty.b == 0.5 && out.duty.c == 0.5;
    }
    if (before == DRIVE_FAULT) {
        //@ check latched: drive.state == DRIVE_FAULT;
    }
}
