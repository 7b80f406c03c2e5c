/* SPDX-License-Identifier: MIT */
/**
 * @file host_stub.h
 * @brief The other side of this board: time, and what the motor really does.
 */
#ifndef HOST_STUB_H
#define HOST_STUB_H

#include <stdbool.h>

/** A control period: the motor moves with the duty ratios in force, then the tick comes. After board_start(). */
void host_stub_period(void);

/** Electrical speed of the motor [rad/s]. */
float host_stub_speed_e_radps(void);

/** Whether the switches follow the duty ratios. */
bool host_stub_gate(void);

#endif /* HOST_STUB_H */
