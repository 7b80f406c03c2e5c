/* SPDX-License-Identifier: MIT */
/**
 * @file drive_tick.h
 * @brief One control period: sensors -> observer -> reference -> law -> modulator.
 *
 *     u = -Lambda(e_iq) e - d_dq + u_ff                                        EQ-DRIVE-1, paper A (42)
 *
 * Call drive_tick() once per control period. Its duty ratios take effect one period later and hold for
 * one period; the voltage is turned to the angle in the middle of that period.       EQ-DRIVE-2
 *
 * Encoder form: the observer is corrected with this sample and predicted to the instant at which the new
 * voltage takes effect; references and law act on the prediction. Speed form: on the measurement.
 *
 * DRIVE_LAW_SERVO replaces observer, reference and law by one of servo_law.h, on the measurement; checks,
 * voltage limit and modulator stay. DRIVE_LAW_CONVENTIONAL is the speed form with observer and feedback of
 * conventional.h.
 *
 * Nothing received is trusted: an invalid, non-finite or out-of-range sample or command opens the bridge
 * in the same call and latches the first reason until drive_reset().
 */
#ifndef DRIVE_TICK_H
#define DRIVE_TICK_H

#include "base.h"
#include "current_ref.h"
#include "drive_config.h"
#include "nodo.h"
#include "servo_law.h"
#include "speed_ref.h"

/** Samples of one instant, converted to SI units. */
typedef struct {
    float ia_A;          /**< phase current, positive into the motor */
    float ib_A;          /**< phase current, positive into the motor */
    float dc_link_V;     /**< dc-link voltage */
    float theta_e_rad;   /**< electrical angle, -2 pi .. 2 pi */
    float omega_e_radps; /**< electrical speed; the encoder form reads it only when it starts */
    bool  valid;         /**< all of the above were measured in this period */
} drive_sample_t;

typedef struct {
    float omega_e_radps; /**< wanted electrical speed, within +-trip_speed_e_radps */
    bool  run;           /**< false opens the bridge */
} drive_command_t;

typedef struct {
    abc_t duty;        /**< upper switches, 0 .. 1; one half each while the bridge is open */
    bool  gate_enable; /**< false: all six switches off, now */
} drive_output_t;

typedef enum { DRIVE_OFF = 0, DRIVE_RUN, DRIVE_FAULT } drive_state_t;

/** Why the bridge was opened; the first reason is kept. */
typedef enum {
    DRIVE_FAULT_NONE = 0,
    DRIVE_FAULT_SAMPLE,       /**< sample marked invalid, or angle not a number in range */
    DRIVE_FAULT_OVER_CURRENT, /**< phase current beyond the trip level, or not a number */
    DRIVE_FAULT_DC_LINK,      /**< dc link outside its accepted range, or not a number */
    DRIVE_FAULT_OVER_SPEED,   /**< speed beyond the trip level, or not a number */
    DRIVE_FAULT_ENCODER,      /**< the angle jumped, or stands still while the motor turns fast */
    DRIVE_FAULT_COMMAND,      /**< commanded speed out of range, or not a number */
    DRIVE_FAULT_NUMERIC       /**< the law produced a voltage that is not a number */
} drive_fault_t;

typedef struct {
    const drive_config_t *config;
    drive_state_t         state;
    drive_fault_t         fault;
    nodo_t                observer;
    float                 theta_hat_rad; /**< encoder form: angle that belongs to observer */
    nodo_harmonic_t
                  harmonic; /**< DRIVE_LAW_NOC_H only: observer is then what the law needs of it */
    float         d_omega_dot; /**< d_w' as far as it is known [rad/s^3] */
    nodo_meas_t   now;         /**< what the law acts on: measured, or predicted (encoder form) */
    speed_ref_t   speed_ref;
    current_ref_t current_ref;
    servo_law_t   servo;     /**< DRIVE_LAW_SERVO only */
    dq_t          v_V;       /**< limited voltage computed last; in force from the next tick */
    bool          v_limited; /**< v_V was limited */
} drive_t;

/**
 * @brief Bind a drive to its constants and start in DRIVE_OFF.
 *
 * @param config Must outlive d.
 * @return CTL_BAD_CONFIG, with d left unusable (every tick keeps the bridge open), when a constant is
 *         outside its documented range.
 *
 * Context: init.
 */
ctl_status_t drive_init(drive_t *d, const drive_config_t *config);

/** Leaves DRIVE_FAULT for DRIVE_OFF. Context: control ISR or background with the ISR masked. */
void drive_reset(drive_t *d);

/**
 * @brief One control period.
 *
 * @param d       Drive.
 * @param sample  Measurements of this instant.
 * @param command Wanted speed and run flag.
 * @return        Duty ratios for the next period and the gate request for now.
 *
 * Context: control ISR. Bounded: no loop but the sums over the two series, or the matrix product of dobc.h.
 */
drive_output_t drive_tick(drive_t *d, const drive_sample_t *sample, const drive_command_t *command);

#endif /* DRIVE_TICK_H */
