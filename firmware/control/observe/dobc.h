/* SPDX-License-Identifier: MIT */
/**
 * @file dobc.h
 * @brief Speed law of paper B: state feedback with a disturbance observer, without a current loop.
 *
 *     e_w  = w_ref - w                                                    electrical speed
 *     u_q  = u_qd + u_qi
 *     u_qd = (direct + L_d id) w                                          EQ-DOBC-1, paper B (6)
 *     u_qi = k_omega e_w + k_x x^                                         EQ-DOBC-2, paper B (9)
 *     x^(k) = M x^(k-1) + g (e_w(k) - e_w(k-1)) + h u_qi(k-1)             EQ-DOBC-3, paper B (8)
 *
 * x^ = [current error | per oscillator its value and rate | polynomial and its derivatives]. GPIOBC
 * has no oscillators, HDOBC no polynomial, CDOBC both: one recursion, three tables.
 *
 * u_qi(k-1) is the realised part of the voltage computed in the previous period, at its time of
 * computation. The computing delay thus does not detune the oscillators, and a voltage limit does
 * not act as a disturbance. sdre-gains generates all matrices.
 */
#ifndef DOBC_H
#define DOBC_H

#include "base.h"

#define DOBC_N_X_MAX 12 /**< current error, four oscillators, three of the polynomial */

typedef struct {
    int16_t n_x;        /**< states in use, 1 .. DOBC_N_X_MAX */
    float   direct_Vs;  /**< back-EMF and friction per electrical speed [V s/rad] */
    float   ld_H;       /**< coupling of id [H] */
    float   k_omega_Vs; /**< [V s/rad], electrical */
    float   k_x[DOBC_N_X_MAX];
    float   m[DOBC_N_X_MAX][DOBC_N_X_MAX];
    float   g[DOBC_N_X_MAX]; /**< per electrical rad/s */
    float   h[DOBC_N_X_MAX]; /**< per volt */
} dobc_config_t;

typedef struct {
    bool  running; /**< e_radps holds the error of the previous period */
    float x[DOBC_N_X_MAX];
    float e_radps; /**< e_w of the last update */
    float ui_V;    /**< u_qi as realised */
} dobc_t;

/** true when every constant is finite and within its documented range. Context: init. */
bool dobc_check(const dobc_config_t *c);

/** Clears the estimates. The first update takes its error for the previous one too, without a
 * jump. */
void dobc_reset(dobc_t *s);

/** EQ-DOBC-1: the voltage that holds a speed without load. */
float dobc_direct_V(const dobc_config_t *c, float omega_e_radps, float id_A);

/**
 * @brief Executes one period: EQ-DOBC-3 with this sample, then EQ-DOBC-2.
 *
 * @param s       State, updated in place.
 * @param c       Checked by drive_init().
 * @param e_radps Electrical speed error, reference minus measured.
 * @return        u_qi before any limit [V].
 *
 * Context: control ISR. No division, n^2 + 3 n multiply-adds.
 */
float dobc_update(dobc_t *s, const dobc_config_t *c, float e_radps);

/** Takes the realised part of the voltage of dobc_update(). Call it once after each update. */
void dobc_realise(dobc_t *s, float ui_V);

#endif /* DOBC_H */
