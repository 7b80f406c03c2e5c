/* SPDX-License-Identifier: MIT */
/**
 * @file commission_emf.h
 * @brief Flux and offset from what a magnet induces (EQ-COMMISSION-12, 13).
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

/** Voltage and current of one period, rotor's frame. @param e forward, backward. Context: control ISR. */
void commission_emf_add(commission_emf_t e[2], const commission_result_t *known,
                        float omega_e_radps, dq_t v_V, dq_t i_A);

/** EQ-COMMISSION-12, 13. @param top_radps largest speed of the run: what is induced there tells whether there is a magnet. */
void commission_emf_solve(const commission_emf_t e[2], float top_radps, float dc_link_V,
                          commission_result_t *found);

#endif /* COMMISSION_EMF_H */
