/* SPDX-License-Identifier: MIT */
/**
 * @file servo_law.h
 * @brief Paper B's speed laws side by side: speed to q voltage directly, a PI that keeps id at zero.
 *
 * Acts on the measurement and on the command itself: the papers' laws have neither a prediction nor a
 * reference model, and no current limit. The measured speed must be time-stamped at the encoder's edges: one
 * count per 100 us period is 63 rad/s electrical with 10,000 counts and 4 pole pairs.
 */
#ifndef SERVO_LAW_H
#define SERVO_LAW_H

#include "base.h"
#include "dobc.h"
#include "nodo.h"
#include "pid_law.h"

/** Which law makes the q voltage. */
typedef enum {
    SERVO_LAW_DOBC = 0, /**< CDOBC, GPIOBC, HDOBC: the observer's table tells them apart */
    SERVO_LAW_PID       /**< PID of the electrical speed error */
} servo_law_kind_t;

typedef struct {
    servo_law_kind_t kind; /**< which of dobc and pid is used and checked */
    dobc_config_t    dobc;
    pid_law_config_t pid;
    pid_law_config_t id_pi; /**< error in amperes, kd_tick = 0 */
} servo_law_config_t;

typedef struct {
    dobc_t    dobc;
    pid_law_t pid;
    pid_law_t id_pi;
    float     direct_V; /**< u_qd of the last update */
} servo_law_t;

/**
 * @brief Start of a run.
 *
 * @param hold_q_V The back-EMF now; the PID's integral starts there, so that a turning motor is caught.
 *
 * Context: control ISR.
 */
void servo_law_reset(servo_law_t *s, float hold_q_V);

/**
 * @brief Voltage for this sample, before any limit.
 *
 * @param s               State, updated in place.
 * @param c               Checked by drive_init().
 * @param y               Measurement of this instant.
 * @param command_e_radps Wanted electrical speed.
 *
 * Context: control ISR. No division; the cost of one dobc_update() or pid_law_update() and one PI.
 */
dq_t servo_law_voltage_V(servo_law_t *s, const servo_law_config_t *c, const nodo_meas_t *y,
                         float command_e_radps);

/** The voltage that the limits left. Call once after servo_law_voltage_V(). Context: control ISR. */
void servo_law_realise(servo_law_t *s, const servo_law_config_t *c, dq_t v_V);

#endif /* SERVO_LAW_H */
