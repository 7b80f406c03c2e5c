/* SPDX-License-Identifier: MIT */
/**
 * @file commission_fit.h
 * @brief Least squares with two unknowns: y = x0 a + x1 b.
 *
 *     [saa sab; sab sbb] x = [say; sby],  variance of x_k = rest / (n - 2) [inverse]_kk      EQ-COMMISSION-1
 */
#ifndef COMMISSION_FIT_H
#define COMMISSION_FIT_H

#include "base.h"

typedef struct {
    float   aa;
    float   ab;
    float   bb;
    float   ay;
    float   by;
    float   yy;
    int32_t n;
} commission_fit_t;

typedef struct {
    float x0;
    float x1;
    float error0; /**< twice the standard deviation */
    float error1;
    bool  valid; /**< the two columns are linearly independent */
} commission_fitted_t;

/** Removes all equations. */
void commission_fit_reset(commission_fit_t *f);

/** Adds the equation y = x0 a + x1 b. Context: control ISR. */
void commission_fit_add(commission_fit_t *f, float a, float b, float y);

/** Solves the equations, EQ-COMMISSION-1. Context: control ISR, at the end of a stage. */
commission_fitted_t commission_fit_solve(const commission_fit_t *f);

#endif /* COMMISSION_FIT_H */
