/* SPDX-License-Identifier: MIT */
/**
 * @file app_angle_index.h
 * @brief Angle of a position, and the index mark. Internal to app_angle.h.
 */
#ifndef APP_ANGLE_INDEX_H
#define APP_ANGLE_INDEX_H

#include "app_angle.h"

#define APP_ANGLE_TURNS_MAX 128.0f /* above any number of electrical turns in a shaft turn */

/** An angle of at most a turn too much or too little, within 0 .. 2 pi. */
static inline float app_angle_in_turn(float theta_rad)
{
    if (fabsf(theta_rad - BASE_PI) < BASE_PI) { /* mostly, and in one comparison */
        return theta_rad;
    }
    if (theta_rad < 0.0f) {
        return theta_rad + BASE_TWO_PI;
    }
    return (theta_rad >= BASE_TWO_PI) ? (theta_rad - BASE_TWO_PI) : theta_rad;
}

/** Angle at `half` half counts past the lower edge of a position. Half counts are integers below
 * 2^23: removing whole turns from them is exact. The added half of a half count keeps the quotient
 * away from integers. With millions of half counts per turn rounding may still cross one;
 * app_angle_in_turn() corrects that. */
static inline float app_angle_at(const app_angle_t *a, uint16_t position_cnt, uint32_t half)
{
    const uint32_t from_zero_cnt =
        (position_cnt >= a->zero_cnt)
            ? ((uint32_t)position_cnt - (uint32_t)a->zero_cnt)
            : ((uint32_t)position_cnt + (uint32_t)a->positions - (uint32_t)a->zero_cnt);
    const uint32_t count    = ((2U * from_zero_cnt) + half) * (uint32_t)a->pole_pairs;
    const float    half_cnt = (float)count;
    const float   passed = base_min((half_cnt + 0.5f) * a->turns_per_half_cnt, APP_ANGLE_TURNS_MAX);
    const int16_t turns  = (int16_t)passed; /* at most the pole pairs */
    const float   part_cnt = half_cnt - ((float)turns * a->half_cnt_per_turn);

    return app_angle_in_turn(a->zero_theta_rad + (part_cnt * a->rad_per_half_cnt));
}

/** Takes an index pulse. @return false: it came at a wrong position. Context: control ISR, once in
 * a turn. */
bool app_angle_take_index(app_angle_t *a, uint16_t index_cnt);

/** EQ-APP-ANGLE-6, while correct_ticks is above 0. Context: control ISR, once per tick. */
void app_angle_approach(app_angle_t *a);

/** Counts by which the angle is too large until the correction ends. Context: control ISR. */
int16_t app_angle_left_cnt(const app_angle_t *a);

/** Angle of the zero after the correction, 0 .. 2 pi. */
static inline float app_angle_zero_rad(const app_angle_t *a)
{
    return (a->correct_ticks > 0U) ? a->config->index_theta_e_rad : a->zero_theta_rad;
}

#endif /* APP_ANGLE_INDEX_H */
