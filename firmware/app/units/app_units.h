/* SPDX-License-Identifier: MIT */
/**
 * @file app_units.h
 * @brief The operator's unit of position, sense of rotation and position limits, by CiA 402.
 *
 *     counts = units N (gear_motor / gear_shaft) (feed_shaft / feed)               EQ-APP-UNITS-1
 *
 * N is the number of encoder counts in a turn of the motor. The gear ratio is 6091h, the feed
 * constant is 6092h. A feed of 0 means N: then the unit is a count, seen through the gear.
 *
 * Both directions round to the nearest. A position in units that are not finer than counts comes
 * back unchanged.
 */
#ifndef APP_UNITS_H
#define APP_UNITS_H

#include "app_objects.h"

/** Bits of the polarity, 607Eh: what counts the other way. */
#define APP_UNITS_REVERSES_POSITION 0x80U
#define APP_UNITS_REVERSES_SPEED    0x40U
#define APP_UNITS_REVERSES_TORQUE   0x20U

/** Largest feed. */
#define APP_UNITS_FEED_MAX 1000000000UL

typedef struct {
    uint32_t feed;       /**< units in feed_shaft turns of the shaft; 0: counts of the encoder */
    uint16_t feed_shaft; /**< >= 1, as the next two */
    uint16_t gear_motor; /**< turns of the motor in gear_shaft turns of the shaft */
    uint16_t gear_shaft;
    uint16_t polarity;
} app_units_t;

/** EQ-APP-UNITS-1 as one fraction in its lowest terms. */
typedef struct {
    uint32_t num; /**< 1 .. 2^31 - 1, as the next */
    uint32_t den;
    bool     reversed; /**< positions count the other way */
} app_units_scale_t;

/** Positions as the operator gives them. */
typedef struct {
    int32_t  target;
    int32_t  offset;
    int32_t  least; /**< software limits; none unless least < most */
    int32_t  most;
    uint16_t window;           /**< of "target reached" */
    uint32_t following_window; /**< 0: any */
    int32_t  home_offset;
} app_units_positions_t;

/** Units that are counts. */
app_units_t app_units_default(void);

/**
 * @brief Reduces the fraction.
 *
 * @param u         Units.
 * @param positions Encoder counts in a turn of the motor, >= 1.
 * @param scale     Result; unchanged after false.
 * @return false: a factor is out of range, or the fraction has too many digits.
 *
 * Context: background. At most 93 divisions of 64 bits.
 */
bool app_units_reduce(const app_units_t *u, uint16_t positions, app_units_scale_t *scale);

/** Counts of a position, limited to 32 bits. Context: background. */
int32_t app_units_cnt(const app_units_scale_t *s, int32_t units);

/** Position of counts, limited to 32 bits. Context: background. */
int32_t app_units_of(const app_units_scale_t *s, int32_t counts);

/** True if no position of the operator leads beyond APP_POSITION_CNT_MAX. Context: background. */
bool app_units_fit(const app_units_scale_t *s, const app_units_positions_t *p);

/** Counts of a window, which has no sense: at least 1, but 0 of 0. Context: background. */
uint32_t app_units_window_cnt(const app_units_scale_t *s, uint32_t units);

/** Puts the positions into the objects as counts. Context: background. */
void app_units_apply(const app_units_scale_t *s, const app_units_positions_t *p, app_objects_t *o);

#endif /* APP_UNITS_H */
