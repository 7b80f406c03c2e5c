/* SPDX-License-Identifier: MIT */
/**
 * @file drive_config.h
 * @brief The constants of one drive, made by sdre-gains from its drive file.
 */
#ifndef DRIVE_CONFIG_H
#define DRIVE_CONFIG_H

#include "base.h"
#include "conventional.h"
#include "current_ref.h"
#include "dead_time.h"
#include "motor.h"
#include "nodo.h"
#include "nodo_encoder.h"
#include "nodo_harmonic.h"
#include "nosc.h"
#include "servo_law.h"

/** What turns samples into a voltage. */
typedef enum {
    DRIVE_LAW_NOC = 0,     /**< paper A: observer, references, state feedback */
    DRIVE_LAW_NOC_H,       /**< the same in the encoder form with nodo_harmonic.h as its observer */
    DRIVE_LAW_SERVO,       /**< paper B: one of the laws of servo_law.h */
    DRIVE_LAW_CONVENTIONAL /**< what paper A compares with: conventional.h in place of nosc and nodo */
} drive_law_t;

/**
 * @brief Whether this build contains a law.
 *
 * The build of an image defines DRIVE_ONLY_LAW as the law of its tables: every branch of another law is then
 * constant false and the compiler leaves out what only it calls. Without it all laws are there.
 */
#ifdef DRIVE_ONLY_LAW
#define DRIVE_HAS_LAW(wanted) ((wanted) == DRIVE_ONLY_LAW)
#else
#define DRIVE_HAS_LAW(wanted) true
#endif

/** What the observer measures beside the currents. */
typedef enum {
    DRIVE_FORM_SPEED = 0, /**< a speed signal: paper A's six states, law on the measurement */
    DRIVE_FORM_ENCODER    /**< the angle: seven states, law on the prediction */
} drive_form_t;

/** Everything that depends on the motor and the board: generated, constant, checked by drive_init(). */
typedef struct {
    float ts_s;               /**< control period [s], 1e-5 .. 1e-2 */
    float trip_current_A;     /**< a phase current beyond this is a fault */
    float trip_speed_e_radps; /**< a speed beyond this is a fault, > 0 */
    float trip_angle_rad;     /**< an angle this far from its estimate is a fault, (0, pi] */
    float
        trip_d_omega; /**< encoder form: an estimated speed disturbance beyond this is no load but a
                             wrong angle [rad/s^2], > 0 */
    float           dc_link_min_V;  /**< accepted dc link, > 0 */
    float           dc_link_max_V;  /**< > dc_link_min_V */
    bool            overmodulation; /**< voltages may use the hexagon outside the circle */
    drive_law_t     law; /**< NOC: current_ref, nosc, form; SERVO: servo; CONVENTIONAL: current_ref,
                                 conventional and nosc with Lambda_00 alone, for EQ-NOSC-3. Only these are checked */
    drive_form_t    form; /**< which of nodo and nodo_encoder is used and checked */
    motor_reduced_t motor;
    current_ref_config_t current_ref;
    dead_time_config_t   dead_time;
    nosc_gains_t         nosc;
    nodo_gains_t         nodo;
    nodo_encoder_gains_t nodo_encoder;
    servo_law_config_t   servo;
    const nodo_harmonic_gains_t
                        *nodo_harmonic; /**< DRIVE_LAW_NOC_H, which needs DRIVE_FORM_ENCODER */
    conventional_gains_t conventional;
} drive_config_t;

/** Whether these constants are those of a law, and this build contains it. */
static inline bool drive_config_is(const drive_config_t *config, drive_law_t law)
{
    return DRIVE_HAS_LAW(law) && (config->law == law);
}

/**
 * @brief CTL_OK when this build contains the law and every constant is finite and within its documented range.
 *
 * Context: init.
 */
ctl_status_t drive_config_check(const drive_config_t *config);

#endif /* DRIVE_CONFIG_H */
