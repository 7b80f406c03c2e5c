/* SPDX-License-Identifier: MIT */
/**
 * @file held_winding.h
 * @brief A motor whose rotor is held at an angle or a speed, in double precision: what a commissioning stage sees of it.
 */
#ifndef HELD_WINDING_H
#define HELD_WINDING_H

#include <math.h>

#include "commission_types.h"

typedef struct {
    double ts_s;
    double angle_rad;
    double omega_e_radps; /**< 0: the rotor stands */
    double flux_Wb;       /**< shows in a turning rotor */
    double r_Ohm;
    double ld_H; /**< at no current */
    double lq_H;
    double fall_1pA; /**< share of both that each ampere of their current takes */
    double
        cross_1pA; /**< share of lq that each positive ampere of d current takes, a negative one adds */
    double loss_V; /**< that a phase loses against its current */
    double id_A;
    double iq_A;
    ab_t   v_now_V; /**< asked for at the last sample */
    ab_t   last_A;
} held_winding_t;

static inline double winding_sign(double i_A)
{
    return (i_A > 0.02) ? 1.0 : ((i_A < -0.02) ? -1.0 : (i_A / 0.02));
}

/** The next sample, one period on. The voltage in force was requested one sample before the last. */
static inline commission_signal_t winding_step(held_winding_t *w, ab_t asked_V)
{
    const int parts = 20;
    for (int k = 0; k < parts; k++) {
        const double c     = cos(w->angle_rad);
        const double s     = sin(w->angle_rad);
        const double alpha = (w->id_A * c) - (w->iq_A * s);
        const double beta  = (w->id_A * s) + (w->iq_A * c);
        const double half  = 0.5 * sqrt(3.0) * beta;
        const double la    = winding_sign(alpha);
        const double lb    = winding_sign(half - (0.5 * alpha));
        const double lc    = winding_sign(-half - (0.5 * alpha));
        const double va    = (double)w->v_now_V.alpha - (w->loss_V * ((2.0 * la) - lb - lc) / 3.0);
        const double vb    = (double)w->v_now_V.beta - (w->loss_V * (lb - lc) / sqrt(3.0));
        const double ld    = w->ld_H * (1.0 - (w->fall_1pA * fabs(w->id_A)));
        const double lq =
            w->lq_H * (1.0 - (w->fall_1pA * fabs(w->iq_A)) - (w->cross_1pA * w->id_A));
        const double ed = -w->omega_e_radps * lq * w->iq_A;
        const double eq = w->omega_e_radps * ((ld * w->id_A) + w->flux_Wb);
        w->id_A += ((va * c) + (vb * s) - (w->r_Ohm * w->id_A) - ed) / ld * w->ts_s / parts;
        w->iq_A += ((vb * c) - (va * s) - (w->r_Ohm * w->iq_A) - eq) / lq * w->ts_s / parts;
        w->angle_rad += w->omega_e_radps * w->ts_s / parts;
    }
    const double        c   = cos(w->angle_rad);
    const double        s   = sin(w->angle_rad);
    commission_signal_t out = {.dc_link_V = 540.0f, .v_V = w->v_now_V};
    out.i_A.alpha           = (float)((w->id_A * c) - (w->iq_A * s));
    out.i_A.beta            = (float)((w->id_A * s) + (w->iq_A * c));
    out.di_A.alpha          = out.i_A.alpha - w->last_A.alpha;
    out.di_A.beta           = out.i_A.beta - w->last_A.beta;
    w->last_A               = out.i_A;
    w->v_now_V              = asked_V;
    return out;
}

#endif /* HELD_WINDING_H */
