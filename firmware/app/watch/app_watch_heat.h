/* SPDX-License-Identifier: MIT */
/**
 * @file app_watch_heat.h
 * @brief Thermal model (I^2 t) of motor and inverter, and the derating of the current limit.
 *
 *     x' = (i^2 / i_n^2 - x) / tau, for each                                          EQ-APP-HEAT-1
 *     derating = (1 - i_n / i_max) (x - 0.9) / 0.1, within 0 .. (1 - i_n / i_max)     EQ-APP-HEAT-2
 *     heat sink: (T - T_limit) / (T_trip - T_limit) / 2, held within 0 .. 1/2         EQ-APP-HEAT-3
 *
 * Here i is the length of the current vector and i_n the continuous current. The largest of the
 * three deratings acts. A drive that follows it stays below x = 1; x > 1.1 is a fault.
 */
#ifndef APP_WATCH_HEAT_H
#define APP_WATCH_HEAT_H

#include "base.h"

typedef struct {
    float motor_A;    /**< i_n, > 0 */
    float motor_s;    /**< tau, > 0 */
    float inverter_A; /**< the same of the inverter */
    float inverter_s;
} app_watch_heat_config_t;

typedef struct {
    float per_tick; /**< Ts / tau */
    float per_A2;   /**< 1 / i_n^2 */
    float most;     /**< 1 - i_n / i_max, or 0 */
    float x;
} app_watch_heat_part_t;

typedef struct {
    app_watch_heat_part_t motor;
    app_watch_heat_part_t inverter;
    float                 derating; /**< unusable share of the current limit */
} app_watch_heat_t;

/** @return CTL_BAD_CONFIG when a constant is out of range. Context: init, or the loader. */
ctl_status_t app_watch_heat_check(const app_watch_heat_config_t *config, float current_max_A,
                                  float ts_s);

/** @return Result of the check. After CTL_BAD_CONFIG h is unusable. Context: init. */
ctl_status_t app_watch_heat_init(app_watch_heat_t *h, const app_watch_heat_config_t *config,
                                 float current_max_A, float ts_s);

/**
 * @brief Executes one tick, in every mode.
 *
 * @param ia_A, ib_A Phase currents.
 * @param warmth     (T - T_limit) / (T_trip - T_limit) of the heat sink, any number.
 * @return false: x exceeds 1.1.
 *
 * Context: control ISR. No division.
 */
bool app_watch_heat_tick(app_watch_heat_t *h, float ia_A, float ib_A, float warmth);

#endif /* APP_WATCH_HEAT_H */
