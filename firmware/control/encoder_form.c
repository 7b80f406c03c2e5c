/* SPDX-License-Identifier: MIT */
#include "encoder_form.h"

#include "check.h"

bool encoder_form_check(const encoder_form_limits_t *limits)
{
    return base_in_range(limits->angle_rad, 1.0e-6f, BASE_PI) && check_positive(limits->d_omega);
}

bool encoder_form_gains_check(const encoder_form_gains_t *gains)
{
    return base_in_range(gains->theta, 1.0e-6f, 1.0f) && check_positive(gains->omega_1ps) &&
           check_positive(gains->d_omega_1ps2) && check_positive(gains->count_rad);
}

/* 2 would explain all of the error by the acceleration. Chosen by simulation of a load step at standstill: settled after
 * 17 ms with 0.2, after 7 ms with 0.5, after 9 ms and with more noise with 1. */
#define D_OMEGA_SHARE 0.5f

float encoder_form_correct_rare(nodo_t *est, float *theta_hat_rad,
                                const encoder_form_gains_t *gains, float error_rad, float gap_s,
                                float ts_s)
{
    const float at_speed_1ps = fabsf(est->omega_e_radps) / (2.0f * gains->count_rad);
    const float per_s        = base_min(base_max(1.0f / gap_s, at_speed_1ps), 1.0f / ts_s);
    const float samples      = 1.0f / (per_s * ts_s);
    const float share = base_min(samples, D_OMEGA_SHARE * per_s * per_s / gains->d_omega_1ps2);
    const float theta = base_min(gains->theta * samples, 1.0f) - (share * gains->theta);
    const float omega = base_min(gains->omega_1ps * samples, per_s) - (share * gains->omega_1ps);

    est->omega_e_radps += omega * error_rad;
    *theta_hat_rad = frames_wrap(*theta_hat_rad + (theta * error_rad));
    return share;
}

void encoder_form_edges_reset(encoder_form_edges_t *edges)
{
    const encoder_form_edges_t nothing = {{0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f}, {0, 0}};

    *edges = nothing;
}

/* Chosen: known to a tenth within some tens of lines that were sampled at all of their edges. */
#define LEARN 0.02f

static float offset_of(const encoder_form_edges_t *edges, int16_t edge)
{
    return edges->offset_rad[edge - 1];
}

static void add_offset(encoder_form_edges_t *edges, int16_t edge, float step_rad, float most_rad)
{
    float *const at_rad = &edges->offset_rad[edge - 1];

    *at_rad = base_clamp(*at_rad + step_rad, -most_rad, most_rad);
}

static void learn(encoder_form_edges_t *edges, const drive_sample_t *s, float most_rad)
{
    const int16_t now      = s->edge_of_line;
    const int16_t before   = edges->edge[0];
    const int16_t first    = edges->edge[1];
    const float   bend_rad = frames_wrap(frames_wrap(s->theta_e_rad - edges->theta_rad[0]) -
                                         frames_wrap(edges->theta_rad[0] - edges->theta_rad[1]));
    const float   known_rad =
        offset_of(edges, now) - (2.0f * offset_of(edges, before)) + offset_of(edges, first);
    const float step_rad = LEARN * base_clamp(bend_rad - known_rad, -most_rad, most_rad);

    add_offset(edges, now, step_rad, most_rad);
    add_offset(edges, before, -2.0f * step_rad, most_rad);
    add_offset(edges, first, step_rad, most_rad);
}

float encoder_form_learn(encoder_form_edges_t *edges, const drive_sample_t *s, float count_rad)
{
    const bool timed = (s->edge_of_line >= 1) && (s->edge_of_line <= ENCODER_FORM_EDGES);

    if (timed && (edges->edge[0] != 0) && (edges->edge[1] != 0)) {
        learn(edges, s, 0.5f * count_rad);
    }
    edges->theta_rad[1] = edges->theta_rad[0];
    edges->edge[1]      = edges->edge[0];
    edges->theta_rad[0] = s->theta_e_rad;
    edges->edge[0]      = timed ? s->edge_of_line : 0;
    return timed ? offset_of(edges, s->edge_of_line) : 0.0f;
}
