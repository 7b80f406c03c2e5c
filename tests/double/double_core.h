/* SPDX-License-Identifier: MIT */
/**
 * @file double_core.h
 * @brief The control core in double precision, behind types that do not say `float`. One drive at a time.
 */
#ifndef DOUBLE_CORE_H
#define DOUBLE_CORE_H

#ifdef __cplusplus
extern "C" {
#endif

enum { DOUBLE_SHIPPED, DOUBLE_SPEED, DOUBLE_CONVENTIONAL, DOUBLE_HARMONIC };

/** drive_sample_t and drive_command_t. */
typedef struct {
    double ia_A;
    double ib_A;
    double dc_link_V;
    double theta_e_rad;
    double omega_e_radps;
    double band_rad;
    double edge_gap_s;
    double edge_age_s;
    int    edge_of_pattern;
    int    valid;
    double command_e_radps;
} double_in_t;

typedef struct {
    double duty[3];
    int    gate;
} double_out_t;

/** Tables with the numbers of the single-precision ones. @return 0: refused. */
int double_core_start(int tables);

/** With run commanded. */
double_out_t double_core_tick(const double_in_t *in);

#ifdef __cplusplus
}
#endif

#endif /* DOUBLE_CORE_H */
