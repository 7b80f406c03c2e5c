/* SPDX-License-Identifier: MIT */
/**
 * @file host_stub.h
 * @brief Test side of this board: advances time and shows the true motor state.
 */
#ifndef HOST_STUB_H
#define HOST_STUB_H

#include <stdbool.h>

/** Simulates one control period with the present duty ratios, then calls the tick. */
void host_stub_period(void);

/** Electrical speed of the motor [rad/s]. */
float host_stub_speed_e_radps(void);

/** True if the switches follow the duty ratios. */
bool host_stub_gate(void);

#endif /* HOST_STUB_H */
