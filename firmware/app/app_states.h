/* SPDX-License-Identifier: MIT */
/**
 * @file app_states.h
 * @brief What each mode of app_modes.h does in a tick, and where it goes from there. Context: control ISR.
 */
#ifndef APP_STATES_H
#define APP_STATES_H

#include "app_modes.h"

/** The tick of the present mode, in which nothing is wrong. */
bridge_t app_states_act(app_modes_t *m, const app_modes_input_t *in);

/** Into FAULT: keeps the circumstances, and opens the bridge or shorts the motor. */
bridge_t app_states_trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault);

#endif /* APP_STATES_H */
