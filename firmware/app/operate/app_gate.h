/* SPDX-License-Identifier: MIT */
/**
 * @file app_gate.h
 * @brief What the gate drivers ask for: pulses that they pass, and the charge of their supplies.
 *
 * Isolated supplies leave all duty ratios and need no start. A bootstrap supply of an upper driver is charged through the
 * lower switch: all lower switches are on for some periods before the first pulse (a shorted motor, hence at low speed
 * only), and for a while in every period.
 */
#ifndef APP_GATE_H
#define APP_GATE_H

#include "base.h"
#include "board.h"

typedef struct {
    uint16_t precharge_ticks; /**< all lower switches on before a run; 0: isolated supplies */
    float
        precharge_speed_e_radps; /**< no start above, with a precharge; the shorted motor's current there,
                                           flux omega / R, has to be within the limit */
    uint16_t
        duty_max_cnt; /**< largest duty below full, half of full .. full; full is then not used either */
    uint16_t pulse_min_cnt; /**< shorter pulses of either switch are left out or made this long,
                                 whichever is nearer; 0 .. a quarter of full */
} app_gate_config_t;

/**
 * @param full_cnt Compare counts of duty one.
 * @return CTL_BAD_CONFIG when a constant is out of range.
 *
 * Context: init.
 */
ctl_status_t app_gate_check(const app_gate_config_t *config, uint16_t full_cnt);

/** Nearest compare values that the drivers pass, for ratios of a bridge_t, which are in [0, 1]. Context: control ISR. */
board_duty_t app_gate_duty(const app_gate_config_t *config, uint16_t full_cnt, abc_t duty);

/** Whether a run may begin at this speed. */
bool app_gate_may_start(const app_gate_config_t *config, float omega_e_radps);

#endif /* APP_GATE_H */
