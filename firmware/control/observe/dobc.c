/* SPDX-License-Identifier: MIT */
#include "dobc.h"

#include "check.h"

void dobc_reset(dobc_t *s)
{
    s->running = false;
    s->e_radps = 0.0f;
    s->ui_V    = 0.0f;
    for (int16_t i = 0; i < DOBC_N_X_MAX; i++) {
        s->x[i] = 0.0f;
    }
}

float dobc_direct_V(const dobc_config_t *c, float omega_e_radps, float id_A)
{
    return (c->direct_Vs + (c->ld_H * id_A)) * omega_e_radps; /* EQ-DOBC-1 */
}

float dobc_update(dobc_t *s, const dobc_config_t *c, float e_radps)
{
    const float step_radps = s->running ? (e_radps - s->e_radps) : 0.0f;
    float       next[DOBC_N_X_MAX];
    float       u_V = c->k_omega_Vs * e_radps;

    for (int16_t row = 0; row < c->n_x; row++) { /* EQ-DOBC-3 */
        float sum = (c->g[row] * step_radps) + (c->h[row] * s->ui_V);
        for (int16_t column = 0; column < c->n_x; column++) {
            sum += c->m[row][column] * s->x[column];
        }
        next[row] = sum;
    }
    for (int16_t row = 0; row < c->n_x; row++) { /* EQ-DOBC-2 */
        s->x[row] = next[row];
        u_V += c->k_x[row] * next[row];
    }
    s->e_radps = e_radps;
    s->running = true;
    return u_V;
}

void dobc_realise(dobc_t *s, float ui_V)
{
    s->ui_V = ui_V;
}

bool dobc_check(const dobc_config_t *c)
{
    bool ok = (c->n_x >= 1) && (c->n_x <= DOBC_N_X_MAX);

    for (int16_t row = 0; ok && (row < c->n_x); row++) {
        ok = check_finite(c->m[row], c->n_x);
    }
    return ok && check_positive(c->direct_Vs) && check_positive(c->ld_H) &&
           check_positive(c->k_omega_Vs) && check_finite(c->k_x, c->n_x) &&
           check_finite(c->g, c->n_x) && check_finite(c->h, c->n_x);
}
