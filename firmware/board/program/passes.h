/* SPDX-License-Identifier: MIT */
/**
 * @file passes.h
 * @brief The parts of main(): a start, and a pass that it repeats for good.
 *
 * A simulation without a stack of its own for the firmware calls both by itself.
 */
#ifndef PASSES_H
#define PASSES_H

typedef enum {
    FIRMWARE_STAYS_OFF, /**< clock, constants or PWM have failed: the bridge stays off for good */
    FIRMWARE_LOADS,     /**< the loader serves the line; a reset ends it */
    FIRMWARE_DRIVES     /**< background of the application; the control interrupt runs */
} firmware_pass_t;

/** Starts board and application. @return what to repeat. Context: init. */
firmware_pass_t firmware_start(void);

/** One pass, as often as possible. Context: background. */
void firmware_pass(firmware_pass_t pass);

#endif /* PASSES_H */
