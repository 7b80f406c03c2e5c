/* SPDX-License-Identifier: MIT */
/**
 * @file nodo_current.h
 * @brief Corrects the encoder form's observer by the currents alone, after loss of the encoder.
 *
 *     [d_w w theta]^+ = [d_w w theta]^- + K r,  r = i - i^
 *     i^+ = R(-K_theta r)(i^- + K_i r)                                            EQ-NODO-CURRENT-1
 *     K linear between nodes of sqrt abs(w); w < 0: mirror image                  EQ-NODO-CURRENT-2
 *     d_q = k_q w,  d_d = k_d w iq                                                EQ-NODO-CURRENT-3
 *
 * The back-EMF carries speed and angle, so the correction works above a minimum speed. The
 * correction of the angle by K_theta r leaves the currents unchanged in the stator frame. Therefore
 * the gains for no load hold for every load.
 *
 * d_q and d_d are not observable beside speed and angle. With encoder they show how the motor
 * differs from the believed one: in flux and L_d (d_q), in L_q (d_d). Such errors grow with w and
 * with w iq. k_q and k_d keep their share while the drive brakes and reverses iq.
 */
#ifndef NODO_CURRENT_H
#define NODO_CURRENT_H

#include "base.h"
#include "motor.h"
#include "nodo.h"

#define NODO_CURRENT_NODES 5
#define NODO_CURRENT_N_X   5 /**< rows: d_w, w, iq, id, theta */
#define NODO_CURRENT_N_Y   2 /**< columns: measured iq, id */

typedef struct {
    float from_e_radps;   /**< minimum speed, > 0; speed of the first node */
    float root;           /**< its root, > 0 */
    float nodes_per_root; /**< node = this times (sqrt abs(w) - root), > 0 */
    float gain[NODO_CURRENT_NODES][NODO_CURRENT_N_X][NODO_CURRENT_N_Y];
} nodo_current_gains_t;

/** Without encoder. Cleared at the start of a run. */
typedef struct {
    float least_e_radps; /**< the correction goes on above; 0: it has not begun */
    float q_A;           /**< k_q, within 0.3 of l5 */
    float d;             /**< k_d, within half of l9 */
} nodo_current_t;

/** true when every constant is finite and within its documented range. Context: init. */
bool nodo_current_check(const nodo_current_gains_t *g);

/** Starts a run. */
static inline void nodo_current_reset(nodo_current_t *s)
{
    s->least_e_radps = 0.0f; /* the others follow at the loss */
}

/**
 * @brief EQ-NODO-CURRENT-1 to 3.
 *
 * It begins above the minimum speed. Below, no later speed suffices.
 *
 * @param s         The first call of a run takes k_q and k_d from x.
 * @param x         Estimates of this instant, corrected in place.
 * @param theta_rad Estimated electrical angle, corrected in place, within +-pi.
 * @param g         Gains.
 * @param m         Believed motor.
 * @param i_A       Measured current in the frame of the estimated angle.
 * @return True if the speed suffices for the correction.
 *
 * Context: control ISR. One square root, 34 multiplications; once a division.
 */
bool nodo_current_correct(nodo_current_t *s, nodo_t *x, float *theta_rad,
                          const nodo_current_gains_t *g, const motor_reduced_t *m, dq_t i_A);

#endif /* NODO_CURRENT_H */
