/* SPDX-License-Identifier: MIT */
/**
 * @file commission_current.h
 * @brief Controls both currents in the rotor frame, with the measured R, L and flux.
 *
 * Two PI controllers with a bandwidth of 0.2 / Ts. The induced voltages are added.
 */
#ifndef COMMISSION_CURRENT_H
#define COMMISSION_CURRENT_H

#include "commission_types.h"

/** Bandwidth of the loops times Ts, chosen far below the sampling rate. Delay: 1.5 periods. */
#define COMMISSION_CURRENT_BANDWIDTH 0.2f

/** Where and how a period is controlled. */
typedef struct {
    dq_t  i_A;           /**< in the frame of the rotor at the sample */
    dq_t  ref_A;         /**< reference */
    float omega_e_radps; /**< electrical speed */
    float limit_V;       /**< of each integral, > 0 */
} commission_current_t;

/**
 * @brief Executes one period of the current control.
 *
 * @param integral_V State: the integrals.
 *
 * @return Voltage in the frame of the rotor [V]. Context: control ISR. One division.
 */
dq_t commission_current_V(dq_t *integral_V, const commission_config_t *c,
                          const commission_result_t *known, const commission_current_t *now);

/** Current vector of a length and a sign of its torque: along q, of a reluctance motor at 135
 * degrees. */
dq_t commission_current_of(const commission_result_t *known, float size_A, float sign);

#endif /* COMMISSION_CURRENT_H */
