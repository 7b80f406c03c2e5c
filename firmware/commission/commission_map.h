/* SPDX-License-Identifier: MIT */
/**
 * @file commission_map.h
 * @brief Inductances along d and q over both currents, from square-wave voltages.
 *
 *     L = Ts sum(di (v - R i - e)) / (sum(di^2) - n var)                    EQ-COMMISSION-6
 *     d current beside a q wave:
 *     v_d = R id* + 0.2 Ld / Ts (id* - id) - w Lq iq                        EQ-COMMISSION-19
 *     amplitude of a q wave: sqrt(bound^2 - id*^2)                          EQ-COMMISSION-20
 *
 * Here e is the back-EMF in the q axis, from the counted speed, and var the variance of the noise
 * of di. The rotor angle is known; the rotor may tremble. w is the electrical speed.
 *
 * Iron that a d current saturates has another Lq: cross saturation. So the q wave runs without a d
 * current and with two negative ones, as the references use them. Iron stores
 * energy, so these say also what a q current does to Ld. The tools fit both.
 */
#ifndef COMMISSION_MAP_H
#define COMMISSION_MAP_H

#include "commission_inductance.h"

/**
 * @brief Executes one period of MAP.
 *
 * @param l     Started by commission_inductance_start().
 * @param found In: ld_H and lq_H of an earlier stage. Out: the means up to the largest current. If
 *              the assumed d axis is the q axis of a reluctance motor, the axes are exchanged and
 *              MAP begins again.
 *
 * Context: control ISR. The last tick is the longest: one division per bin.
 */
commission_answer_t commission_map_tick(commission_inductance_t *l, const commission_config_t *c,
                                        const commission_signal_t *s, commission_result_t *found,
                                        commission_map_t *map);

#endif /* COMMISSION_MAP_H */
