/* SPDX-License-Identifier: MIT */
/**
 * @file board_config.h
 * @brief A drive in encoder form for the unit tests: the numbers that
 *
 *     sdre-gains generate firmware/config/drives/ipmsm_390w_board.toml
 *
 * writes (fnv1a64:2800b27daa03fba6), copied as data.
 */
#ifndef BOARD_CONFIG_H
#define BOARD_CONFIG_H

#include "drive_config.h"

/* clang-format off */
static const drive_config_t board_config_drive = {
    .ts_s = 1.99999995e-04f,
    .trip_current_A = 8.00000000e+00f,
    .trip_speed_e_radps = 1.56900000e+03f,
    .trip_angle_rad = 4.49999988e-01f,
    .trip_d_omega = 2.70000000e+04f,
    .dc_link_min_V = 8.85000000e+01f,
    .dc_link_max_V = 3.98250000e+02f,
    .form = DRIVE_FORM_ENCODER,
    .motor = {
        .l1 = 2.75714282e+03f,
        .l2 = 2.38095239e-01f,
        .l3 = 4.76190479e+03f,
        .l4 = 2.17715740e+01f,
        .l5 = 1.69432008e+00f,
        .l6 = 8.77886009e+00f,
        .l7 = 3.30754852e+01f,
        .l8 = 1.33368902e+01f,
        .l9 = 1.51920509e+00f,
        .l10 = 6.58238947e-01f,
        .l11 = -5.56142883e+02f,
        .inv_l6 = 1.13909997e-01f,
        .inv_l8 = 7.49799982e-02f,
    },
    .current_ref = {
        .current_max_A = 4.00000000e+00f,
        .iq_max_A = 3.54717731e+00f,
        .mtpa_A = 2.47880816e+00f,
        .mtpa_exact = true,
        .voltage_share = 9.70000029e-01f,
        .torque_share = 1.00000000e+00f,
        .near_e_radps = 1.82178860e+01f,
        .l1_min = 1.37857141e+03f,
        .filter_per_period = 1.25000000e-01f,
        .filter_1ps = 6.25000000e+02f,
        .regen_max_W_norm = 9.73247600e+06f,
        .regen_start_V = 3.24500000e+02f,
        .regen_per_V = 2.25988701e-02f,
    },
    .dead_time = {
        .share = 1.49999997e-02f,
        .inv_fade_1pA = 1.00000000e+01f,
    },
    .nosc = {
        .order = 2,
        .iq_error_max_A = 2.37500000e+00f,
        .lambda = {
            { /* n = 0 */
                /*          omega_e_radps             iq_A             id_A */
                /* v_q */ {  1.18947304e+02f,  2.70871033e+02f,  0.00000000e+00f },
                /* v_d */ {  0.00000000e+00f,  0.00000000e+00f,  8.78867569e+01f },
            },
            { /* n = 1 */
                /*          omega_e_radps             iq_A             id_A */
                /* v_q */ {  0.00000000e+00f,  0.00000000e+00f, -3.30265312e+01f },
                /* v_d */ { -2.91517887e+01f, -5.01740761e+01f,  0.00000000e+00f },
            },
            { /* n = 2 */
                /*          omega_e_radps             iq_A             id_A */
                /* v_q */ { -3.56609821e+00f, -8.70203304e+00f,  0.00000000e+00f },
                /* v_d */ {  0.00000000e+00f,  0.00000000e+00f,  7.41690683e+00f },
            },
        },
    },
    .nodo_encoder = {
        .order = 2,
        .iq_max_A = 8.00000000e+00f,
        .gain = {
            { /* n = 0 */
                /*                     iq_A             id_A      theta_e_rad */
                /* d_w */ { -5.04458906e+05f,  0.00000000e+00f,  1.03723104e+09f },
                /* d_q */ {  9.10098600e+06f,  0.00000000e+00f,  3.43331100e+06f },
                /* d_d */ {  0.00000000e+00f,  9.10182100e+06f,  0.00000000e+00f },
                /* w   */ {  1.23142859e+03f,  0.00000000e+00f,  3.73058950e+06f },
                /* iq  */ {  6.47952393e+03f,  0.00000000e+00f, -2.09289169e+02f },
                /* id  */ {  0.00000000e+00f,  6.46872119e+03f,  0.00000000e+00f },
                /* theta*/ { -2.69818872e-01f,  0.00000000e+00f,  2.73150562e+03f },
            },
            { /* n = 1 */
                /*                     iq_A             id_A      theta_e_rad */
                /* d_w */ {  0.00000000e+00f,  4.69901344e+05f,  0.00000000e+00f },
                /* d_q */ {  0.00000000e+00f,  9.10973450e+02f,  0.00000000e+00f },
                /* d_d */ {  6.44375366e+02f,  0.00000000e+00f, -3.19816475e+06f },
                /* w   */ {  0.00000000e+00f,  9.10615479e+02f,  0.00000000e+00f },
                /* iq  */ {  0.00000000e+00f,  1.51969209e-01f,  0.00000000e+00f },
                /* id  */ {  1.51969209e-01f,  0.00000000e+00f,  3.43943085e+02f },
                /* theta*/ {  0.00000000e+00f,  4.43416834e-01f,  0.00000000e+00f },
            },
            { /* n = 2 */
                /*                     iq_A             id_A      theta_e_rad */
                /* d_w */ {  1.79767990e+01f,  0.00000000e+00f, -8.25556094e+04f },
                /* d_q */ {  3.66927348e-02f,  0.00000000e+00f, -1.69188721e+02f },
                /* d_d */ {  0.00000000e+00f, -7.24407104e+02f,  0.00000000e+00f },
                /* w   */ {  4.17535454e-02f,  0.00000000e+00f, -2.40863983e+02f },
                /* iq  */ { -6.13841303e-06f,  0.00000000e+00f,  2.10912526e-02f },
                /* id  */ {  0.00000000e+00f,  8.96272212e-02f,  0.00000000e+00f },
                /* theta*/ {  2.71911722e-05f,  0.00000000e+00f, -1.16094723e-01f },
            },
        },
    },
};
/* clang-format on */

#endif /* BOARD_CONFIG_H */
