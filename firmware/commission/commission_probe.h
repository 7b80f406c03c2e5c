/* SPDX-License-Identifier: MIT */
/**
 * @file commission_probe.h
 * @brief Adds voltage pulses to the vector of RESISTANCE and DRAG: the sensors have to answer.
 *
 * The loop of these stages holds a direct current. It cannot tell a sensor that has died from a
 * current that does not change. Pulses +v, -v, -v, +v of one period each, along alpha and beta in
 * turn, leave no mean voltage and no mean current. The answers of 32 periods give the admittance of
 * the winding (EQ-COMMISSION-15), which is judged like that of the check.
 */
#ifndef COMMISSION_PROBE_H
#define COMMISSION_PROBE_H

#include "commission_check.h"
#include "commission_types.h"

#define COMMISSION_PROBE_TICKS 32 /**< periods of a window: its pulses have no mean */

typedef struct {
    commission_sums_t sums; /**< of the windows, the latest counts most */
    int16_t           tick; /**< within the window */
    bool              full; /**< a window has all of its answers */
} commission_probe_t;

/** Starts a window. Context: control ISR. */
void commission_probe_start(commission_probe_t *p);

/**
 * @brief Judges the answers, and gives the next pulse.
 *
 * @param known   Admittance and pulses of the check.
 * @param pulse_V Voltage to be added to that of the next period.
 * @return        false: the sensors do not answer as in the check.
 *
 * Context: control ISR. One division in 32 periods.
 */
bool commission_probe_tick(commission_probe_t *p, const commission_config_t *c,
                           const commission_signal_t *s, const commission_admittance_t *known,
                           ab_t *pulse_V);

#endif /* COMMISSION_PROBE_H */
