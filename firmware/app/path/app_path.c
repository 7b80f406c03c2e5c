/* SPDX-License-Identifier: MIT */
#include "app_path.h"

#include "fpu.h"

#define LONGEST_s  100.0f /* of a piece */
#define SIXTH      0.166666667f
#define LOOKS      5U /* instants at which a piece is compared with the limits */
#define LOOK_EACH  0.25f
#define LONGER     1.5f
#define SPEED_PART 0.95f /* of the limit, at the end of a piece: the rest of it can be faster */

/* Where the path is and how it moves. */
typedef struct {
    float way_rad;
    float omega;
    float accel;
    float jerk;
} moment_t;

void app_path_end(app_path_t *p)
{
    p->begun     = false;
    p->aim.fresh = false;
    p->lost      = false;
    p->deviates  = false;
    p->beyond_s  = 0.0f;
}

static moment_t moment(const float c[6], float u, float per_s)
{
    const moment_t m = {
        .way_rad = u * (c[1] + (u * (c[2] + (u * (c[3] + (u * (c[4] + (u * c[5])))))))),
        .omega   = per_s *
                 (c[1] + (u * ((2.0f * c[2]) +
                               (u * ((3.0f * c[3]) + (u * ((4.0f * c[4]) + (u * 5.0f * c[5])))))))),
        .accel =
            per_s * per_s *
            ((2.0f * c[2]) + (u * ((6.0f * c[3]) + (u * ((12.0f * c[4]) + (u * 20.0f * c[5])))))),
        .jerk =
            per_s * per_s * per_s * ((6.0f * c[3]) + (u * ((24.0f * c[4]) + (u * 60.0f * c[5]))))};
    return m;
}

static bool is_allowed(const app_path_aim_t *a, const float c[6], float per_s)
{
    bool ok = true;

    for (uint16_t n = 0U; n < LOOKS; n++) {
        const moment_t m = moment(c, LOOK_EACH * (float)n, per_s);

        ok = ok && base_within(m.omega, a->track.speed_e_radps) &&
             base_within(m.accel, a->track.accel_e_radps2) && base_within(m.jerk, a->jerk_e_radps3);
    }
    return ok;
}

static void set_piece(app_path_t *p, const position_t *from, const float c[6], float per_s)
{
    p->from  = *from;
    p->u     = 0.0f;
    p->per_s = per_s;
    for (uint16_t n = 0U; n < 6U; n++) {
        p->c[n] = c[n];
    }
}

/* A piece on which the acceleration ends, and then the speed stays. */
static void go_further(app_path_t *p, const position_t *at, const moment_t *now, float ts_s)
{
    const float ends_s   = fabsf(now->accel) * fpu_inverse(p->aim.jerk_e_radps3);
    const bool  steady   = ends_s < ts_s;
    const float length_s = steady ? LONGEST_s : base_min(ends_s, LONGEST_s);
    const float a        = steady ? 0.0f : (now->accel * length_s * length_s);
    const bool  rests    = steady && (p->track.taken == 0U) && p->begun;
    const float v        = rests ? 0.0f : (now->omega * length_s);
    const float c[6]     = {0.0f, v, 0.5f * a, -SIXTH * a, 0.0f, 0.0f};

    set_piece(p, at, c, fpu_inverse(length_s));
    p->leads = false;
}

/* The motion at the end of a piece: a cubic for a short while, and a line after that. */
static moment_t goal_of(const app_path_t *p, const position_t *at, const moment_t *now,
                        float length_s)
{
    const app_track_t *t     = &p->track;
    const float        per_s = fpu_inverse(p->aim.track.period_s);
    const float        most  = SPEED_PART * p->aim.track.speed_e_radps;
    const float        x     = p->late_s * per_s;
    moment_t           goal  = {.way_rad = 0.5f * now->omega * length_s};

    if (t->taken > 0U) {
        const bool  near = p->late_s <= APP_PATH_SHORTEST_s;
        const float s_2  = near ? t->s[1] : 0.0f;
        const float s_3  = near ? t->s[2] : 0.0f;
        const float w    = per_s * (t->s[0] + (x * ((2.0f * s_2) + (x * 3.0f * s_3))));

        goal.way_rad = position_way_rad(at, &t->at) + (x * (t->s[0] + (x * (s_2 + (x * s_3)))));
        goal.omega   = base_clamp(w, -most, most);
        goal.accel   = per_s * per_s * ((2.0f * s_2) + (x * 6.0f * s_3));
    }
    return goal;
}

/* EQ-APP-PATH-1. False: it is beyond the limits, and the old piece stays. */
static bool begin_piece(app_path_t *p, const position_t *at, const moment_t *now, float length_s)
{
    const moment_t goal  = goal_of(p, at, now, length_s);
    const float    per_s = fpu_inverse(length_s);
    const float    v     = now->omega * length_s;
    const float    a     = now->accel * length_s * length_s;
    const float    h     = goal.way_rad - v - (0.5f * a);
    const float    w     = (goal.omega * length_s) - v - a;
    const float    b     = (goal.accel * length_s * length_s) - a;
    const float    c[6]  = {0.0f,
                            v,
                            0.5f * a,
                            (10.0f * h) - (4.0f * w) + (0.5f * b),
                            (7.0f * w) - (15.0f * h) - b,
                            (6.0f * h) - (3.0f * w) + (0.5f * b)};
    const bool     ok    = is_allowed(&p->aim, c, per_s);

    if (ok) {
        set_piece(p, at, c, per_s);
        p->leads = true;
    }
    return ok;
}

static void start_path(app_path_t *p, const position_t *actual, float ts_s)
{
    const float    most  = SPEED_PART * p->aim.track.speed_e_radps;
    const float    omega = base_clamp(p->aim.start_e_radps, -most, most);
    const moment_t now   = {.omega = omega};

    p->from = app_track_moved(actual, ts_s * omega);
    app_track_start(&p->track);
    go_further(p, &p->from, &now, ts_s);
    p->late_s = 0.0f;
    p->due    = true;
    p->begun  = true;
}

/* Set-points, and those that have not come. */
static void track(app_path_t *p, float ts_s)
{
    const app_track_limits_t *l = &p->aim.track;
    app_track_t              *t = &p->track;

    t->age_s += ts_s;
    if (p->aim.fresh) {
        p->late_s -= (t->missed == 0U) ? l->period_s : 0.0f;
        app_track_take(t, &p->aim.point, l);
        p->due  = true;
        p->lost = false;
    } else if ((t->taken > 0U) && (t->age_s >= l->period_s)) {
        p->late_s -= l->period_s;
        app_track_predict(t, l);
        p->due = true;
    } else {
        /* on the way */
    }
    p->aim.fresh = false;
    p->late_s    = base_max(p->late_s, base_max(APP_PATH_SHORTEST_s - l->period_s, 0.0f));

    const float silent_s = (l->period_s * (float)t->missed) + t->age_s;

    p->lost = p->lost || ((t->taken > 0U) &&
                          (silent_s >= base_max(APP_PATH_RUN_ON * l->period_s, APP_PATH_RUN_ON_s)));
}

/* Begins the piece that is due. With an early set-point it waits for the end of the one before. */
static void plan_piece(app_path_t *p, const position_t *at, const moment_t *now, float ts_s)
{
    const float period_s = p->aim.track.period_s;
    const float length_s =
        base_clamp((period_s - p->track.age_s) + p->late_s, 2.0f * ts_s, LONGEST_s);

    const bool waits = p->leads && (p->track.age_s <= (-0.5f * ts_s)) && (p->u < 1.0f);

    if (p->due && !waits) {
        p->due = !begin_piece(p, at, now, length_s);
        p->late_s += p->due ? ((LONGER - 1.0f) * length_s) : 0.0f;
    }
}

static void watch_deviation(app_path_t *p, const position_t *actual, const position_t *at,
                            float ts_s)
{
    const bool inside =
        !(p->aim.window_rad > 0.0f) || base_within(position_way_rad(actual, at), p->aim.window_rad);

    p->beyond_s = inside ? 0.0f : (p->beyond_s + ts_s);
    p->deviates = p->deviates || (!inside && (p->beyond_s >= p->aim.time_out_s));
}

/* A NaN stays one, which the drive refuses. */
static float limited(float omega, float most)
{
    const float up = (omega > most) ? most : omega;

    return (up < -most) ? -most : up;
}

void app_path_tick(app_path_t *p, const position_t *actual, float ts_s, position_motion_t *out)
{
    if (!p->begun) {
        start_path(p, actual, ts_s);
    } else {
        p->u += ts_s * p->per_s;
    }
    const float most = p->aim.track.speed_e_radps;
    moment_t    now  = moment(p->c, p->u, p->per_s);
    position_t  at   = app_track_moved(&p->from, now.way_rad);

    track(p, ts_s);
    plan_piece(p, &at, &now, ts_s);
    if (p->u >= 1.0f) {
        go_further(p, &at, &now, ts_s);
    }
    out->at                  = at;
    out->omega_e_radps       = limited(now.omega, most);
    out->omega_dot_e_radps2  = now.accel;
    out->omega_2dot_e_radps3 = now.jerk;
    watch_deviation(p, actual, &at, ts_s);
}
