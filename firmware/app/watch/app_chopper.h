/* SPDX-License-Identifier: MIT */
/**
 * @file app_chopper.h
 * @brief Brake chopper: a resistor across the dc link, switched by the measured voltage.
 *
 *     on above on_cnt, off at or below off_cnt, off without a valid sample    EQ-APP-CHOPPER-1
 *     x' = (s v^2 / (R P) - x) / tau, s: share of the time that it was on      EQ-APP-CHOPPER-2
 *
 * Here x is the heat of the resistor: 1 is that of its rated power P. It works in every mode, also
 * with an open bridge: a fast motor charges the link through the diodes.
 *
 * Two conditions keep the resistor off. Heat above 1 does until x is at most 0.9. A resistor that
 * was on for a second without a pause stays off until the link is at or below off_cnt. Then the
 * supply holds the link up, or the resistor is broken.
 *
 * Firmware for a board without a chopper has none of this code: BOARD_CHOPPER is 0.
 */
#ifndef APP_CHOPPER_H
#define APP_CHOPPER_H

#include "base.h"
#include "board.h"

/** EQ-BOARD-7. Without a chopper all are 0. */
typedef struct {
    uint16_t on_cnt;  /**< converter codes of the dc link */
    uint16_t off_cnt; /**< > 0, < on_cnt */
    float    per_V2;  /**< 1 / (R P), > 0 */
    float    tau_s;   /**< of the resistor, > 0 */
} app_chopper_config_t;

typedef enum {
    APP_CHOPPER_NONE = 0, /**< the board has none, or its constants were refused */
    APP_CHOPPER_OFF,
    APP_CHOPPER_ON,
    APP_CHOPPER_HOT,  /**< kept off until the resistor has cooled */
    APP_CHOPPER_STUCK /**< kept off until the link has fallen */
} app_chopper_state_t;

/**
 * @param wanted        The board has a chopper.
 * @param dc_link_V_per_cnt Voltage of a code.
 * @param dc_link_max_V Trip level of the drive; on_cnt is below.
 * @param turn_s        Time between two calls of app_chopper_turn().
 * @return CTL_BAD_CONFIG when a constant is out of range.
 *
 * Context: init, or the loader.
 */
ctl_status_t app_chopper_check(const app_chopper_config_t *config, bool wanted,
                               float dc_link_V_per_cnt, float dc_link_max_V, float turn_s);

#if BOARD_CHOPPER

typedef struct {
    uint16_t on_cnt;   /**< in force: that of the board, or a code that never comes */
    uint16_t off_cnt;  /**< the same */
    uint16_t on_ticks; /**< periods with the resistor on; wraps */
    bool     on;
    bool     present;
    bool     hot;
    bool     stuck;
    uint16_t board_on_cnt;
    uint16_t board_off_cnt;
    uint16_t seen_on_ticks; /**< on_ticks of the last turn */
    uint32_t seen_ticks;    /**< number of its period */
    float    per_tick;      /**< Ts / tau */
    float    per_V2;
    float    heat;    /**< x */
    float    stuck_s; /**< on without a pause */
    float    ts_s;
} app_chopper_t;

/** @param config NULL: no chopper, the resistor stays off. Context: init. */
void app_chopper_init(app_chopper_t *c, const app_chopper_config_t *config, float ts_s);

/**
 * @brief EQ-APP-CHOPPER-1 for the sample of this period.
 * @return true: the resistor is to be on until the next sample.
 *
 * Context: control ISR. No float.
 */
static inline bool app_chopper_tick(app_chopper_t *c, const board_sample_t *raw)
{
    const uint16_t above_cnt = c->on ? c->off_cnt : c->on_cnt;

    c->on = raw->valid && (raw->dc_link_cnt > above_cnt);
    if (c->on) {
        c->on_ticks = (uint16_t)(c->on_ticks + 1U);
    }
    return c->on;
}

/**
 * @brief EQ-APP-CHOPPER-2 and the conditions that keep the resistor off. Slow work, app_slow.h.
 *
 * @param raw       Valid sample of this period.
 * @param dc_link_V The same voltage.
 * @param ticks     Number of this period.
 *
 * Context: control ISR. No division.
 */
void app_chopper_turn(app_chopper_t *c, const board_sample_t *raw, float dc_link_V, uint32_t ticks);

/** Context: background. */
app_chopper_state_t app_chopper_state(const volatile app_chopper_t *c);

#endif

#endif /* APP_CHOPPER_H */
