/* SPDX-License-Identifier: MIT */
#include "double_core.h"

#include "drive_tick.h"

extern const drive_config_t double_shipped_drive;
extern const drive_config_t double_speed_drive;
extern const drive_config_t double_conventional_drive;
extern const drive_config_t double_harmonic_drive;

static drive_t drive;

int double_core_start(int tables)
{
    static const drive_config_t *const all[] = {&double_shipped_drive, &double_speed_drive,
                                                &double_conventional_drive, &double_harmonic_drive};

    return (sizeof drive.v_V.d == sizeof(double)) && (drive_init(&drive, all[tables]) == CTL_OK);
}

double_out_t double_core_tick(const double_in_t *in)
{
    const drive_sample_t  sample  = {.ia_A            = in->ia_A,
                                     .ib_A            = in->ib_A,
                                     .dc_link_V       = in->dc_link_V,
                                     .theta_e_rad     = in->theta_e_rad,
                                     .omega_e_radps   = in->omega_e_radps,
                                     .band_rad        = in->band_rad,
                                     .edge_gap_s      = in->edge_gap_s,
                                     .edge_age_s      = in->edge_age_s,
                                     .edge_of_pattern = (int16_t)in->edge_of_pattern,
                                     .valid           = in->valid != 0};
    const drive_command_t command = {.omega_e_radps = in->command_e_radps, .run = true};
    const bridge_t        out     = drive_tick(&drive, &sample, &command);
    const double_out_t    plain   = {.duty = {out.duty.a, out.duty.b, out.duty.c},
                                     .gate = out.gate_enable ? 1 : 0};
    return plain;
}
