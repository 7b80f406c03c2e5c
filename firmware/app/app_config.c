/* SPDX-License-Identifier: MIT */
#include "app_config.h"

void app_config_for(app_config_t *out, const app_config_t *config, uint16_t updates_per_period)
{
    uint16_t *const times[]      = {&out->boot_ticks,           &out->calibrate_ticks,
                                    &out->background_ticks,     &out->modbus_gap_ticks,
                                    &out->modbus_timeout_ticks, &out->gate.precharge_ticks};
    uint32_t *const long_times[] = {&out->align.watch_ticks, &out->align.ramp_ticks,
                                    &out->align.sweep_ticks, &out->align.settle_ticks,
                                    &out->align.still_ticks};

    *out = *config;
    for (uint16_t i = 0U; i < (uint16_t)(sizeof times / sizeof times[0]); i++) {
        const uint32_t ticks = (uint32_t)*times[i] * (uint32_t)updates_per_period;
        *times[i]            = (ticks < 65535UL) ? (uint16_t)ticks : 65535U;
    }
    for (uint16_t i = 0U; i < (uint16_t)(sizeof long_times / sizeof long_times[0]); i++) {
        *long_times[i] *= (uint32_t)updates_per_period;
    }
}
