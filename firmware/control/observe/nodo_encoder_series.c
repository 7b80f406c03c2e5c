/* SPDX-License-Identifier: MIT */
#include "nodo_encoder.h"

enum { ROW_THETA = NODO_N_X };
enum { OF_IQ, OF_ID, OF_THETA }; /* columns */

void nodo_encoder_add_series(nodo_t *x, float *theta, const nodo_encoder_gains_t *g,
                             const nodo_innovation_t *r, float iq_A)
{
    nodo_t            sum   = *x; /* local, so that the compiler keeps it in registers */
    float             angle = *theta;
    nodo_innovation_t power;

    power = *r;
    for (int16_t n = 0; n <= g->order; n = (int16_t)(n + 2)) { /* EQ-NODO-ENCODER-3 */
        const float(*l)[NODO_ENCODER_N_Y] = g->gain[n];

        nodo_add_even(&sum, l, OF_ID, &power);
        angle += (l[ROW_THETA][OF_IQ] * power.odd[0]) + (l[ROW_THETA][OF_THETA] * power.odd[1]);
        if (n < g->order) {
            l     = g->gain[n + 1];
            power = nodo_next_power(power, iq_A);
            nodo_add_odd(&sum, l, OF_ID, &power);
            angle += l[ROW_THETA][OF_ID] * power.id;
            power = nodo_next_power(power, iq_A);
        }
    }
    *x     = sum;
    *theta = angle;
}
