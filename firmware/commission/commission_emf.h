/* SPDX-License-Identifier: MIT */
/**
 * @file commission_emf.h
 * @brief Flux and offset from the magnet's back-EMF (EQ-COMMISSION-12, 13).
 */
#ifndef COMMISSION_EMF_H
#define COMMISSION_EMF_H

#include "commission_types.h"

typedef struct {
    float vd_w; /**< sums of v_d w, v_q w, w^2 */
    float vq_w;
    float ww;
    float vv;
    float n;
} commission_emf_t;

/** Adds one period in the rotor frame. @param e sums forward, backward. Context: control ISR. */
void commission_emf_add(commission_emf_t e[2], const commission_result_t *known,
                        float omega_e_radps, dq_t v_V, dq_t i_A);

/**
 * @brief Computes flux and offset, EQ-COMMISSION-12, 13.
 *
 * @param top_radps Largest electrical speed of the run. The back-EMF there decides whether the
 * motor
 *                  has a magnet.
 *
 * Context: control ISR, at the end of a stage.
 */
void commission_emf_solve(const commission_emf_t e[2], float top_radps, float dc_link_V,
                          commission_result_t *found);

#endif /* COMMISSION_EMF_H */
