/* SPDX-License-Identifier: MIT */
/**
 * @file app_trim.h
 * @brief Offsets and unequal gains of the two current sensors, learned while the motor runs.
 *
 * The sensors measure i + e. In the rotor's frame an offset of the sensors is e = E_1
 * exp(-j theta). Unequal gains are e = E_2 exp(-2j theta). Where L_d and L_q differ, each leaves a
 * voltage that turns the other way. With psi = L_d i_d + j L_q i_q of the measured currents, over
 * whole turns of a block of the length T,
 *
 *     r_h = mean((v - R i - j w ((h + 1) psi + flux)) exp(-jh theta))
 *           - (psi exp(-jh theta))|first..last / T                                      EQ-TRIM-1
 *     conj(E_h) = -2j r_h / ((h + 1) w (L_q - L_d))                                     EQ-TRIM-2
 *     o_a = Re E_1,  o_b = (sqrt(3) Im E_1 - Re E_1) / 2                                EQ-TRIM-3
 *     g_a - g_b = sqrt(3) Re(E_2 i exp(-j pi/6)) / |i|^2,  i the mean current           EQ-TRIM-4
 *
 * A motor with unequal phases, and an inverter whose legs lose unequal voltages, make voltages that
 * turn as e does: exp(-jh theta) takes them out. A load that swings moves v, i and w by the
 * motor's equations, which r_h follows.
 *
 * Wrong inductances turn E_h, so the torque has to agree. The speed moves by the true current:
 *
 *     a_h = mean((i_q (l1 + l11 i_d) - jh w (w - w_first)) exp(-jh theta))
 *           - (w exp(-jh theta))|first..last / T,                                       EQ-TRIM-5
 *     from -j a_h to conj(E_h) at most 60 deg
 *
 * An angle error of the encoder that repeats h times in an electrical turn looks like e. Its
 * amplitude D reads as up to 2 flux D / (L_q - L_d).
 *
 * Each block of 0.25 s adds a quarter of what it shows. A value that reaches its bound is no error
 * of the sensors. Then all go back to zero, and learning ends until the zeros are measured again.
 * Context: background.
 */
#ifndef APP_TRIM_H
#define APP_TRIM_H

#include "app_options.h"
#include "base.h"
#include "frames.h"
#include "motor.h"

#define APP_TRIM_GAIN_MOST 0.05f /**< chosen: sensors of 1 %, with as much for age and heat */

/** Errors that are taken off the readings. */
typedef struct {
    float a_A;  /**< offset of phase a */
    float b_A;  /**< offset of phase b */
    float gain; /**< gain of a less the gain of b, as ratios; each sensor takes half */
} app_trim_values_t;

/** Sums of a signal over a block. */
typedef struct {
    dq_t turned; /**< of y exp(-jh theta) */
    dq_t plain;  /**< of y */
} app_trim_sum_t;

/** Sums of a block for h turns of the rotor's frame. */
typedef struct {
    app_trim_sum_t voltage; /**< y of EQ-TRIM-1 [V] */
    app_trim_sum_t torque;  /**< y of EQ-TRIM-5 [rad/s^2] */
    dq_t           unit;    /**< of exp(-jh theta) */
} app_trim_sums_t;

typedef struct {
    app_trim_values_t values;
    app_trim_sums_t   sums[2];       /**< h = 1 and 2 */
    dq_t              i_A;           /**< sum of the currents */
    float             moved_e_radps; /**< sum of the speeds, less the first */
    dq_t              first_A;       /**< current of the first sample */
    float             first_e_radps; /**< its speed */
    float             first_rad;     /**< its angle */
    float             before_rad;    /**< angle of the pass before */
    uint32_t          first_ticks;
    uint32_t          ticks;  /**< of the pass before */
    uint16_t          count;  /**< samples of the block, up to 1 s */
    uint16_t          blocks; /**< that taught, up to 65535 */
    bool              begun;  /**< a block has begun */
    bool              ended;  /**< a bound was reached */
} app_trim_t;

/** Constants of the motor and the limits, EQ-MOTOR-1. */
typedef struct {
    const motor_reduced_t *motor;
    float                  ts_s;
    float                  current_max_A;
    float                  offset_most_A; /**< bound of an offset, > 0 */
} app_trim_config_t;

/** Input of a pass of the background. */
typedef struct {
    uint32_t ticks; /**< control periods since the start */
    bool     runs;  /**< the drive runs with its encoder, and its voltage is not limited */
    float    theta_e_rad;
    float    omega_e_radps;
    float    ia_A; /**< phase currents of this sample, trimmed */
    float    ib_A;
    dq_t v_V; /**< voltage that this sample led to: it acts from the next one to the one after */
} app_trim_seen_t;

/** Believes the sensors. */
void app_trim_reset(app_trim_t *t);

/** The zeros have been measured: the offsets are gone, the gains stay, and learning may go on. */
void app_trim_zeroed(app_trim_t *t);

/** A bound was reached: all values go back to zero, and learning ends. */
void app_trim_end(app_trim_t *t);

/**
 * @brief EQ-TRIM-1 to 5.
 *
 * It learns where |w (L_q - L_d)| >= R, |L_q - L_d| >= 0.1 (L_q + L_d) and the mean current is 0.1
 * of the largest one or more. It drops a block in which the speed moves by 0.05 of itself, or a
 * current by 0.25 of the largest one. A pass that is late by 1.5 rad drops it too.
 *
 * @return true: values have changed. The next sample has to be trimmed with them.
 */
bool app_trim_see(app_trim_t *t, const app_trim_seen_t *seen, const app_trim_config_t *c);

#endif /* APP_TRIM_H */
