/* SPDX-License-Identifier: MIT */
#include "app_states.h"

#include <stddef.h>

static drive_sample_t drive_sample(const app_modes_t *m)
{
    const drive_sample_t s = {.ia_A            = m->sample.ia_A,
                              .ib_A            = m->sample.ib_A,
                              .dc_link_V       = m->sample.dc_link_V,
                              .theta_e_rad     = m->reading.theta_e_rad,
                              .band_rad        = m->reading.band_rad,
                              .edge_gap_s      = m->reading.edge_gap_s,
                              .omega_e_radps   = m->reading.omega_e_radps,
                              .edge_age_s      = m->reading.edge_age_s,
                              .valid           = m->sample.valid && m->reading.speed_valid,
                              .edge_of_pattern = m->reading.edge_of_pattern};
    return s;
}

bridge_t app_states_drive(app_modes_t *m, const app_command_t *asked, bool run)
{
    const drive_sample_t sample = drive_sample(m);

    const law_aim_t *aim = NULL;

    if (asked->follows != APP_FOLLOWS_SPEED) {
        aim = app_states_aim(m, asked);
    }
    const drive_command_t command = {.omega_e_radps = asked->omega_e_radps,
                                     .run           = run,
                                     .derating      = base_max(m->heat.derating, asked->derating),
                                     .aim           = aim};
    return drive_tick(&m->drive, &sample, &command);
}

static bridge_t drive_to_a_stop(app_modes_t *m, const app_modes_input_t *in)
{
    const app_command_t stop = app_states_stop_command(m, in);

    return app_states_drive(m, &stop, true);
}

/* A withdrawn run goes on until the bridge may open and the brake holds the shaft. */
static bool must_brake(const app_modes_t *m)
{
    return app_stop_is_braking(&m->stop, m->reading.omega_e_radps) ||
           app_brake_may_be_open(m->brake.state);
}

/* RUN and STOP. After loss of the encoder the drive brakes until it is too slow to run without one;
 * then it trips. A run that follows a torque trips at once where the bridge may open. */
bridge_t app_states_run(app_modes_t *m, const app_modes_input_t *in)
{
    const bool lost = m->drive.answer.without_angle;
    const bool brake =
        (m->drive.state == DRIVE_RUN) && (lost || (!in->command.run && must_brake(m)));
    bridge_t out =
        brake ? drive_to_a_stop(m, in) : app_states_drive(m, &in->command, in->command.run);

    if ((m->drive.state == DRIVE_FAULT) || (brake && app_states_gives_up(m))) {
        out = app_states_trip(m, in, APP_FAULT_DRIVE);
    } else if (brake) {
        m->mode = APP_MODE_STOP;
    } else if (in->command.run) {
        m->mode = APP_MODE_RUN;
    } else {
        app_states_enter(m, APP_MODE_READY);
    }
    return out;
}
