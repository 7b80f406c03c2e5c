/* SPDX-License-Identifier: MIT */
/**
 * @file nodo_current.h
 * @brief Corrects the encoder form's observer by the currents alone, after loss of the encoder.
 *
 *     [d_w w theta]^+ = [d_w w theta]^- + K r,  r = i - i^
 *     i^+ = R(-K_theta r)(i^- + K_i r)                                            EQ-NODO-CURRENT-1
 *     K linear between nodes of sqrt abs(w); w < 0: mirror image                  EQ-NODO-CURRENT-2
 *
 * The back-EMF carries speed and angle, so the correction works above a minimum speed. The
 * correction of the angle by K_theta r leaves the currents unchanged in the stator frame. Therefore
 * the gains for no load hold for every load. d_q and d_d are not observable beside speed and angle:
 * they keep their last values with encoder.
 */
#ifndef NODO_CURRENT_H
#define NODO_CURRENT_H

#include "base.h"
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

/** true when every constant is finite and within its documented range. Context: init. */
bool nodo_current_check(const nodo_current_gains_t *g);

/** True if the speed suffices for the correction. Context: control ISR. */
static inline bool nodo_current_knows(const nodo_current_gains_t *g, float omega_e_radps)
{
    return !base_within(omega_e_radps, g->from_e_radps) && base_within(omega_e_radps, 1.0e9f);
}

/**
 * @brief EQ-NODO-CURRENT-1, 2.
 *
 * @param x         Estimates of this instant, corrected in place.
 * @param theta_rad Estimated electrical angle, corrected in place, within +-pi.
 * @param g         Gains.
 * @param i_A       Measured current in the frame of the estimated angle.
 *
 * Context: control ISR. One square root, 32 multiplications.
 */
void nodo_current_correct(nodo_t *x, float *theta_rad, const nodo_current_gains_t *g, dq_t i_A);

#endif /* NODO_CURRENT_H */
