/* SPDX-License-Identifier: MIT */
/**
 * @file commission_types.h
 * @brief What the stages of a commissioning share: what the board knows, what is measured, asked for and found.
 *
 * Of the motor nothing is known here: no resistance, inductance, flux, inertia, friction, pole pairs, direction or offset.
 */
#ifndef COMMISSION_TYPES_H
#define COMMISSION_TYPES_H

#include "base.h"
#include "frames.h"

#define COMMISSION_BINS 4 /**< of the inductance over the current, to the largest used */

/** What the board knows. */
typedef struct {
    float   ts_s;              /**< control period, 1e-5 .. 1e-2 */
    float   current_max_A;     /**< no phase current may be larger, > 0 */
    float   speed_max_m_radps; /**< no mechanical speed may be larger, > 0 */
    float   dc_link_min_V;     /**< > 0 */
    float   dc_link_max_V;     /**< >= dc_link_min_V */
    int32_t counts_per_turn;   /**< of the encoder, four per line; 0: found with the index */
} commission_config_t;

/** Measured at the start of a period. */
typedef struct {
    float   ia_A; /**< phase current, positive into the motor */
    float   ib_A;
    float   dc_link_V;
    int32_t position_cnt; /**< of a counter that goes on at the end of a turn; wraps at 2^32 */
    int32_t index_cnt;    /**< position at the last index */
    bool    index_seen;   /**< an index came since the sample before */
    bool    valid;
} commission_sample_t;

/** A sample as the stages see it. */
typedef struct {
    ab_t    i_A;
    ab_t    di_A; /**< change since the sample before */
    ab_t    v_V;  /**< in force between the two samples, as it was asked for */
    float   dc_link_V;
    int32_t position_cnt;
    int32_t index_cnt;
    bool    index_seen;
} commission_signal_t;

typedef enum { COMMISSION_BUSY = 0, COMMISSION_DONE, COMMISSION_FAILED } commission_step_t;

/** What a stage asks for. */
typedef struct {
    ab_t              v_V; /**< for the period that begins at the next sample */
    ab_t              i_A; /**< expected in it: the sign of what the inverter loses */
    commission_step_t step;
} commission_answer_t;

/** A value and twice its standard deviation. */
typedef struct {
    float value;
    float error;
} commission_value_t;

/** Everything found. Later stages use what earlier ones found. */
typedef struct {
    commission_value_t r_Ohm;
    commission_value_t v_loss_V; /**< that a phase loses by dead time and switches */
    commission_value_t ld_H;     /**< mean up to the largest current used */
    commission_value_t lq_H;
    commission_value_t flux_Wb;
    commission_value_t inertia_kgm2;
    commission_value_t friction_Nms; /**< viscous */
    commission_value_t coulomb_Nm;
    commission_value_t offset_rad; /**< electrical angle of the d axis at position 0 */
    float              ld_map_H[2][COMMISSION_BINS]; /**< differential, d current > 0 and < 0 */
    float              lq_map_H[COMMISSION_BINS];
    float              map_step_A; /**< width of a bin */
    float   ripple_rad;   /**< rms of the angle's way along the turned vector: cogging, swinging */
    float   lag_rad;      /**< by which friction holds it behind the vector */
    float   moved_rad;    /**< by which the run corrected the offset of the drag */
    float   half_swing_s; /**< of the rotor about a standing vector; 0: it does not swing */
    int32_t counts_per_turn;
    int16_t direction; /**< 1: the position rises with the electrical angle, -1: it falls */
    int16_t pole_pairs;
    bool    reluctance; /**< without a magnet that counts */
    bool    indexed;    /**< index_cnt is that of an index */
    int32_t index_cnt;  /**< position of the index within a turn, 0 .. counts_per_turn - 1 */
} commission_result_t;

/* In C and C++: members are set in their order. */

/** No voltage. */
static inline commission_answer_t commission_rest(commission_step_t step)
{
    const commission_answer_t out = {{0.0f, 0.0f}, {0.0f, 0.0f}, step};
    return out;
}

/** Counts from b to a; a counter may wrap. */
static inline int32_t commission_moved_cnt(int32_t a, int32_t b)
{
    return (int32_t)((uint32_t)a - (uint32_t)b);
}

/** Periods in a time, at least one. */
static inline int32_t commission_ticks(float time_s, float ts_s)
{
    const float ticks = time_s / ts_s;
    return (ticks >= 1.0f) ? (int32_t)base_min(ticks, 1.0e9f) : (int32_t)1;
}

#endif /* COMMISSION_TYPES_H */
