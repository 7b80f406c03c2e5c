/* SPDX-License-Identifier: MIT */
/**
 * @file iron.h
 * @brief Motor whose iron saturates: its flux linkages, linearised at the present currents.
 *
 * A table over both currents has psi_d, psi_q and their slopes:
 *
 *     D = d psi_d / d id,  Q = d psi_q / d iq,  M = d psi_d / d iq = d psi_q / d id
 *
 * Between its nodes they are bilinear. At the currents (id0, iq0) of a look-up
 *
 *     psi_d = psi_d0 + D (id - id0) + M (iq - iq0)
 *     psi_q = psi_q0 + Q (iq - iq0) + M (id - id0)                              EQ-IRON-1
 *     [D M; M Q] (id', iq') = (v_d - R id + w psi_q, v_q - R iq - w psi_d)
 *
 * The law has EQ-MOTOR-2 with
 *
 *     Ld = D,  Lq = Q,  flux = psi_d0 - D id0,  l1 = c (flux + M iq0),  c = 1.5 n_p^2 / J
 *
 * Its voltages and torque are those of EQ-IRON-1 with the disturbances
 *
 *     d_d + w offset / D,   d_w - c (offset id + M iq0^2),   offset = psi_q0 - Q iq0   EQ-IRON-2
 */
#ifndef IRON_H
#define IRON_H

#include "base.h"
#include "motor.h"
#include "nodo.h"

#define IRON_NODES_D 7 /**< id from 0 down to minus the current limit */
#define IRON_NODES_Q 9 /**< iq from 0 up to the current limit; negative ones mirror */
#define IRON_VALUES  5

/** Order of the values of a node. */
enum { IRON_PSI_D, IRON_PSI_Q, IRON_LD, IRON_LQ, IRON_LDQ };

typedef struct {
    float nodes_per_A_d; /**< (IRON_NODES_D - 1) / current limit [1/A], > 0 */
    float nodes_per_A_q; /**< (IRON_NODES_Q - 1) / current limit [1/A], > 0 */
    float A_per_node_d;  /**< their inverses, > 0 */
    float A_per_node_q;
    float rs_Ohm;                                        /**< of a phase, > 0 */
    float accel_per_WbA;                                 /**< c [rad/s^2/(Wb A)], > 0 */
    float node[IRON_NODES_D][IRON_NODES_Q][IRON_VALUES]; /**< [Wb], [Wb]; D, Q > 0, M [H] */
} iron_map_t;

/** EQ-IRON-1 and the motor of EQ-IRON-2. */
typedef struct {
    motor_reduced_t motor;
    float           id_A; /**< id0: the currents of the look-up, within the table */
    float           iq_A; /**< iq0 */
    float           psi_d_Wb;
    float           psi_q_Wb;
    float           m_H;          /**< M */
    float           inv_det_1pH2; /**< 1 / (D Q - M^2) */
} iron_tangent_t;

/** true when every constant is finite and within its documented range, and M^2 at most 0.9 D Q.
 * Context: init. */
bool iron_check(const iron_map_t *map);

/**
 * @brief EQ-IRON-1 at these currents, or at the edge of the table next to them.
 *
 * @param map   The table, checked at init.
 * @param plain Constants that no iron changes: l2 and l3 are taken.
 * @param id_A  Any number; a NaN takes an edge of the table.
 * @param iq_A  The same.
 *
 * Context: control ISR. One division, 50 multiplications.
 */
iron_tangent_t iron_tangent(const iron_map_t *map, const motor_reduced_t *plain, float id_A,
                            float iq_A);

/**
 * @brief EQ-NODO-ENCODER-2 with EQ-IRON-1.
 *
 * @param x         Estimates, moved in place by a period.
 * @param theta_rad The same of the electrical angle, within +-pi.
 * @param map       The table.
 * @param t         Its tangent near these estimates.
 * @param v_V       Voltage that acts in the period.
 * @param ts_s      Control period [s].
 *
 * Context: control ISR. No division, 56 multiplications.
 */
void iron_predict(nodo_t *x, float *theta_rad, const iron_map_t *map, const iron_tangent_t *t,
                  dq_t v_V, float ts_s);

/** Estimates with the disturbances of EQ-IRON-2. Context: control ISR. */
static inline nodo_t iron_estimates(const iron_map_t *map, const iron_tangent_t *t, const nodo_t *x)
{
    const float offset_Wb = t->psi_q_Wb - (t->motor.inv_l6 * t->iq_A);
    const float cross_WbA = t->m_H * t->iq_A * t->iq_A;
    nodo_t      seen      = *x;

    seen.d_d += t->motor.l8 * offset_Wb * x->omega_e_radps;
    seen.d_omega -= map->accel_per_WbA * (cross_WbA + (offset_Wb * x->id_A));
    return seen;
}

#endif /* IRON_H */
