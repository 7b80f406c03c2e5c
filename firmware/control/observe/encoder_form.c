/* SPDX-License-Identifier: MIT */
#include "encoder_form.h"

#include "check.h"
#include "fpu.h"

CTL_PART bool encoder_form_check(const encoder_form_limits_t *limits)
{
    return base_in_range(limits->angle_rad, 1.0e-6f, BASE_PI) && check_positive(limits->d_omega);
}

CTL_PART bool encoder_form_gains_check(const encoder_form_gains_t *gains)
{
    return base_in_range(gains->theta, 1.0e-6f, 1.0f) && check_positive(gains->omega_1ps) &&
           check_positive(gains->d_omega_1ps2) && check_positive(gains->count_rad);
}

/* Share s of the error that the acceleration explains, within 0.15 .. 0.5 the gain of one sample; 2
 * would explain all of it. Chosen by simulation: with 0.1 a reversal has three times the ripple.
 * With 0.5, a motor of 0.6 times the inertia oscillates at rest. A share that falls with the
 * distance of the edges lets a pump with few lines oscillate. */
#define D_OMEGA_SHARE      0.15f
#define D_OMEGA_SHARE_MOST 0.5f

/* Share s_w that the speed explains. Chosen by simulation at 1 .. 10 rad/s: with 1, edges with
 * errors of their own have twice the ripple. At rest a share of 0.5 oscillates with 0.6 times the
 * inertia, so it grows from 1.5 to 3 periods. */
#define OMEGA_SHARE  0.5f
#define OMEGA_GROWTH 0.33f

CTL_PART float encoder_form_correct_rare(nodo_t *est, float *theta_hat_rad,
                                         const encoder_form_gains_t *gains, float error_rad,
                                         float gap_s, float ts_s)
{
    const float count_rad = gains->count_rad;
    const float speed     = fabsf(est->omega_e_radps);

    if ((speed * ts_s) >= count_rad) {
        return 1.0f; /* an edge or more in each sample: its gains apply */
    }
    /* T and 1 / T, by the gap or by the time of a count. One division gives all reciprocals. */
    const bool  by_gap  = (gap_s * speed) < count_rad;
    const float over    = by_gap ? gap_s : (speed * count_rad);
    const float both    = fpu_inverse(over * gains->d_omega_1ps2 * ts_s);
    const float inv     = both * gains->d_omega_1ps2 * ts_s;
    const float inv_ts  = both * over * gains->d_omega_1ps2;
    const float inv_d   = both * over * ts_s;
    const float every_s = base_max(by_gap ? gap_s : (count_rad * count_rad * inv), ts_s);
    const float per_s   = base_min(by_gap ? inv : (speed * speed * inv), inv_ts);
    const float samples = every_s * inv_ts;
    const float s =
        base_clamp(gains->d_omega_1ps2 * ts_s * ts_s, D_OMEGA_SHARE, D_OMEGA_SHARE_MOST);
    const float share    = base_min(samples, s * per_s * per_s * inv_d);
    const float theta    = base_min(gains->theta * samples, 1.0f) - (share * gains->theta);
    const float most_1ps = base_clamp(OMEGA_GROWTH * samples, OMEGA_SHARE, 1.0f) * per_s;
    const float omega = base_min(gains->omega_1ps * samples, most_1ps) - (share * gains->omega_1ps);

    est->omega_e_radps += omega * error_rad;
    *theta_hat_rad = frames_wrap(*theta_hat_rad + (theta * error_rad));
    return share;
}

CTL_PART void encoder_form_edges_reset(encoder_form_edges_t *edges)
{
    int16_t edge;

    for (edge = 0; edge < ENCODER_FORM_LINE; edge++) {
        edges->offset_rad[edge] = 0.0f; /* alike() copies them to the others */
    }
    edges->learned = 0U;
    encoder_form_skip(edges);
}

/* Learning rate. Chosen: a tenth of the exact step for three edges, whose squared weights sum to
 * 1 + 2 * 2 + 1. The offsets of a line then converge to a tenth within some forty samples at
 * different edges. Lines that differ disturb them by a third of that. */
#define LEARN (0.1f / 6.0f)
/* Chosen: a larger ratio of edge intervals means a shaft that starts or stops. */
#define LEARN_RHO_MAX 4.0f
/* Chosen: the speed is not constant over longer edge intervals. */
#define LEARN_PERIODS 4.0f
/* Chosen: widest state of the disc [count]. */
#define WIDEST    1.5f
#define GAP_MIN_s 1.0e-7f
/* Chosen: samples in which the lines of the pattern are taken as the same. After half of them, a
 * speed that meets an edge four times before the next one leaves 0.03 counts. They follow one
 * another: with fewer edges than samples, lines that differ would learn the shaft's ripple
 * (sil.slow_speed). */
#define ALIKE 512U

static void add_offset(encoder_form_edges_t *edges, uint16_t at, float step_rad, float most_rad)
{
    float *const at_rad = &edges->offset_rad[at];

    *at_rad = base_clamp(*at_rad + step_rad, -most_rad, most_rad);
}

static void learn(encoder_form_edges_t *edges, const drive_sample_t *s, uint16_t now,
                  float most_rad, float most_s)
{
    const uint16_t before = encoder_form_place(edges->place[0]);
    const uint16_t first  = encoder_form_place(edges->place[1]);
    const float    rho    = s->edge_gap_s * edges->per_gap_1ps;

    if ((rho * LEARN_RHO_MAX < 1.0f) || (rho > LEARN_RHO_MAX) || (s->edge_gap_s > most_s) ||
        (s->omega_e_radps * edges->omega_e_radps <= 0.0f)) {
        return;
    }
    const float off_rad  = edges->offset_rad[before];
    const float bend_rad = (s->omega_e_radps - edges->omega_e_radps) * s->edge_gap_s;
    const float known_rad =
        edges->offset_rad[now] - off_rad - (rho * (off_rad - edges->offset_rad[first]));
    const float step_rad = LEARN * base_clamp(bend_rad - known_rad, -most_rad, most_rad);

    add_offset(edges, now, step_rad, most_rad);
    add_offset(edges, before, -(1.0f + rho) * step_rad, most_rad);
    add_offset(edges, first, rho * step_rad, most_rad);
}

/* While all lines are taken as the same, an edge has its place in the first line. Each sample
 * copies one offset of that line to another one. All have them when lines begin to differ. */
static uint16_t alike(encoder_form_edges_t *edges, uint16_t seen)
{
    const uint16_t n = edges->learned;

    if (n >= ALIKE) {
        return seen;
    }
    edges->offset_rad[encoder_form_place(n)] = edges->offset_rad[n % (uint16_t)ENCODER_FORM_LINE];
    edges->learned                           = (uint16_t)(n + 1U);
    return seen % (uint16_t)ENCODER_FORM_LINE;
}

CTL_PART float encoder_form_learn(encoder_form_edges_t *edges, const drive_sample_t *s,
                                  float count_rad, float ts_s)
{
    const uint16_t seen = (uint16_t)((uint16_t)s->edge_of_pattern - 1U);

    if (seen >= (uint16_t)ENCODER_FORM_EDGES) {
        /* An edge without a time, or an edge of unknown place. */
        if ((s->edge_age_s > 0.0f) || !encoder_form_is_rare(s, ts_s)) {
            edges->known = 0U;
        }
        if (edges->learned < ALIKE) {
            edges->learned = 0U;
        }
        return 0.0f;
    }
    const uint16_t now         = alike(edges, seen);
    const uint16_t before      = encoder_form_place(edges->place[0]);
    const float    per_gap_1ps = fpu_inverse(base_max(s->edge_gap_s, GAP_MIN_s));
    float          turned_rad  = 0.0f;

    if (edges->known >= 2U) {
        learn(edges, s, now, 0.5f * count_rad, LEARN_PERIODS * ts_s);
    }
    const float off_rad = edges->offset_rad[now];
    if (edges->known != 0U) {
        turned_rad = off_rad - edges->offset_rad[before];
    }
    edges->known         = (edges->known != 0U) ? 2U : 1U;
    edges->omega_e_radps = s->omega_e_radps;
    edges->per_gap_1ps   = per_gap_1ps;
    edges->place[1]      = before;
    edges->place[0]      = now;
    return off_rad + (turned_rad * base_min(s->edge_age_s * per_gap_1ps, WIDEST));
}

CTL_PART void encoder_form_skip(encoder_form_edges_t *edges)
{
    edges->known = 0U;
}

CTL_PART angle_gate_result_t encoder_form_innovation(angle_gate_t              *gate,
                                                     encoder_form_edges_t      *edges,
                                                     const angle_gate_config_t *c,
                                                     const drive_sample_t *s, const nodo_t *est,
                                                     float theta_hat_rad, float ts_s)
{
    const float         error_rad = encoder_form_error_rad(s, theta_hat_rad);
    angle_gate_result_t angle =
        angle_gate_pass(gate, c, s->theta_e_rad, error_rad, est->omega_e_radps, ts_s);

    if (!angle.used) {
        encoder_form_skip(edges);
    } else if (s->edge_gap_s > 0.0f) {
        angle.innovation_rad -= encoder_form_learn(edges, s, c->count_rad, ts_s);
    } else {
        /* no edge times */
    }
    return angle;
}
