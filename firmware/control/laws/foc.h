/* SPDX-License-Identifier: MIT */
/**
 * @file foc.h
 * @brief Inner part of field-oriented control: current references and a PI for each current.
 *
 *     iq_ref = clamp(a / (l1 + l11 id_ref(k-1)), +-most)                    EQ-FOC-1
 *     id_ref = -iq_ref^2 / (k + sqrt(k^2 + iq_ref^2)) + id_fw               EQ-FOC-2
 *     id_fw(k+1) = clamp(id_fw + g (share v_dc / sqrt(3) - |u|), id_lo, 0)  EQ-FOC-3
 *     most = sqrt(i_max^2 - id_ref(k-1)^2)                                  EQ-FOC-4
 *
 *     u = k_p e + s + (-w Lq iq, w (Ld id + flux)),  e = i_ref - i          EQ-FOC-5
 *     s(k+1) = s + k_i (e + (v - u) / k_p)                                  EQ-FOC-6
 *
 * Here a is the requested acceleration, u the requested voltage and v its realised part. The exact
 * MTPA of EQ-FOC-2 is that of EQ-CURRENT-REF-2. If u is outside the circle of v_dc / sqrt(3) and id
 * is short of its reference, the d axis has priority. Flux weakening thus gets its current; q gets
 * the rest. In all other cases drive_tick() cuts the length. The MTPA part of id_ref follows iq_ref
 * at once; the integrator makes the flux weakening.
 */
#ifndef FOC_H
#define FOC_H

#include "drive_config.h"
#include "law.h"

/** PI of one current. */
typedef struct {
    float kp_V_per_A; /**< > 0 */
    float ki_tick;    /**< k_i Ts [V/A], >= 0 */
    float ki_per_kp;  /**< k_i Ts / k_p: anti-windup share of a cut voltage, 0 .. 1 */
} foc_axis_t;

typedef struct {
    foc_axis_t d;
    foc_axis_t q;
    float      current_max_A; /**< radius of the current circle [A peak], > 0 */
    float      iq_max_A;      /**< |iq| where the MTPA curve meets the circle, 0 .. current_max_A */
    float      mtpa_A;        /**< k of EQ-FOC-2 [A], > 0; large without saliency */
    float      id_min_A;      /**< id_lo, < 0, >= -current_max_A */
    float      voltage_share; /**< usable share of the voltage circle for steady currents, (0, 1] */
    float      weakening_A_per_V; /**< g, >= 0 */
} foc_config_t;

typedef struct {
    dq_t  sum_V; /**< s */
    dq_t  e_A;   /**< error of the previous period */
    dq_t  u_V;   /**< requested in the previous period, before limits */
    dq_t  i_ref_A;
    float id_fw_A;
    float iq_most_A; /**< present limit of |iq_ref| */
    float limit;     /**< 1, -1: torque is limited in this direction; 0: no limit */
} foc_t;

/** true when every constant is finite and within its documented range. Context: init. */
bool foc_check(const foc_config_t *c, const drive_config_t *drive);

/** Starts with zero references and sums; the EMF is fed forward. Context: control ISR. */
void foc_reset(foc_t *s);

/**
 * @brief EQ-FOC-3, 4 and 6, by the realised part of the last voltage. Call it first in a period.
 *
 * Context: control ISR. Two square roots, no division.
 */
void foc_realise(foc_t *s, const foc_config_t *c, const law_input_t *in);

/**
 * @brief EQ-FOC-1, 2 and 5: the complete answer. Call it once after foc_realise().
 *
 * @param y                     Measured speed and currents.
 * @param accel_wanted_e_radps2 Acceleration requested of the motor's torque, before any limit. A
 * NaN
 *                              gives a NaN voltage.
 *
 * Context: control ISR. One square root, two divisions.
 */
void foc_answer(foc_t *s, const foc_config_t *c, const drive_config_t *drive, const law_input_t *in,
                const nodo_meas_t *y, float accel_wanted_e_radps2, law_output_t *out);

#endif /* FOC_H */
