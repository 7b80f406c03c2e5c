/* SPDX-License-Identifier: MIT */
/**
 * @file drive_fault.h
 * @brief Names the fault of a sample or a command. Internal to drive_tick.c.
 *
 * It is apart, because drive_tick() sees in two comparisons that nothing is, and an image keeps the
 * rest outside the fast memory.
 */
#ifndef DRIVE_FAULT_H
#define DRIVE_FAULT_H

#include <stddef.h>

#include "drive_tick.h"

/** Exceeds every standstill; finite, so that divisions by it are defined. */
#define DRIVE_FAULT_TIMES_MAX_s 1.0e9f

/** True if the drive takes what the run follows and each number of it is in range. Context: control
 * ISR. */
bool drive_fault_aim_ok(const drive_config_t *c, const law_aim_t *aim);

/** True for a speed in range, or for a position or a torque if the drive accepts them. Inline,
 * because a call costs more than the comparison of a speed run. Context: control ISR. */
static inline bool drive_fault_command_ok(const drive_config_t *c, const drive_command_t *command)
{
    return (command->aim == NULL) ? base_within(command->omega_e_radps, c->speed_max_e_radps)
                                  : drive_fault_aim_ok(c, command->aim);
}

/** The first fault of a sample or a command, or none. Context: control ISR. */
drive_fault_t drive_fault_of(const drive_t *d, const drive_sample_t *s,
                             const drive_command_t *command, current_gate_verdict_t currents);

#endif /* DRIVE_FAULT_H */
