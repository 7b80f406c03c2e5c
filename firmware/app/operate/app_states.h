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

/** RUN and STOP, whose ticks cost most: an image has them in RAM (app_states.c). */
bridge_t app_states_run(app_modes_t *m, const app_modes_input_t *in);

/** Every other mode: an image has them in flash (app_states_rest.c). */
bridge_t app_states_rest(app_modes_t *m, const app_modes_input_t *in);

/** A tick of the drive, which does not run unless told to. */
bridge_t app_states_drive(app_modes_t *m, const app_command_t *wanted, bool run);

/** Into a mode, with its timer and sums at zero. */
void app_states_enter(app_modes_t *m, app_mode_t mode);

/** Into FAULT: keeps the circumstances, and opens the bridge or shorts the motor. */
bridge_t app_states_trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault);

#endif /* APP_STATES_H */
