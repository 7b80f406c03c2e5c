/* SPDX-License-Identifier: MIT */
/**
 * @file app_states.h
 * @brief Actions and transitions of each mode of app_modes.h. Context: control ISR.
 */
#ifndef APP_STATES_H
#define APP_STATES_H

#include "app_modes.h"

/** Executes a tick of RUN or STOP, the most expensive ones: app_states.c runs from RAM. The caller
 * has found no fault. */
bridge_t app_states_run(app_modes_t *m, const app_modes_input_t *in);

/** Executes a tick of any other mode: app_states_rest.c runs from flash. */
bridge_t app_states_rest(app_modes_t *m, const app_modes_input_t *in);

/** Executes a tick of the drive. @param run false: the drive stays off. */
bridge_t app_states_drive(app_modes_t *m, const app_command_t *asked, bool run);

/** Returns the command that brakes: to standstill, or until the drive trips without encoder. */
app_command_t app_states_stop_command(const app_modes_t *m, const app_modes_input_t *in);

/**
 * @brief Returns what the drive follows in place of a speed: a position or a torque.
 *
 * A torque goes to its goal by `torque_step` in a period. A run that becomes one of torque begins
 * with the torque that it has. It runs from flash.
 */
const law_aim_t *app_states_aim(app_modes_t *m, const app_command_t *asked);

/** True if a run trips because of a lost encoder: it followed a torque, and the bridge may open.
 * A torque needs the angle, and a speed is not what was asked for. It runs from flash. */
bool app_states_gives_up(const app_modes_t *m);

/** Executes a tick of the alignment's vector. */
bridge_t app_states_align_vector(app_modes_t *m, const app_modes_input_t *in);

/** Executes a tick of an alignment that is done, while the brake may still be open. The vector
 * holds the shaft. Where the index was found the vector would turn it: there the shorted motor
 * damps it. */
bridge_t app_states_hold_aligned(app_modes_t *m, const app_modes_input_t *in);

/** Enters a mode and clears its timer and sums. */
void app_states_enter(app_modes_t *m, app_mode_t mode);

/** Executes a tick of FAULT: the bridge is open, or shorts the motor (app_stop.h). */
bridge_t app_states_fault(app_modes_t *m, const app_modes_input_t *in);

/** True if the encoder tells the speed: it was not lost in the last run. */
bool app_states_know_speed(const app_modes_t *m);

/** First fault of this tick. It runs from flash. */
app_fault_t app_fault_of(const app_modes_t *m, const app_modes_input_t *in);

/** Enters FAULT: stores a snapshot, and opens the bridge or shorts the motor. */
bridge_t app_states_trip(app_modes_t *m, const app_modes_input_t *in, app_fault_t fault);

/** EQ-APP-SUM-1; false in firmware for two current sensors. Context: control ISR. */
static inline bool app_modes_sum_differs(const app_modes_t *m)
{
#if BOARD_CURRENT_SENSORS == 3
    return m->sum_differs;
#else
    (void)m;
    return false;
#endif
}

#endif /* APP_STATES_H */
