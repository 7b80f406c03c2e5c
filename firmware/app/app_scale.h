/* SPDX-License-Identifier: MIT */
/**
 * @file app_scale.h
 * @brief Converts raw codes to SI units.
 *
 *     i = A_per_cnt (code - zero),   v_dc = V_per_cnt code                     EQ-APP-SCALE-1
 *
 * The zero of each current is measured with the bridge off, and trimmed in a run (app_trim.h). The
 * temperature is interpolated linearly in a table over the code: the curve of an NTC at a divider
 * would need a logarithm.
 */
#ifndef APP_SCALE_H
#define APP_SCALE_H

#include "app_options.h"
#include "app_part.h"
#include "base.h"
#include "board.h"

typedef struct {
    float        current_A_per_cnt; /**< > 0 */
    float        current_zero_cnt;  /**< code of no current, nominal */
    float        offset_max_cnt;    /**< largest accepted deviation of a measured zero, > 0 */
    float        dc_link_V_per_cnt; /**< > 0 */
    uint16_t     ntc_first_cnt;     /**< code of the first point */
    uint16_t     ntc_step_cnt;      /**< codes from point to point, > 0 */
    uint16_t     ntc_points;        /**< >= 2; the last point is below BOARD_ADC_CODES */
    const float *ntc_degC;          /**< temperature of each point, strictly falling */
} app_scale_config_t;

typedef struct {
    const app_scale_config_t *config;
    float                     inv_ntc_step;
    float                     zero_a_cnt;
    float                     zero_b_cnt;
#if APP_TRIM
    float a_A_per_cnt; /**< of phase a, > 0 */
    float b_A_per_cnt; /**< of phase b, > 0 */
#endif
    float    dc_link_V_per_cnt;
    uint16_t positions;
} app_scale_t;

/** Samples in SI units; all zero unless valid. */
typedef struct {
    float ia_A;
    float ib_A;
    float dc_link_V;
    bool  valid;             /**< marked valid by the board, and no code out of range */
    bool  temperature_valid; /**< the code is within the table: no broken or shorted sensor */
    float temperature_degC;  /**< of app_scale_temperature(), 0 unless temperature_valid */
} app_scale_sample_t;

/**
 * @param trip_current_A Must be in the converter's range at the worst accepted zero.
 * @return CTL_BAD_CONFIG when a constant is out of range. Context: init, or the loader.
 */
ctl_status_t app_scale_check(const app_scale_config_t *config, float trip_current_A);

/**
 * @param positions      Encoder positions per turn. A sample with a larger position is invalid.
 * @param trip_current_A As for app_scale_check().
 * @return Result of app_scale_check(). After CTL_BAD_CONFIG s is unusable.
 *
 * Context: init.
 */
ctl_status_t app_scale_init(app_scale_t *s, const app_scale_config_t *config, uint16_t positions,
                            float trip_current_A);

/**
 * @brief Sets the zeros to the mean of `count` codes per phase, taken without current.
 * @return false: a mean differs from the nominal zero by more than offset_max_cnt; zeros unchanged.
 *
 * Context: control ISR, once.
 */
bool app_scale_set_zero(app_scale_t *s, uint32_t sum_a_cnt, uint32_t sum_b_cnt, uint16_t count);

#if APP_TRIM
/**
 * @brief Moves the zeros, and sets the share of the gains.
 *
 * The gain of the sensor that reads less is raised, so that no reading becomes smaller.
 *
 * @param a_A  Moves the zero of phase a by this current, b_A that of phase b.
 * @param gain Gain of sensor a less the gain of sensor b, as ratios.
 * @return false: a zero would differ from the nominal one by more than offset_max_cnt, or a value
 *         is not finite. Nothing has changed.
 *
 * Context: background, while the tick measures no zeros. The tick reads each member at once.
 */
bool app_scale_trim(volatile app_scale_t *s, float a_A, float b_A, float gain);
#endif

/** All but the temperature. Context: control ISR. No division. */
APP_MEASURE_PART void app_scale_sample(const app_scale_t *s, const board_sample_t *raw,
                                       app_scale_sample_t *out);

/** Temperature of a sample that app_scale_sample() has found valid or not. Context: control ISR.
 * No division. */
void app_scale_temperature(const app_scale_t *s, const board_sample_t *raw,
                           app_scale_sample_t *out);

#endif /* APP_SCALE_H */
