/* SPDX-License-Identifier: MIT */
#include "commission_wave.h"

/* Chosen: shares of the dc link. The smallest is below the dead-time loss, the largest in the
 * hexagon. */
#define LEAST_SHARE 0.002f
#define MOST_SHARE  0.45f
/* Chosen: amplitude growth per half wave; the current step cannot jump over the limit. */
#define GROWTH 1.25f
/* A half wave ends here at any current, while the amplitude is searched. */
#define MOST_SAMPLES 16
/* Chosen: so many short half waves in a row prove the amplitude. A noise peak ends a single one. */
#define PROOFS      3
#define FIRST_SHARE 0.707f
/* Chosen: noise makes one. */
#define MOST_SLIPS 3

void commission_wave_start(commission_wave_t *w, float bound_A, int16_t last, float most_V)
{
    const commission_wave_t fresh = {.bound_A = bound_A,
                                     .first_A = FIRST_SHARE * bound_A,
                                     .v_V     = 0.0f,
                                     .most_V  = most_V,
                                     .sign    = 1.0f,
                                     .last    = last,
                                     .samples = 0,
                                     .halves  = 0,
                                     .proofs  = 0,
                                     .slips   = 0,
                                     .lost    = false,
                                     .found   = false};
    *w                            = fresh;
}

/* A short half wave keeps the amplitude; a long one raises it and begins the search again. A dead
 * sensor shows short and long ones in turn, or a long one with the largest amplitude. */
static void search(commission_wave_t *w, float dc_most_V)
{
    const float most_V = base_min(w->most_V, dc_most_V);
    const bool  enough = (w->samples <= COMMISSION_WAVE_SAMPLES) || (w->v_V >= dc_most_V);

    if (!enough && (w->proofs > 0)) {
        w->slips++;
    }
    if ((w->slips >= MOST_SLIPS) || (!enough && (w->v_V >= most_V))) {
        w->slips = 0;
        w->lost  = true;
    }
    w->proofs = enough ? (int16_t)(w->proofs + 1) : (int16_t)0;
    w->found  = w->proofs >= PROOFS;
    w->halves = 0;
    if (!enough) {
        w->v_V = base_min(GROWTH * w->v_V, most_V);
    }
}

static void turn(commission_wave_t *w, float dc_link_V)
{
    const float dc_most_V = MOST_SHARE * dc_link_V;

    w->lost = w->found && (w->samples >= w->last) && (w->v_V < dc_most_V);
    if (!w->found || w->lost) {
        search(w, dc_most_V);
    } else if (w->halves < INT16_MAX) {
        w->halves++;
    } else {
        /* the counter is full */
    }
    w->first_A = w->bound_A;
    w->sign    = -w->sign;
    w->samples = 0;
}

float commission_wave_tick(commission_wave_t *w, float i_A, float di_A, float dc_link_V)
{
    if (!(w->v_V > 0.0f)) {
        w->v_V = LEAST_SHARE * dc_link_V;
    }
    w->samples++;
    const float ahead_A = w->sign * (i_A + (2.0f * di_A)); /* EQ-COMMISSION-2 */
    /* A reversal appears in the current after two samples. */
    const int16_t most = w->found ? w->last : MOST_SAMPLES;
    if ((w->samples > 2) && ((ahead_A > w->first_A) || (w->samples >= most))) {
        turn(w, dc_link_V);
    }
    return w->sign * base_min(w->v_V, MOST_SHARE * dc_link_V);
}
