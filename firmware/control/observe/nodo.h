/* SPDX-License-Identifier: MIT */
/**
 * @file nodo.h
 * @brief Near optimal disturbance observer, paper A (31), explicit Euler at the control period.
 *
 *     x^ = [d_w d_q d_d | w iq id]^
 *     x^' = A_d(iq^) x^ + u_d + L(iq^) (y - C_d x^),   y = [w iq id] measured      EQ-NODO-1
 *     L(iq^) = L_0 + L_1 iq^ + ... + L_Nd iq^Nd                                    EQ-NODO-2, (39)
 *
 * A_d contains EQ-MOTOR-2 with the products l11 iq^ id^ and l9 iq^ w^. u_d contains -l10 id w + l6
 * vq and l8 vd with the applied voltage, (27).
 */
#ifndef NODO_H
#define NODO_H

#include "base.h"
#include "motor.h"

#define NODO_ORDER_MAX 8 /**< highest power of iq^ a table can hold */
#define NODO_N_X       6 /**< rows of L_n, in the order of nodo_t */
#define NODO_N_Y       3 /**< columns of L_n: measured speed, iq, id */

typedef struct {
    int16_t order;          /**< N_d, 0 .. NODO_ORDER_MAX */
    float   iq_max_A;       /**< the series is used for |iq^| <= this; > 0 */
    float   iq_certified_A; /**< stable with the gain held for |iq^| <= this; >= iq_max_A */
    float   gain[NODO_ORDER_MAX + 1][NODO_N_X][NODO_N_Y]; /**< L_n, n <= order */
} nodo_gains_t;

/** Measurements of the observer. */
typedef struct {
    float omega_e_radps;
    float iq_A;
    float id_A;
} nodo_meas_t;

/** Estimates. */
typedef struct {
    float d_omega;       /**< disturbance of the speed equation [rad/s^2] */
    float d_q;           /**< disturbance of the iq equation [A/s] */
    float d_d;           /**< disturbance of the id equation [A/s] */
    float omega_e_radps; /**< electrical speed */
    float iq_A;
    float id_A;
} nodo_t;

/**
 * @brief Innovation by parity.
 *
 * The motor is symmetrical to the d axis. Mirroring changes the signs of the odd signals w, iq,
 * theta, d_w, d_q and vq. It keeps those of the even signals id, d_d and vd. L(iq) has the same
 * symmetry:
 *
 * - An even L_n maps odd signals to odd states, and id to d_d and id.
 * - An odd L_n maps odd signals to d_d and id, and id to odd states.
 *
 * All other elements of the tables are zero and are not multiplied.
 */
typedef struct {
    float odd[2]; /**< the odd signals in the order of the table's columns */
    float id;
} nodo_innovation_t;

/* The functions add L_n r to the six estimates. l has at least the rows of nodo_t, and id is in
 * column id_column. They are inline, as each observer knows this column at compile time. */

/** Column of the second odd signal: 2 of (iq, id, theta), 1 of (w, iq, id); the first one stands in
 * column 0. */
static inline int16_t nodo_second_column(int16_t id_column)
{
    return (int16_t)(3 - id_column);
}

/** L_n r of an even n. */
static inline void nodo_add_even(nodo_t *x, const float (*l)[NODO_N_Y], int16_t id_column,
                                 const nodo_innovation_t *r)
{
    const int16_t second = nodo_second_column(id_column);
    const float   a      = r->odd[0];
    const float   b      = r->odd[1];

    x->d_omega += (l[0][0] * a) + (l[0][second] * b);
    x->d_q += (l[1][0] * a) + (l[1][second] * b);
    x->d_d += l[2][id_column] * r->id;
    x->omega_e_radps += (l[3][0] * a) + (l[3][second] * b);
    x->iq_A += (l[4][0] * a) + (l[4][second] * b);
    x->id_A += l[5][id_column] * r->id;
}

/** L_n r of an odd n. */
static inline void nodo_add_odd(nodo_t *x, const float (*l)[NODO_N_Y], int16_t id_column,
                                const nodo_innovation_t *r)
{
    const int16_t second = nodo_second_column(id_column);
    const float   a      = r->odd[0];
    const float   b      = r->odd[1];

    x->d_omega += l[0][id_column] * r->id;
    x->d_q += l[1][id_column] * r->id;
    x->d_d += (l[2][0] * a) + (l[2][second] * b);
    x->omega_e_radps += l[3][id_column] * r->id;
    x->iq_A += l[4][id_column] * r->id;
    x->id_A += (l[5][0] * a) + (l[5][second] * b);
}

/** true when the first rows of an even or odd L_n are zero where its parity says so. Context:
 * init. */
bool nodo_parity_check(const float (*l)[NODO_N_Y], int16_t rows, bool even, int16_t id_column);

/** The innovation of the next power of iq^. */
static inline nodo_innovation_t nodo_next_power(nodo_innovation_t r, float iq_A)
{
    const nodo_innovation_t next = {{r.odd[0] * iq_A, r.odd[1] * iq_A}, r.id * iq_A};
    return next;
}

/** true when every constant is finite and within its documented range. Context: init. */
bool nodo_check(const nodo_gains_t *g);

/** Estimates start at the measurement, disturbances at zero. */
void nodo_reset(nodo_t *x, const nodo_meas_t *y);

/**
 * @brief Corrects with y and advances to the next sampling instant.
 *
 * L is evaluated at iq^ clamped to +-g->iq_max_A, A_d at iq^ clamped to +-g->iq_certified_A.
 *
 * @param x     Estimates, advanced in place.
 * @param g     Gains.
 * @param m     Reduced parameters of the gains.
 * @param y     Measurement at this instant.
 * @param v_V   Voltage that acts in the coming period, after every limit.
 * @param ts_s  Control period [s].
 *
 * Context: control ISR. No division, 13 (Nd+1) + 19 multiplications at most.
 */
void nodo_update(nodo_t *x, const nodo_gains_t *g, const motor_reduced_t *m, const nodo_meas_t *y,
                 dq_t v_V, float ts_s);

#endif /* NODO_H */
