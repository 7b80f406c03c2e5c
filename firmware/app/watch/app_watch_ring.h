/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_ring.h
 * @brief Reports a torque current that oscillates: a shaft that rings.
 *
 * A cycle reaches from one rise of the torque current through its mean to the next. The current has
 * to pass both sides of the mean by 0.05 of the largest current. Noise has cycles of any length; an
 * oscillation repeats one length:
 *
 *     |T - T_mean| <= T_mean / 4 + Ts,  40 Hz .. 600 Hz, for 0.3 s                    EQ-RING-1
 *
 * An odd cycle takes 0.1 s back.
 *
 * Nothing in the drive acts on it. Context: background.
 */
#ifndef APP_WATCH_RING_H
#define APP_WATCH_RING_H

#include "base.h"

typedef struct {
    uint32_t ticks;   /**< of the pass before */
    uint32_t crossed; /**< at the last rise */
    uint32_t since;   /**< the cycles are alike for so long */
    uint32_t rang;    /**< at the last cycle that was reported */
    float    mean_A;  /**< of the torque current, over 20 ms */
    float    period;  /**< T_mean, control periods; 0: none yet */
    float    hz;      /**< of the last oscillation; 0: none since the start */
    bool     above;   /**< the current has risen */
    bool     begun;   /**< the members above are of a run */
    bool     rings;   /**< now, or within the last 2 s */
} app_watch_ring_t;

/** Input of a pass of the background. */
typedef struct {
    uint32_t ticks; /**< control periods since the start */
    bool     runs;  /**< the currents are controlled in a run */
    float    iq_A;
} app_watch_ring_seen_t;

/** Knows of no oscillation. */
void app_watch_ring_reset(app_watch_ring_t *w);

/**
 * @brief EQ-RING-1.
 *
 * The frequency is right while the passes are a third of an oscillation apart at most.
 *
 * @param most_A Largest current [A], > 0.
 * @param ts_s   Control period [s].
 */
void app_watch_ring_see(app_watch_ring_t *w, const app_watch_ring_seen_t *seen, float most_A,
                        float ts_s);

#endif /* APP_WATCH_RING_H */
