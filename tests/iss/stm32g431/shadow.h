/* SPDX-License-Identifier: MIT */
/**
 * @file shadow.h
 * @brief The application of the image, compiled for the host: its ticks, with the inputs of the
 * image's own.
 */
#ifndef SHADOW_H
#define SHADOW_H

#include "app_objects.h"
#include "app_status.h"
#include "board.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Inputs of a tick: from the background of the image and from its board. */
typedef struct {
    bool           has_command;
    app_objects_t  command;
    board_sample_t sample;
    uint16_t       board_faults;
} shadow_input_t;

/** Outputs of a tick, of the image or of the host. */
typedef struct {
    board_duty_t  duty;
    app_mode_t    mode;
    app_fault_t   fault;
    drive_state_t state;
    drive_fault_t drive_fault;
    dq_t          v_V;
    dq_t          i_ref_A;
    float         d_omega;
    float         d_q;
    float         d_d;
    bool          gate_on;
} shadow_output_t;

/** As main() of the image does it. */
bool            shadow_start(void);
shadow_output_t shadow_tick(const shadow_input_t *in);

#ifdef __cplusplus
}
#endif

#endif /* SHADOW_H */
