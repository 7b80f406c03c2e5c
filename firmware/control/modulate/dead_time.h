/* SPDX-License-Identifier: MIT */
/**
 * @file dead_time.h
 * @brief Dead-time compensation on the duty ratios.
 *
 * During the dead time the current, not the switch, sets a phase's voltage. The phase loses the
 * share Td / T_pwm of the dc link with positive current, and gains it with negative current.
 *
 *     duty_x += share clamp(i_x / i_fade, -1, 1)                               EQ-DEAD-TIME-1
 *
 * Around zero current the sign is unknown and the loss is smaller, hence the fade.
 */
#ifndef DEAD_TIME_H
#define DEAD_TIME_H

#include "base.h"

typedef struct {
    float share;        /**< Td / T_pwm, 0 .. 0.1; 0 switches the compensation off */
    float inv_fade_1pA; /**< 1 / i_fade [1/A], > 0 */
} dead_time_config_t;

/** true when every constant is finite and within its documented range. Context: init. */
bool dead_time_check(const dead_time_config_t *c);

/* Inline, because a call costs more than the arithmetic. In C and C++: members are set in their
 * order. */

/** EQ-DEAD-TIME-1 of one phase. */
static inline float dead_time_duty(const dead_time_config_t *c, float duty, float i_A)
{
    const float direction = base_clamp(i_A * c->inv_fade_1pA, -1.0f, 1.0f);
    return duty + (c->share * direction);
}

/** Duty ratios with EQ-DEAD-TIME-1 added; bridge_closed() limits them. Context: control ISR. No
 * division. */
static inline abc_t dead_time_compensate(const dead_time_config_t *c, abc_t duty, abc_t i_A)
{
    const abc_t out = {dead_time_duty(c, duty.a, i_A.a), dead_time_duty(c, duty.b, i_A.b),
                       dead_time_duty(c, duty.c, i_A.c)};
    return out;
}

#endif /* DEAD_TIME_H */
