/* SPDX-License-Identifier: MIT */
/**
 * @file bridge.h
 * @brief Duty ratios and gate request of the inverter for one period.
 */
#ifndef BRIDGE_H
#define BRIDGE_H

#include "base.h"

/* Inline functions in C and C++: members are set in their order. */

typedef struct {
    abc_t duty;        /**< upper switches, 0 .. 1; 1/2 each while the bridge is open */
    bool  gate_enable; /**< false: all six switches off, now */
} bridge_t;

/** All six switches off. */
static inline bridge_t bridge_open(void)
{
    const bridge_t open = {{0.5f, 0.5f, 0.5f}, false};
    return open;
}

/** Switching with these ratios, limited to [0, 1]; a NaN becomes 0. All ratios are limited here. */
static inline bridge_t bridge_closed(abc_t duty)
{
    const bridge_t closed = {{base_clamp(duty.a, 0.0f, 1.0f), base_clamp(duty.b, 0.0f, 1.0f),
                              base_clamp(duty.c, 0.0f, 1.0f)},
                             true};
    return closed;
}

/** All lower switches on: the motor is shorted. Context: control ISR. */
static inline bridge_t bridge_shorted(void)
{
    const abc_t lower_on = {0.0f, 0.0f, 0.0f};
    return bridge_closed(lower_on);
}

#endif /* BRIDGE_H */
