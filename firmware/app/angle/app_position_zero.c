/* SPDX-License-Identifier: MIT */
#include "app_position.h"

#include "app_angle_index.h"
#include "frames.h"

#define TURNS_NEAR 64.0f /* most electrical turns in a shaft turn */

void app_position_init(app_position_t *p, const app_angle_t *angle)
{
    const position_t origin = {0, 0.0f};

    p->pole_pairs  = angle->pole_pairs;
    p->positions   = angle->positions;
    p->rad_per_cnt = angle->rad_per_cnt;
    p->actual      = origin;
    p->zero        = origin;
    p->have        = false;
    p->known       = false;
    p->homed       = false;
}

void app_position_set_zero(app_position_t *p, const position_t *zero)
{
    p->zero  = *zero;
    p->homed = true;
}

void app_position_forget(app_position_t *p)
{
    p->known = false;
}

/* Nearest integer, limited to +-most. */
static int32_t rounded(float x, float most)
{
    float beyond = base_clamp(x, -most, most) + 0.5f;

    if (x < 0.0f) {
        beyond -= 1.0f;
    }
    return (int32_t)beyond;
}

void app_position_find_zero(app_position_t *p, const app_angle_t *angle)
{
    const int16_t turned_cnt =
        app_angle_turned_cnt(angle->positions, angle->zero_cnt, angle->before_cnt);
    const float middle_rad = app_angle_zero_rad(angle) + (0.5f * p->rad_per_cnt); /* below 3 pi */
    const float theta_rad  = frames_wrap(middle_rad);
    const float way_rad    = (float)turned_cnt * p->rad_per_cnt;
    const float turns      = (p->actual.theta_e_rad - theta_rad - way_rad) * (1.0f / BASE_TWO_PI);

    p->zero.turns       = p->actual.turns + rounded(turns, TURNS_NEAR);
    p->zero.theta_e_rad = theta_rad;
    p->known            = true;
    p->homed            = false;
}

/* Removes whole shaft turns first: the rest is below one turn, and no product overflows. */
position_t app_position_at(const app_position_t *p, int32_t counts)
{
    const int32_t per_turn = (int32_t)p->positions;
    const int32_t pairs    = (int32_t)p->pole_pairs;
    const int32_t turns_m  = counts / per_turn;
    const int32_t rest     = (counts % per_turn) * pairs;
    const int32_t turns_e  = rest / per_turn;
    const int32_t left     = rest % per_turn;
    const float   part     = (float)left / (float)per_turn; /* within +-1 */
    position_t    at       = {p->zero.turns + (turns_m * pairs) + turns_e, p->zero.theta_e_rad};

    at = position_moved(&at, 0.5f * BASE_TWO_PI * part); /* half of it at a time */
    return position_moved(&at, 0.5f * BASE_TWO_PI * part);
}

int32_t app_position_cnt(const app_position_t *p, const position_t *at)
{
    if (p->pole_pairs == 0U) {
        return 0L; /* no sample yet */
    }
    const int32_t per_turn = (int32_t)p->positions;
    const int32_t pairs    = (int32_t)p->pole_pairs;
    const int32_t turns_e  = at->turns - p->zero.turns;
    const int32_t turns_m  = turns_e / pairs;
    const int32_t left     = turns_e % pairs;
    const float   rest_rad = (BASE_TWO_PI * (float)left) + (at->theta_e_rad - p->zero.theta_e_rad);
    const float   rest     = rest_rad / p->rad_per_cnt;
    const int32_t most     = APP_POSITION_CNT_MAX / per_turn;

    if (turns_m > most) {
        return APP_POSITION_CNT_MAX;
    }
    if (turns_m < -most) {
        return -APP_POSITION_CNT_MAX;
    }
    return (turns_m * per_turn) + rounded(rest, (float)per_turn);
}
