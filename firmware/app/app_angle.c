/* SPDX-License-Identifier: MIT */
#include "app_angle.h"

#include "board.h"
#include "nodo_encoder.h"

#define HALF_COUNTS (2U * BOARD_POSITIONS) /* half counts per mechanical turn */
#define POLE_PAIRS  64U                    /* keeps half counts times pole pairs within 32 bits */

ctl_status_t app_angle_init(app_angle_t *a, const app_angle_config_t *c, float ts_s)
{
    const bool ok = (c->pole_pairs >= 1U) && (c->pole_pairs <= POLE_PAIRS) &&
                    base_in_range(c->index_theta_e_rad, 0.0f, BASE_TWO_PI) &&
                    (c->index_theta_e_rad < BASE_TWO_PI) &&
                    (c->index_correct_max_cnt >= c->index_tolerance_cnt) &&
                    (c->index_correct_max_cnt < (BOARD_POSITIONS / 4U)) &&
                    base_in_range(ts_s, 1.0e-5f, 1.0e-2f);

    a->config           = c;
    a->rad_per_half_cnt = BASE_TWO_PI / (float)HALF_COUNTS;
    a->radps_per_cnt    = ok ? (2.0f * (float)c->pole_pairs * a->rad_per_half_cnt / ts_s) : 0.0f;
    a->reference        = APP_ANGLE_NONE;
    a->zero_cnt         = 0U;
    a->zero_theta_rad   = 0.0f;
    a->before_cnt       = 0U;
    a->have_before      = false;
    a->corrections      = 0U;
    return ok ? CTL_OK : CTL_BAD_CONFIG;
}

int16_t app_angle_turned_cnt(uint16_t from_cnt, uint16_t to_cnt)
{
    int32_t turned_cnt = (int32_t)to_cnt - (int32_t)from_cnt;

    if (turned_cnt > (int32_t)(BOARD_POSITIONS / 2U)) {
        turned_cnt -= (int32_t)BOARD_POSITIONS;
    } else if (turned_cnt < -(int32_t)(BOARD_POSITIONS / 2U)) {
        turned_cnt += (int32_t)BOARD_POSITIONS;
    }
    return (int16_t)turned_cnt;
}

/* Angle at `half` half counts past the lower edge of a position; whole half counts, so that the wrap is exact. */
static float theta_at(const app_angle_t *a, uint16_t position_cnt, uint32_t half)
{
    const uint32_t from_zero_cnt =
        (position_cnt >= a->zero_cnt)
            ? ((uint32_t)position_cnt - (uint32_t)a->zero_cnt)
            : ((uint32_t)position_cnt + (uint32_t)BOARD_POSITIONS - (uint32_t)a->zero_cnt);
    const uint32_t half_counts =
        (((2U * from_zero_cnt) + half) * (uint32_t)a->config->pole_pairs) % HALF_COUNTS;
    const float theta_rad = a->zero_theta_rad + ((float)half_counts * a->rad_per_half_cnt);

    return (theta_rad >= BASE_TWO_PI) ? (theta_rad - BASE_TWO_PI) : theta_rad;
}

static void refer_to_index(app_angle_t *a, uint16_t index_cnt)
{
    a->reference      = APP_ANGLE_INDEX;
    a->zero_cnt       = index_cnt;
    a->zero_theta_rad = a->config->index_theta_e_rad;
}

/* How far the index is from where the reference in use expects it, in counts. Alignment knows the electrical
 * angle only, not which of the pole pairs it is. */
static float index_error_cnt(const app_angle_t *a, uint16_t index_cnt)
{
    if (a->reference == APP_ANGLE_INDEX) {
        return (float)app_angle_turned_cnt(a->zero_cnt, index_cnt);
    }
    const float error_rad = frames_wrap(theta_at(a, index_cnt, 0U) - a->config->index_theta_e_rad);
    return error_rad / (2.0f * (float)a->config->pole_pairs * a->rad_per_half_cnt);
}

/* False when the index came where it cannot be. */
static bool take_index(app_angle_t *a, uint16_t index_cnt)
{
    if (a->reference == APP_ANGLE_NONE) {
        refer_to_index(a, index_cnt);
        return true;
    }
    const float most_cnt  = (float)a->config->index_correct_max_cnt;
    const float small_cnt = (float)a->config->index_tolerance_cnt;
    const float error_cnt = index_error_cnt(a, index_cnt);
    if (!base_in_range(error_cnt, -most_cnt, most_cnt)) {
        return false;
    }
    if (a->reference == APP_ANGLE_ALIGNED) {
        refer_to_index(a, index_cnt);
    } else if (!base_in_range(error_cnt, -small_cnt, small_cnt)) {
        refer_to_index(a, index_cnt);
        a->corrections = (uint16_t)(a->corrections + 1U);
    }
    return true;
}

app_angle_reading_t app_angle_update(app_angle_t *a, uint16_t position_cnt, bool index_seen,
                                     uint16_t index_cnt)
{
    app_angle_reading_t reading = {.theta_e_rad   = 0.0f,
                                   .omega_e_radps = 0.0f,
                                   .speed_valid   = a->have_before,
                                   .index_fault   = false};

    if (a->have_before) {
        reading.omega_e_radps =
            (float)app_angle_turned_cnt(a->before_cnt, position_cnt) * a->radps_per_cnt;
    }
    a->before_cnt  = position_cnt;
    a->have_before = true;

    if (index_seen && !take_index(a, index_cnt)) {
        reading.index_fault = true;
        a->reference        = APP_ANGLE_NONE;
    }
    reading.theta_e_rad = theta_at(a, position_cnt, 1U);
    return reading;
}

void app_angle_align(app_angle_t *a, uint16_t position_cnt)
{
    a->reference      = APP_ANGLE_ALIGNED;
    a->zero_cnt       = position_cnt;
    a->zero_theta_rad = 0.0f;
}

void app_angle_drop(app_angle_t *a)
{
    a->reference   = APP_ANGLE_NONE;
    a->have_before = false;
}
