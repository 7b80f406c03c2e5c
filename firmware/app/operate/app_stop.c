/* SPDX-License-Identifier: MIT */
#include "app_stop.h"

#include "check.h"

/* Chosen: the short ends when the EMF is well below the dc link's upper limit. */
#define OPEN_BELOW 0.8f

#define FLUX_MOST_Wb  1.0e3f
#define FLUX_LEAST_Wb 1.0e-9f /* without magnets there is no EMF: omega_link exceeds every speed */

static float flux_of(const drive_config_t *drive)
{
    return drive->motor.l5 * drive->motor.inv_l6;
}

ctl_status_t app_stop_check(const app_stop_config_t *c, const drive_config_t *drive)
{
    const bool ok = check_positive(c->still_e_radps) &&
                    base_in_range(flux_of(drive), 0.0f, FLUX_MOST_Wb) &&
                    ((c->reaction == APP_STOP_COAST) || (c->reaction == APP_STOP_RAMP));

    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

ctl_status_t app_stop_init(app_stop_t *s, const app_stop_config_t *c, const drive_config_t *drive)
{
    const ctl_status_t status  = app_stop_check(c, drive);
    const float        flux_Wb = base_max(flux_of(drive), FLUX_LEAST_Wb);

    s->config         = c;
    s->link_e_radps   = (status == CTL_OK) ? (drive->dc_link_max_V * BASE_1_SQRT3 / flux_Wb) : 0.0f;
    s->trip_current_A = drive->trip_current_A;
    s->shorted        = false;
    return status;
}

bool app_stop_is_braking(const app_stop_t *s, float omega_e_radps)
{
    const float until_radps =
        (s->config->reaction == APP_STOP_RAMP) ? s->config->still_e_radps : s->link_e_radps;

    return !base_within(omega_e_radps, until_radps);
}

void app_stop_fault(app_stop_t *s, float omega_e_radps, drive_fault_t drive_fault,
                    uint16_t board_faults)
{
    s->shorted = s->config->short_circuit && !base_within(omega_e_radps, s->link_e_radps) &&
                 (drive_fault != DRIVE_FAULT_OVER_CURRENT) &&
                 (board_faults == (uint16_t)BOARD_FAULT_NONE);
}

bridge_t app_stop_bridge(app_stop_t *s, const app_stop_input_t *in)
{
    const bool slow =
        in->speed_known && base_within(in->omega_e_radps, OPEN_BELOW * s->link_e_radps);
    const bool over_current =
        in->valid && sample_over_current(in->ia_A, in->ib_A, s->trip_current_A);

    s->shorted =
        s->shorted && !slow && !over_current && (in->board_faults == (uint16_t)BOARD_FAULT_NONE);
    return s->shorted ? bridge_shorted() : bridge_open();
}
