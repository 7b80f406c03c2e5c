/* SPDX-License-Identifier: MIT */
/**
 * @file law.h
 * @brief What turns samples into a voltage, as an object.
 *
 * Every law is a pair of files law_*.h, law_*.c with its own constants, its own state and one `law_t`. The generated
 * tables name the law and its constants (drive_config.h); only that one is then linked. drive_tick.c checks, limits
 * and modulates, and knows no law. How to add one: docs/architecture.md.
 */
#ifndef LAW_H
#define LAW_H

#include "base.h"
#include "fields.h"
#include "nodo.h"
#include "position_loop.h"
#include "sample.h"

struct drive_config;

/** The state of one law; laws.h lists them. */
typedef union law_state law_state_t;

/** What a law gets in a period. */
typedef struct {
    const drive_sample_t *sample;          /**< every value in range */
    float                 command_e_radps; /**< wanted electrical speed, in range */
    const position_command_t
         *position; /**< or a position, of drives that take them; NULL: the speed counts */
    dq_t  v_V;      /**< what the limits left of the voltage computed a period ago: in
                                    force from this instant on; zero at the start of a run */
    float derating; /**< share of the current limit that may not be used, 0 .. 1 */
} law_input_t;

/** What a law answers. */
typedef struct {
    dq_t        v_V;       /**< wanted voltage, before any limit; drive_tick() refuses a NaN */
    float       theta_rad; /**< of the middle of the period in which v_V acts, EQ-DRIVE-2 */
    nodo_meas_t now;       /**< speed and currents that the law acted on */
    dq_t        i_ref_A;   /**< current references; zero without a current loop */
    float d_omega; /**< estimated disturbances as in nodo.h; zero without an observer of them */
    float d_q;
    float d_d;
    uint16_t
        ignored_angles; /**< samples since the start of the run; zero where a law believes all */
    float
        profile_e_radps; /**< speed of the reference; on the way to a position the motion is judged by it */
    bool arrived;       /**< at the commanded position, where the reference rests */
    bool waits;         /**< the reference, for a shaft that cannot follow it to a position */
    bool without_angle; /**< the encoder is lost; the law goes on without it, for a stop */
    bool plausible;     /**< false: the angle cannot be right */
    bool
        predicted; /**< now is of the instant from which v_V acts, predicted with d_q and d_d, which take up within
                         some ms what the motor is other than believed */
} law_output_t;

typedef struct {
    /** true when all constants of the law are finite and within their documented ranges. Context: init. */
    bool (*check)(const struct drive_config *config);

    /** Start of a run: takes over the sample, knows nothing of any disturbance. Context: control ISR. */
    void (*reset)(law_state_t *state, const struct drive_config *config,
                  const drive_sample_t *sample);

    /** One period; sets every member of out, which is not read. Context: control ISR, bounded. */
    void (*step)(law_state_t *state, const struct drive_config *config, const law_input_t *in,
                 law_output_t *out);

    /** Whether the numbers in the constants that end loops and choose places are still in range: looked at in every period,
     * because a flipped bit there would lead outside the memory. NULL: there are none. Context: control ISR. */
    bool (*counts_ok)(const struct drive_config *config);

    /** Visits all constants (fields.h). NULL: they come compiled only. Context: init. */
    void (*fields)(fields_t *f, void *constants);

    uint16_t
        number; /**< by which an image of constants names its law, docs/architecture.md; 0: none */

    uint32_t constants_chars; /**< sizeof the constants, for a check sum of them; 0: not known */
} law_t;

#endif /* LAW_H */
