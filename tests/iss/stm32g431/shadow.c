/* SPDX-License-Identifier: MIT */
#include "shadow.h"

#include "app.c"
#include "board_config.h"
#include "fake_board.h"
#include "gain_tables.h"

static app_image_t in_force;

bool shadow_start(void)
{
    fake_board_reset();
    fake_board_erase_store();
    fake_board.inputs = BOARD_INPUT_HOME; /* open, as in the image's circuit */
    return app_image_choose(&in_force, &board_config, &gain_tables_drive, &board_identity) &&
           (app_init(&in_force.image.app, &in_force.image.drive) == CTL_OK);
}

shadow_output_t shadow_tick(const shadow_input_t *in)
{
    const app_modes_t *const m = &tick_side.modes;

    if (in->has_command) {
        shared.command      = in->command;
        shared.command_full = true;
    }
    shared.background_count = (uint16_t)(shared.background_count + 1U);
    fake_board.sample       = in->sample;
    fake_board.faults       = in->board_faults;
    fake_board.event_count  = 0;
    app_tick();
    const shadow_output_t out = {.duty        = fake_board.duty,
                                 .mode        = m->mode,
                                 .fault       = m->fault,
                                 .state       = m->drive.state,
                                 .drive_fault = m->drive.fault,
                                 .v_V         = m->drive.v_V,
                                 .i_ref_A     = m->drive.answer.i_ref_A,
                                 .d_omega     = m->drive.answer.d_omega,
                                 .d_q         = m->drive.answer.d_q,
                                 .d_d         = m->drive.answer.d_d,
                                 .gate_on     = m->gate_on};
    return out;
}
