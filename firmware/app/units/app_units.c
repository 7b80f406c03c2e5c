/* SPDX-License-Identifier: MIT */
#include "app_units.h"

#include "app_position.h"

#define MOST_I32  2147483647LL
#define EUCLID_64 93U /* most steps for two numbers of 64 bits */

app_units_t app_units_default(void)
{
    const app_units_t u = {.feed_shaft = 1U, .gear_motor = 1U, .gear_shaft = 1U};

    return u;
}

static uint64_t divisor_of(uint64_t a, uint64_t b)
{
    uint64_t large = a;
    uint64_t small = b;

    for (uint16_t n = 0U; (n < EUCLID_64) && (small > 0U); n++) {
        const uint64_t rest = large % small;

        large = small;
        small = rest;
    }
    return (large > 0U) ? large : 1U;
}

bool app_units_reduce(const app_units_t *u, uint16_t positions, app_units_scale_t *scale)
{
    const uint64_t feed = (u->feed > 0U) ? u->feed : positions;
    const uint64_t up   = (uint64_t)positions * u->gear_motor * u->feed_shaft; /* below 2^48 */
    const uint64_t down = feed * u->gear_shaft;
    const bool     some = (up > 0U) && (down > 0U) && (u->feed <= APP_UNITS_FEED_MAX);
    const uint64_t by   = divisor_of(up, down);
    const uint64_t num  = up / by;
    const uint64_t den  = down / by;
    const uint64_t most = (uint64_t)MOST_I32;
    bool           ok   = false;

    if (some && (num > 0U) && (num <= most) && (den > 0U) && (den <= most)) {
        scale->num      = (uint32_t)num;
        scale->den      = (uint32_t)den;
        scale->reversed = (u->polarity & APP_UNITS_REVERSES_POSITION) != 0U;
        ok              = true;
    }
    return ok;
}

/* x num / den, rounded to the nearest and limited. Both factors are below 2^31. */
static int32_t rescaled(int32_t x, uint32_t num, uint32_t den, bool reversed)
{
    const int64_t  product = (int64_t)x * (int64_t)num;
    const uint32_t half    = den / 2U;
    const int64_t  away    = (product < 0) ? -(int64_t)half : (int64_t)half;
    const int64_t  by      = (int64_t)den;
    const int64_t  beyond  = product + away;
    const int64_t  rounded = (by == 1) ? beyond : (beyond / by); /* counts need no division */
    const int64_t  way     = reversed ? -rounded : rounded;
    const int64_t  up      = (way > MOST_I32) ? MOST_I32 : way;

    return (int32_t)((up < -MOST_I32) ? -MOST_I32 : up);
}

int32_t app_units_cnt(const app_units_scale_t *s, int32_t units)
{
    return rescaled(units, s->num, s->den, s->reversed);
}

int32_t app_units_of(const app_units_scale_t *s, int32_t counts)
{
    return rescaled(counts, s->den, s->num, s->reversed);
}

static bool is_near(const app_units_scale_t *s, int32_t units)
{
    const int32_t counts = app_units_cnt(s, units);

    return app_position_held(counts) == counts;
}

bool app_units_fit(const app_units_scale_t *s, const app_units_positions_t *p)
{
    return is_near(s, p->target) && is_near(s, p->offset) && is_near(s, p->least) &&
           is_near(s, p->most) && is_near(s, (int32_t)p->window) &&
           is_near(s, (int32_t)p->following_window) && is_near(s, p->home_offset);
}

uint32_t app_units_window_cnt(const app_units_scale_t *s, uint32_t units)
{
    const int32_t counts = rescaled((int32_t)units, s->num, s->den, false);

    return ((counts == 0) && (units > 0U)) ? 1U : (uint32_t)counts;
}

void app_units_apply(const app_units_scale_t *s, const app_units_positions_t *p, app_objects_t *o)
{
    const int32_t least_cnt = app_units_cnt(s, p->least);
    const int32_t most_cnt  = app_units_cnt(s, p->most);

    o->target_cnt           = app_units_cnt(s, p->target);
    o->offset_cnt           = app_units_cnt(s, p->offset);
    o->following_window_cnt = app_units_window_cnt(s, p->following_window);
    o->home_offset_cnt      = app_units_cnt(s, p->home_offset);
    o->reversed             = s->reversed;
    o->limits               = p->least < p->most;
    o->least_cnt            = s->reversed ? most_cnt : least_cnt;
    o->most_cnt             = s->reversed ? least_cnt : most_cnt;
}
