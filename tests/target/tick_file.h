/* SPDX-License-Identifier: MIT */
/**
 * @file tick_file.h
 * @brief Recorded control periods, for replay on another machine.
 *
 * A file of runs: tick_file_run_t, then its ticks; a run of no ticks ends the file. Host and Cortex-M4F lay
 * these structures out alike (little-endian, four-byte floats and enumerations); `layout` holds what could
 * differ with `tick_size`, and the reader refuses a file in which they are not its own.
 */
#ifndef TICK_FILE_H
#define TICK_FILE_H

#include <stddef.h>

#include "drive_tick.h"
#include "sil/eval/pi_foc_tick.h"

#define TICK_FILE_NAME_SIZE 64

/** The drive's constants up to the pointers to the law and its own, which the two machines cannot share. */
#define TICK_FILE_CONFIG_SIZE (offsetof(drive_config_t, hardware) + sizeof(drive_hardware_t))

/** What the two machines must agree on, as numbers. */
#define TICK_FILE_LAYOUT                                                                           \
    ((uint32_t)TICK_FILE_CONFIG_SIZE + ((uint32_t)offsetof(drive_config_t, motor) << 16))
#define TICK_FILE_TICK_SIZE ((uint32_t)sizeof(tick_file_tick_t))

/** The laws that are replayed, an image each. */
typedef enum {
    TICK_FILE_NOC = 0,
    TICK_FILE_NOC_SPEED,
    TICK_FILE_NOC_H,
    TICK_FILE_CONVENTIONAL,
    TICK_FILE_NOC_SHAFT
} tick_file_law_t;

/** The constants of any of them. */
typedef union {
    law_noc_config_t          noc;
    law_noc_speed_config_t    noc_speed;
    law_noc_h_config_t        noc_h;
    law_conventional_config_t conventional;
    law_noc_shaft_config_t    noc_shaft;
} tick_file_constants_t;

enum {
    TICK_FILE_VALID    = 1,
    TICK_FILE_RUN      = 2,
    TICK_FILE_GATE     = 4,
    TICK_FILE_POSITION = 8,
    TICK_FILE_TORQUE   = 16
};

typedef struct {
    char     name[TICK_FILE_NAME_SIZE];
    uint32_t layout;
    uint32_t run_size; /**< of this structure; with tick_size all a reader has to know of layouts */
    uint32_t tick_size;
    uint32_t law;   /**< tick_file_law_t */
    uint32_t order; /**< highest of the series in use */
    uint32_t ticks;
    uint32_t config[TICK_FILE_CONFIG_SIZE / sizeof(uint32_t)];
    pi_foc_gains_t        pi;
    tick_file_constants_t constants;
} tick_file_run_t;

/** The core's memory that changes, without the pointers, which the two machines cannot share. */
typedef struct {
    drive_state_t   state;
    drive_fault_t   fault;
    law_state_t     law;
    law_output_t    answer;
    dq_t            v_V;
    uint32_t        v_limited;
    abc_t           i_hat_A;
    current_gate_t  current_gate;
    current_watch_t current_watch;
    motion_watch_t  motion_watch;
} tick_file_drive_t;

/**
 * One period: the core before it, what it was given, and what it and the plain PI-FOC answered on the host.
 * Every period starts from the host's memory: a controller with integral action drifts when it is played
 * back without its plant, so that a long replay would compare nothing.
 */
typedef struct {
    tick_file_drive_t  drive;
    position_command_t position; /**< with TICK_FILE_POSITION */
    torque_command_t   torque;   /**< with TICK_FILE_TORQUE */
    float              ia_A;
    float              ib_A;
    float              dc_link_V;
    float              theta_e_rad;
    float              band_rad;
    float              edge_gap_s;
    float              edge_age_s;
    float              omega_e_radps;
    float              command_e_radps;
    float              derating;
    abc_t              duty;
    abc_t              pi_duty;
    uint32_t
        flags; /**< TICK_FILE_VALID, TICK_FILE_RUN, of the answer TICK_FILE_GATE, and the edge's place in the pattern */
} tick_file_tick_t;

/** The edge's place in the pattern, 0 .. 16, in the flags. */
#define TICK_FILE_EDGE_SHIFT 8u
#define TICK_FILE_EDGE_MASK  31u

/** What the replay answers to one tick. */
typedef struct {
    uint32_t timer;    /**< counts of the timer during drive_tick() */
    uint32_t pi_timer; /**< during pi_foc_tick() */
    uint32_t flags;    /**< TICK_FILE_GATE */
    abc_t    duty;
    abc_t    pi_duty;
} tick_file_result_t;

static inline tick_file_drive_t tick_file_from_drive(const drive_t *d)
{
    tick_file_drive_t x;

    x.state         = d->state;
    x.fault         = d->fault;
    x.law           = d->law;
    x.answer        = d->answer;
    x.v_V           = d->v_V;
    x.v_limited     = d->v_limited ? 1u : 0u;
    x.i_hat_A       = d->i_hat_A;
    x.current_gate  = d->current_gate;
    x.current_watch = d->current_watch;
    x.motion_watch  = d->motion_watch;
    return x;
}

/** Into a drive that drive_init() has bound to its constants. */
static inline void tick_file_to_drive(const tick_file_drive_t *x, drive_t *d)
{
    d->state         = x->state;
    d->fault         = x->fault;
    d->law           = x->law;
    d->answer        = x->answer;
    d->v_V           = x->v_V;
    d->v_limited     = x->v_limited != 0u;
    d->i_hat_A       = x->i_hat_A;
    d->current_gate  = x->current_gate;
    d->current_watch = x->current_watch;
    d->motion_watch  = x->motion_watch;
}

#endif /* TICK_FILE_H */
