/* SPDX-License-Identifier: MIT */
/**
 * @file app_gate.h
 * @brief Requirements of the gate drivers: shortest pulse, and charge of bootstrap supplies.
 *
 * Isolated supplies allow all duty ratios and need no precharge. A bootstrap supply of an upper
 * driver charges through the lower switch. Therefore all lower switches are on for some periods
 * before the first pulse, and for a part of every period. The precharge shorts the motor: it is
 * allowed at low speed only.
 */
#ifndef APP_GATE_H
#define APP_GATE_H

#include "app_part.h"
#include "base.h"
#include "board.h"

typedef struct {
    uint16_t precharge_ticks; /**< all lower switches on before a run; 0: isolated supplies */
    float
        precharge_speed_e_radps; /**< no start above it with a precharge; the short-circuit current,
                                           flux omega / R, must be within the limit */
    uint16_t
        duty_max_cnt; /**< largest duty, half of full .. full; below full, duty one is not used */
    uint16_t pulse_min_cnt; /**< shorter pulses of either switch become 0 or this long,
                                 whichever is nearer; 0 .. a quarter of full */
} app_gate_config_t;

/**
 * @param full_cnt Compare counts of duty one.
 * @return CTL_BAD_CONFIG when a constant is out of range.
 *
 * Context: init.
 */
ctl_status_t app_gate_check(const app_gate_config_t *config, uint16_t full_cnt);

/** Nearest allowed compare values for duty ratios in [0, 1]. Context: control ISR. */
APP_PART board_duty_t app_gate_duty(const app_gate_config_t *config, uint16_t full_cnt, abc_t duty);

/** True if a run may start at this speed. */
bool app_gate_may_start(const app_gate_config_t *config, float omega_e_radps);

#endif /* APP_GATE_H */
