/* SPDX-License-Identifier: MIT */
/**
 * @file pid_law.h
 * @brief PID with the realised voltage fed back: paper B's speed law for comparison, and its d-axis
 * law.
 *
 *     u(k) = k_p e(k) + i(k) + k_d (e(k) - e(k-1))                               EQ-PID-1
 *     i(k+1) = i(k) + k_i e(k), or i(k) if the limit cuts the voltage towards e  EQ-PID-2
 *
 * k_i and k_d hold the control period. All gains come from sdre-gains.
 */
#ifndef PID_LAW_H
#define PID_LAW_H

#include "base.h"

typedef struct {
    float kp;          /**< volts per unit of error */
    float ki_per_tick; /**< k_i Ts, volts per unit of error */
    float kd_tick;     /**< k_d / Ts, volts per unit of error */
} pid_law_config_t;

typedef struct {
    bool  running;    /**< error belongs to the previous period */
    float integral_V; /**< i */
    float error;
    float u_V; /**< before any limit */
} pid_law_t;

/** true when every constant is finite and within its documented range. Context: init. */
bool pid_law_check(const pid_law_config_t *c);

/** The integral starts at integral_V; the first update takes its error as the one before. */
void pid_law_reset(pid_law_t *s, float integral_V);

/**
 * @brief EQ-PID-1: voltage before any limit.
 *
 * Context: control ISR. No division, 2 multiply-adds.
 */
float pid_law_update(pid_law_t *s, const pid_law_config_t *c, float error);

/**
 * @brief EQ-PID-2. Call once after each update.
 *
 * @param v_V Realised part of the voltage that pid_law_update() returned.
 *
 * Context: control ISR. No division.
 */
void pid_law_realise(pid_law_t *s, const pid_law_config_t *c, float v_V);

#endif /* PID_LAW_H */
