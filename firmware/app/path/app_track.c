/* SPDX-License-Identifier: MIT */
#include "app_track.h"

#include "fpu.h"

#define FILTER_RADPS 120.0f /* w_0, chosen by simulation: a 1 Hz sine keeps its place */

#define SIXTH     0.166666667f
#define TURN_PART (1.0f / BASE_TWO_PI)
#define WAY_MOST  1.0e6f

#define CLOCK_SHARE 0.03125f /* as of the last of APP_TRACK_KNOWN */
#define EARLY_MOST  1.0f     /* periods by which a set-point may be early */

/* A set-point that no shaft could reach in the time is a step. */
#define STEP_SHARE 2.0f

/* Chosen by simulation: set-points in a row after which the motion is taken for a cubic again. */
#define REGULAR 4U

#define ON_CUBIC 2U /* predicted set-points in a row */

/* One more, at most so many. */
static uint16_t one_more(uint16_t n, uint16_t most)
{
    return (n < most) ? (uint16_t)(n + 1U) : n;
}

void app_track_start(app_track_t *t)
{
    t->age_s   = 0.0f;
    t->taken   = 0U;
    t->missed  = 0U;
    t->regular = REGULAR;
    t->s[0]    = 0.0f;
    t->s[1]    = 0.0f;
    t->s[2]    = 0.0f;
}

position_t app_track_moved(const position_t *p, float by_rad)
{
    /* a NaN ends here: it shows in the speed */
    const float   way_rad = base_clamp(by_rad, -WAY_MOST, WAY_MOST);
    const int32_t turns   = (int32_t)(way_rad * TURN_PART);
    const int64_t sum     = (int64_t)p->turns + turns;
    position_t    at      = *p;

    if ((sum <= POSITION_TURNS_MAX) && (sum >= -POSITION_TURNS_MAX)) {
        at.turns = (int32_t)sum;
    }
    const float half_rad = 0.5f * (way_rad - (BASE_TWO_PI * (float)turns));

    at = position_moved(&at, half_rad); /* half a turn at most */
    return position_moved(&at, half_rad);
}

/* EQ-APP-TRACK-1: the cubic a period later. */
static void step_cubic(app_track_t *t)
{
    t->at = app_track_moved(&t->at, t->s[0] + t->s[1] + t->s[2]);
    t->s[0] += (2.0f * t->s[1]) + (3.0f * t->s[2]);
    t->s[1] += 3.0f * t->s[2];
}

static void limit(app_track_t *t, const app_track_limits_t *l)
{
    const float way_rad   = l->period_s * l->speed_e_radps;
    const float bend_rad  = 0.5f * l->period_s * l->period_s * l->accel_e_radps2;
    const float third_rad = SIXTH * 4.0f * bend_rad; /* from one limit to the other in a period */

    t->s[0] = base_clamp(t->s[0], -way_rad, way_rad);
    t->s[1] = base_clamp(t->s[1], -bend_rad, bend_rad);
    t->s[2] = base_clamp(t->s[2], -third_rad, third_rad);
}

void app_track_predict(app_track_t *t, const app_track_limits_t *l)
{
    if (t->missed >= ON_CUBIC) {
        t->s[1] = 0.0f;
        t->s[2] = 0.0f;
    }
    step_cubic(t);
    limit(t, l);
    t->age_s -= l->period_s;
    t->missed = one_more(t->missed, UINT16_MAX);
}

/* EQ-APP-TRACK-4 */
static float pole(float period_s)
{
    const float z = period_s * FILTER_RADPS;

    return fpu_inverse(1.0f + (z * (1.0f + (0.5f * z))));
}

/* EQ-APP-TRACK-2. The first ones find a line and a parabola. */
static void correct_cubic(app_track_t *t, float off_rad, float p)
{
    const float d = 1.0f - p;
    float gain[4] = {1.0f - (p * p * p * p), SIXTH * d * d * (11.0f + (p * (14.0f + (11.0f * p)))),
                     d * d * d * (1.0f + p), SIXTH * d * d * d * d};
    const float first[3][3] = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {1.5f, 0.5f, 0.0f}};

    if (t->taken < 3U) {
        gain[0] = 1.0f;
        for (uint16_t n = 0U; n < 3U; n++) {
            gain[n + 1U] = first[t->taken][n];
        }
    }
    t->at = app_track_moved(&t->at, gain[0] * off_rad);
    for (uint16_t n = 0U; n < 3U; n++) {
        t->s[n] += gain[n + 1U] * off_rad;
    }
}

/* EQ-APP-TRACK-3 */
static void correct_both(app_track_t *t, float off_rad, float way_rad, float p)
{
    const float d = 1.0f - p;
    const float q = way_rad - t->s[0];

    t->at = app_track_moved(&t->at, ((t->taken < 3U) ? 1.0f : d) * off_rad);
    if (t->taken < 2U) {
        t->s[0] += q;
        if (t->taken > 0U) {
            t->s[1] += 0.5f * q;
        }
    } else {
        t->s[0] += (1.0f - (p * p * p)) * q;
        t->s[1] += 0.75f * d * d * (1.0f + p) * q;
        t->s[2] += SIXTH * d * d * d * q;
    }
}

/* EQ-APP-TRACK-5 */
static void correct_line(app_track_t *t, float off_rad, float periods, float p)
{
    const float d = 1.0f - p;

    t->at = app_track_moved(&t->at, (1.0f - (p * p)) * off_rad);
    t->s[0] += d * d * off_rad * fpu_inverse(periods);
}

/* A motion with a gap is a line: what bends it would be multiplied with each further one. */
static void correct_motion(app_track_t *t, float off_rad, const app_track_point_t *point,
                           const app_track_limits_t *l, float periods)
{
    const bool  line = t->regular < REGULAR;
    const float p    = pole(periods * l->period_s);

    if (point->given) {
        correct_both(t, off_rad, l->period_s * point->omega_e_radps, p);
    } else if (line) {
        correct_line(t, off_rad, periods, p);
    } else {
        correct_cubic(t, off_rad, p);
    }
    if (line) {
        t->s[1] = 0.0f;
        t->s[2] = 0.0f;
    }
}

/* Advances to the period of a set-point that came now. One that was predicted meanwhile is late.
 * Returns the periods since the one before, at least 1. */
static uint16_t count_points(app_track_t *t, const app_track_limits_t *l)
{
    const float period_s = l->period_s;
    uint16_t    periods  = t->missed;

    if ((t->missed == 0U) || (t->age_s > (0.5f * period_s))) {
        step_cubic(t);
        t->age_s -= period_s;
        periods = one_more(periods, UINT16_MAX);
    }
    const float share =
        (t->taken < APP_TRACK_KNOWN) ? fpu_inverse((float)t->taken + 1.0f) : CLOCK_SHARE;

    t->age_s = base_clamp(t->age_s * (1.0f - share), -EARLY_MOST * period_s, period_s);
    return periods;
}

void app_track_take(app_track_t *t, const app_track_point_t *point, const app_track_limits_t *l)
{
    float    off_rad = 0.0f;
    uint16_t periods = 1U;

    if (t->taken > 0U) {
        periods    = count_points(t, l);
        t->regular = (periods > 1U) ? 0U : one_more(t->regular, REGULAR);
        off_rad    = position_way_rad(&t->at, &point->at);
    }
    if ((t->taken == 0U) || !base_within(off_rad, STEP_SHARE * l->period_s * l->speed_e_radps)) {
        const float age_s = (t->taken > 0U) ? t->age_s : 0.0f;

        app_track_start(t);
        t->age_s = age_s;
        t->at    = point->at;
        off_rad  = 0.0f;
        periods  = 1U;
    }
    correct_motion(t, off_rad, point, l, (float)periods);
    limit(t, l);
    t->missed = 0U;
    t->taken  = one_more(t->taken, APP_TRACK_KNOWN);
}
