/* SPDX-License-Identifier: MIT */
/**
 * @file nodo_shaft.h
 * @brief The encoder-form observer of a motor whose load is behind an elastic shaft.
 *
 *     x^ = [d_w d_q d_d | w iq id | theta | w_load twist]^,   y = [iq id theta] measured
 *     correction:  x^+ = x^- + (K_0 + K_1 iq^-) (y - C x^-)                        EQ-SHAFT-1
 *     prediction:  m = [w w_load twist]^,  a = iq_m (l1 + l11 id_m)
 *                  (m, theta)^-(k+1) = Phi m^+ + Gamma a + Gamma_d d_w^ + (0, theta^+)  EQ-SHAFT-2
 *
 * Phi and Gamma are exact over a period for a constant torque. At 5 kHz a midpoint step of a spring
 * of 400 Hz adds energy. iq_m and id_m are the currents in the middle of the period. The currents
 * follow EQ-NODO-ENCODER-2. d_w is the load torque of both masses together, acting on the load.
 */
#ifndef NODO_SHAFT_H
#define NODO_SHAFT_H

#include "base.h"
#include "motor.h"
#include "nodo_encoder.h"

#define NODO_SHAFT_N_STEP 4 /**< rows of EQ-SHAFT-2: w, w_load, twist, theta */
#define NODO_SHAFT_N_FROM 5 /**< its columns: w, w_load, twist, a, d_w */
#define NODO_SHAFT_N_LOAD 2 /**< rows of the load: w_load, twist */

typedef struct {
    nodo_encoder_gains_t motor; /**< L of the first seven states, of order 1 */
    float load[NODO_SHAFT_N_LOAD][2][NODO_ENCODER_N_Y]; /**< L_0 and L_1 of w_load and twist */
    float step[NODO_SHAFT_N_STEP][NODO_SHAFT_N_FROM];   /**< [Phi Gamma Gamma_d] of EQ-SHAFT-2 */
} nodo_shaft_gains_t;

typedef struct {
    nodo_t motor;        /**< d_omega acts on the load */
    float  theta_rad;    /**< estimated electrical angle of the motor, within +-pi */
    float  load_e_radps; /**< electrical speed of the load */
    float  twist_rad;    /**< motor ahead of load, electrical */
} nodo_shaft_t;

/** true when every constant is finite and within its documented range. Context: init. */
CTL_PART bool nodo_shaft_check(const nodo_shaft_gains_t *g);

/** Starts at the measurement, with the load as fast as the motor and no twist. */
CTL_PART void nodo_shaft_reset(nodo_shaft_t *s, const nodo_meas_t *y, float theta_rad);

/**
 * @brief EQ-SHAFT-1.
 *
 * @param s           State, corrected in place.
 * @param g           Gains, checked at init.
 * @param i_A         Measured current in the frame of the estimated angle.
 * @param angle_error Measured minus estimated angle [rad], within +-pi.
 * @param ts_s        Control period [s].
 *
 * Context: control ISR. No division, 40 multiplications.
 */
CTL_PART void nodo_shaft_correct(nodo_shaft_t *s, const nodo_shaft_gains_t *g, dq_t i_A,
                                 float angle_error, float ts_s);

/**
 * @brief EQ-SHAFT-2: one period ahead with the voltage that acts.
 *
 * Context: control ISR. No division, 42 multiplications.
 */
CTL_PART void nodo_shaft_predict(nodo_shaft_t *s, const nodo_shaft_gains_t *g,
                                 const motor_reduced_t *m, dq_t v_V, float ts_s);

#endif /* NODO_SHAFT_H */
