/* SPDX-License-Identifier: MIT */
/**
 * @file law.h
 * @brief Interface of a control law: samples in, voltage out.
 *
 * Each law is a pair of files law_*.h, law_*.c with its constants, its state and one `law_t`. The
 * generated tables name the law and its constants (drive_config.h); only this law is linked.
 * drive_tick.c checks, limits and modulates independently of the law. docs/architecture.md
 * describes how to add one.
 */
#ifndef LAW_H
#define LAW_H

#include "base.h"
#include "fields.h"
#include "nodo.h"
#include "position_loop.h"
#include "sample.h"
#include "torque_loop.h"

struct drive_config;

/** The state of one law; laws.h lists them. */
typedef union law_state law_state_t;

/** A run follows this in place of a speed. There is one pointer for both, so that a speed run has
 * one comparison. */
typedef struct {
    const position_command_t *position; /**< reference position, or NULL */
    const torque_command_t   *torque;   /**< reference torque, if position is NULL */
} law_aim_t;

/** Inputs of a law in a period. */
typedef struct {
    const drive_sample_t *sample;          /**< every value in range */
    float                 command_e_radps; /**< reference speed, electrical, in range */
    const law_aim_t      *aim;             /**< NULL: the speed is commanded */
    dq_t                  v_V;      /**< realised part of the voltage computed a period ago: it acts
                                    from this instant on; zero at the start of a run */
    float                 derating; /**< unusable share of the current limit, 0 .. 1 */
} law_input_t;

/** Answer of a law. */
typedef struct {
    dq_t        v_V;       /**< requested voltage, before any limit; drive_tick() refuses a NaN */
    float       theta_rad; /**< angle in the middle of the period in which v_V acts, EQ-DRIVE-2 */
    nodo_meas_t now;       /**< speed and currents that the law acted on */
    dq_t        i_ref_A;   /**< current references; zero without a current loop */
    float    d_omega; /**< estimated disturbances as in nodo.h; zero without an observer of them */
    float    d_q;
    float    d_d;
    uint16_t ignored_angles;  /**< ignored samples of this run; zero without a gate */
    float    profile_e_radps; /**< speed of the reference; motion_watch uses it in a position run */
    bool     arrived;         /**< at the commanded position, where the reference rests */
    bool     waits;           /**< the position reference waits for a shaft that cannot follow */
    bool     without_angle;   /**< the encoder is lost; the law brakes without it */
    bool     plausible;       /**< false: the angle is wrong */
    bool predicted; /**< `now` is predicted for the instant at which v_V begins to act; d_q and d_d
                         adapt to the real motor within some ms */
} law_output_t;

typedef struct {
    /** true when all constants of the law are finite and within their documented ranges. Context:
     * init. */
    bool (*check)(const struct drive_config *config);

    /** Starts a run: takes over the sample, with zero disturbances. Context: control ISR. */
    void (*reset)(law_state_t *state, const struct drive_config *config,
                  const drive_sample_t *sample);

    /** Executes one period and sets every member of `out`. Context: control ISR, bounded. */
    void (*step)(law_state_t *state, const struct drive_config *config, const law_input_t *in,
                 law_output_t *out);

    /** Makes `to` and `constants` of `from`, for `ratio` times the drive's inertia within the
     * certified range. Returns that ratio. NULL: the law has one inertia. Context: background. */
    float (*believe)(struct drive_config *to, void *constants, const struct drive_config *from,
                     float ratio);

    /** Takes a running state from one inertia to another, without a bump. NULL with the one above.
     * Context: control ISR. */
    void (*adopt)(law_state_t *state, const struct drive_config *from,
                  const struct drive_config *to);

    /** True if loop counts and indexes in the constants are in range. NULL: there are none. It is
     * called
     *  in every period: a flipped bit there would cause an access outside the arrays. Context:
     *  control ISR. */
    bool (*counts_ok)(const struct drive_config *config);

    /** Visits all constants (fields.h). NULL: images are not supported. Context: init. */
    void (*fields)(fields_t *f, void *constants);

    bool takes_torque; /**< step() follows law_aim_t.torque, if the drive takes torques */

    uint16_t number; /**< identifies the law in an image, docs/architecture.md; 0: none */

    uint32_t constants_chars; /**< sizeof the constants, for a check sum; 0: unknown */
} law_t;

#endif /* LAW_H */
