/* SPDX-License-Identifier: MIT */
/**
 * @file commission_types.h
 * @brief Types shared by the stages of commissioning: limits, samples, requests, results.
 *
 * No motor data are known in advance. The stages find all of them.
 */
#ifndef COMMISSION_TYPES_H
#define COMMISSION_TYPES_H

#include "base.h"
#include "frames.h"

/** A search for a resonance begins here [Hz], as does an unknown coupling of a drive file. */
#define COMMISSION_RING_FROM_Hz 40.0f
#define COMMISSION_BINS         4 /**< current ranges of the inductance map */

/** Limits and data of the board. */
typedef struct {
    float   ts_s;              /**< control period, 1e-5 .. 1e-2 */
    float   current_max_A;     /**< limit of each phase current, > 0 */
    float   speed_max_m_radps; /**< limit of the mechanical speed, > 0 */
    float   dc_link_min_V;     /**< > 0 */
    float   dc_link_max_V;     /**< >= dc_link_min_V */
    int32_t counts_per_turn;   /**< of the encoder, four per line; 0: measured from the index */
} commission_config_t;

/** Measurements at the start of a period. */
typedef struct {
    float   ia_A; /**< phase current, positive into the motor */
    float   ib_A;
    float   dc_link_V;
    int32_t position_cnt; /**< multi-turn counter, wraps at 2^32 */
    int32_t index_cnt;    /**< position at the last index */
    bool    index_seen;   /**< an index came since the previous sample */
    bool    valid;
} commission_sample_t;

/** A processed sample, input of the stages. */
typedef struct {
    ab_t    i_A;
    ab_t    di_A; /**< change since the previous sample */
    ab_t    v_V;  /**< requested voltage that acted between the two samples */
    float   dc_link_V;
    int32_t position_cnt;
    int32_t index_cnt;
    bool    index_seen;
} commission_signal_t;

typedef enum { COMMISSION_BUSY = 0, COMMISSION_DONE, COMMISSION_FAILED } commission_step_t;

/** Request of a stage. */
typedef struct {
    ab_t              v_V; /**< for the period that begins at the next sample */
    ab_t              i_A; /**< expected current: gives the sign of the inverter loss */
    commission_step_t step;
} commission_answer_t;

/** A value and twice its standard deviation. */
typedef struct {
    float value;
    float error;
} commission_value_t;

/** Between motor and load, as COMMISSION_RING finds it. */
typedef enum {
    COMMISSION_COUPLING_UNKNOWN = 0, /**< not searched */
    COMMISSION_COUPLING_RIGID,       /**< no resonance in the range */
    COMMISSION_COUPLING_ELASTIC,     /**< the resonance is known */
    COMMISSION_COUPLING_BELOW,       /**< it is below the range */
    COMMISSION_COUPLING_ABOVE        /**< it is above the range */
} commission_coupling_t;

/** All results. Later stages use the results of earlier ones. */
typedef struct {
    commission_value_t    r_Ohm;
    commission_value_t    v_loss_V; /**< of one phase, by dead time and switches */
    commission_value_t    ld_H;     /**< mean up to the largest current used */
    commission_value_t    lq_H;
    commission_value_t    flux_Wb;
    commission_value_t    inertia_kgm2;
    commission_value_t    friction_Nms; /**< viscous */
    commission_value_t    coulomb_Nm;
    commission_value_t    offset_rad;   /**< electrical angle of the d axis at position 0 */
    commission_value_t    resonance_Hz; /**< of motor and load against each other; 0: not known */
    commission_value_t    damping;      /**< its damping ratio */
    commission_value_t    load_share;   /**< of the inertia, behind the coupling */
    float                 searched_Hz;  /**< from 40 Hz up to here, noise hid no resonance */
    commission_coupling_t coupling;
    float   odd_V;        /**< mean voltage with the current in LOOK: R i and inverter loss */
    float   ripple_rad;   /**< rms angle error along the turned vector: cogging, oscillation */
    float   lag_rad;      /**< lag behind the vector by friction */
    float   moved_rad;    /**< correction of the DRAG offset by SPIN */
    float   half_swing_s; /**< oscillation about a fixed vector; 0: none */
    int32_t counts_per_turn;
    int16_t direction; /**< 1: the position rises with the electrical angle, -1: it falls */
    int16_t pole_pairs;
    bool    reluctance; /**< no significant magnet */
    bool    indexed;    /**< index_cnt is valid */
    int32_t index_cnt;  /**< position of the index within a turn, 0 .. counts_per_turn - 1 */
} commission_result_t;

/** Waves of the map: along d; along q without d current, and with two negative ones. */
#define COMMISSION_MAP_WAVES 4
/** Rows of its bins: positive and negative d current; three of the q current. */
#define COMMISSION_MAP_ROWS 5
/** An inductance of the map that is equal to the mean. */
#define COMMISSION_MAP_ONE 8192U
/** Chosen: d current from one q wave to the next, in widths of a bin of the first one. Beside it the
 * q current is so much smaller that the vector has the same length. */
#define COMMISSION_MAP_BIAS 1.6f

/** Differential inductances over both currents, of the middle of each bin, in
 * 1 / COMMISSION_MAP_ONE of ld_H or lq_H of the result. 0: too few samples. */
typedef struct {
    uint16_t ld[2][COMMISSION_BINS]; /**< d current > 0 and < 0, no q current */
    uint16_t lq[3][COMMISSION_BINS]; /**< |q current|; beside it d currents of 0, -1, -2 biases */
    float    step_A; /**< width of a bin without the other current; 0: not measured */
} commission_map_t;

/* C++ includes this header: it needs the designated members in their order. */

/** Request of zero voltage. */
static inline commission_answer_t commission_rest(commission_step_t step)
{
    const commission_answer_t out = {{0.0f, 0.0f}, {0.0f, 0.0f}, step};
    return out;
}

/** Counts from b to a; the counter may wrap between them. */
static inline int32_t commission_moved_cnt(int32_t a, int32_t b)
{
    return (int32_t)((uint32_t)a - (uint32_t)b);
}

/** Number of periods in a time, at least one. */
static inline int32_t commission_ticks(float time_s, float ts_s)
{
    return (int32_t)base_clamp(time_s / ts_s, 1.0f, 1.0e9f); /* 1 for a NaN too */
}

#endif /* COMMISSION_TYPES_H */
