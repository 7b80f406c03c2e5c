/* SPDX-License-Identifier: MIT */
#include "position_ref.h"

#include "fpu.h"

/* Steps of false position. With one, the end takes some periods longer; more than two give no gain
 * (docs/equations.md). */
#define PASSES 2

/* Planned share of deceleration and jerk. Chosen: the reserve of 1 % corrects the rounding errors
 * of a long motion. */
#define PLANNED 0.99f

/* Acceleration at the limit of the current, of the profile's: the profile uses half of the torque.
 * Chosen: a tenth of the torque stays for the feedback. */
#define REACH_RATIO 1.8f

/* Chosen: a profile keeps a twentieth of its acceleration, so that every motion ends. */
#define REACH_LEAST 0.05f

#define THIRD 0.333333333f
#define SIXTH 0.166666667f

/* A reference and its remaining distance, positive towards the target. */
typedef struct {
    float way_rad;
    float omega;
    float accel;
} motion_t;

/* The profile, and the limits used for planning. */
typedef struct {
    const position_profile_t *profile;
    float                     jerk; /* planned, as the next three */
    float                     decel;
    float                     per_jerk;
    float                     per_decel;
    float                     ts_s;
} limits_t;

void position_ref_start(position_ref_t *r, const position_t *at, float omega_e_radps,
                        float omega_dot_e_radps2)
{
    r->at                  = *at;
    r->omega_e_radps       = omega_e_radps;
    r->omega_dot_e_radps2  = omega_dot_e_radps2;
    r->omega_2dot_e_radps3 = 0.0f;
    r->reach_e_radps2      = 0.0f;
    r->d_rest_e_radps2     = 0.0f;
    r->jerk_share          = 1.0f;
    r->arrived             = false;
    r->waits               = false;
}

/* EQ-POSITION-REACH-1, 2. No reach is known in the first period of a run. */
static void update_reach(position_ref_t *r, float now, float way_rad,
                         const position_torque_t *torque, float per_inertia)
{
    if (r->arrived || (r->reach_e_radps2 <= 0.0f)) {
        r->d_rest_e_radps2 = torque->d_omega;
        r->jerk_share      = per_inertia;
        r->reach_e_radps2  = now;
    } else if (fabsf(now * way_rad) >= (r->omega_e_radps * r->omega_e_radps)) {
        r->reach_e_radps2 = base_min(r->reach_e_radps2, now);
    } else {
        /* brakes, or soon will: the way to rest must not grow */
    }
}

position_profile_t position_ref_profile(position_ref_t *r, const position_profile_t *asked,
                                        const position_profile_t *most, const position_t *target,
                                        const position_torque_t *torque)
{
    const float rest        = r->d_rest_e_radps2;
    const float known       = (1.0f - torque->inertia) * r->omega_dot_e_radps2; /* EQ-INERTIA-1 */
    const float per_inertia = fpu_inverse(base_max(torque->inertia, 1.0f));
    const float full        = REACH_RATIO * torque->share * most->accel_e_radps2;
    const float left        = full - fabsf(rest) - fabsf(torque->d_omega - rest - known);
    const float now =
        base_clamp(left * per_inertia, REACH_LEAST * most->accel_e_radps2, most->accel_e_radps2);

    update_reach(r, now, position_way_rad(&r->at, target), torque, per_inertia);
    const position_profile_t p = {
        .speed_e_radps  = base_min(asked->speed_e_radps, most->speed_e_radps),
        .accel_e_radps2 = base_min(asked->accel_e_radps2, r->reach_e_radps2),
        .decel_e_radps2 =
            base_min(asked->decel_e_radps2, base_min(most->decel_e_radps2, r->reach_e_radps2)),
        .jerk_e_radps3 = base_min(asked->jerk_e_radps3, r->jerk_share * most->jerk_e_radps3)};
    return p;
}

/* s_1 of EQ-POSITION-REF-1. */
static float braking_way_rad(const limits_t *l, float omega)
{
    return ((omega * l->jerk) <= (l->decel * l->decel))
               ? (omega * fpu_root(omega * l->per_jerk))
               : (0.5f * omega * ((omega * l->per_decel) + (l->decel * l->per_jerk)));
}

/* EQ-POSITION-REF-1 */
static float stopping_way_rad(const limits_t *l, float omega, float accel)
{
    const float rest = omega + (0.5f * accel * fabsf(accel) * l->per_jerk);
    const float sign = (rest < 0.0f) ? -1.0f : 1.0f;
    const float w    = sign * omega;
    const float a    = sign * accel;
    const float t    = a * l->per_jerk;
    const float w_1  = base_max(w + (0.5f * a * t), 0.0f);

    return sign * ((t * (w + (THIRD * a * t))) + braking_way_rad(l, w_1));
}

/* Distance covered in a period with a jerk. */
static float covered_rad(const limits_t *l, const motion_t *m, float jerk)
{
    return l->ts_s * (m->omega + (l->ts_s * ((0.5f * m->accel) + (SIXTH * l->ts_s * jerk))));
}

/* State after a period with a jerk. */
static motion_t after(const limits_t *l, const motion_t *m, float jerk)
{
    const float    step = l->ts_s * jerk;
    const motion_t out  = {.way_rad = m->way_rad - covered_rad(l, m, jerk),
                           .omega   = m->omega + (l->ts_s * (m->accel + (0.5f * step))),
                           .accel   = m->accel + step};
    return out;
}

/* Remaining distance minus stopping distance. */
static float spare_rad(const limits_t *l, const motion_t *m)
{
    return m->way_rad - stopping_way_rad(l, m->omega, m->accel);
}

/* Acceleration that ends at the speed limit: EQ-SPEED-REF-1 for a period of constant jerk. */
static float accel_to_limit(const limits_t *l, const motion_t *m)
{
    const float missing = l->profile->speed_e_radps -
                          (m->omega + (0.5f * l->ts_s * m->accel)); /* half a period later */
    const float half = 0.5f * l->ts_s * l->profile->jerk_e_radps3;
    const float accel =
        fpu_root((half * half) + (2.0f * l->profile->jerk_e_radps3 * fabsf(missing))) - half;

    return (missing < 0.0f) ? -accel : accel;
}

/* EQ-POSITION-REF-2: the jerk of this period. */
static float next_jerk(const limits_t *l, const motion_t *m)
{
    const float jerk  = l->profile->jerk_e_radps3;
    const float per_s = fpu_inverse(l->ts_s);
    const float most  = (m->omega < 0.0f) ? l->profile->decel_e_radps2 : l->profile->accel_e_radps2;
    const float up    = base_min(accel_to_limit(l, m), most);
    float       high  = base_clamp((up - m->accel) * per_s, -jerk, jerk);
    float       low =
        base_min(base_clamp((-l->profile->decel_e_radps2 - m->accel) * per_s, -jerk, jerk), high);
    motion_t then       = after(l, m, high);
    float    spare_high = spare_rad(l, &then);
    if (spare_high >= 0.0f) {
        return high;
    }
    then            = after(l, m, low);
    float spare_low = spare_rad(l, &then);
    if (spare_low <= 0.0f) {
        return low;
    }
    for (int16_t pass = 0; pass < PASSES;
         pass++) { /* false position, Illinois variant: a retained end counts half */
        const float between =
            low + ((high - low) * spare_low * fpu_inverse(spare_low - spare_high));
        then              = after(l, m, between);
        const float spare = spare_rad(l, &then);
        if (spare >= 0.0f) {
            low       = between;
            spare_low = spare;
            spare_high *= 0.5f;
        } else {
            high       = between;
            spare_high = spare;
            spare_low *= 0.5f;
        }
    }
    return low + ((high - low) * spare_low * fpu_inverse(spare_low - spare_high));
}

/* True if one period of jerk ends the motion. */
static bool is_there(const limits_t *l, const motion_t *m)
{
    const float a = l->ts_s * l->profile->jerk_e_radps3;

    return base_within(m->accel, a) && base_within(m->omega, l->ts_s * a) &&
           base_within(m->way_rad, l->ts_s * l->ts_s * a);
}

static void arrive(position_ref_t *r, const position_t *target, float ts_s)
{
    r->omega_2dot_e_radps3 = -r->omega_dot_e_radps2 * fpu_inverse(ts_s);
    r->at                  = *target;
    r->omega_e_radps       = 0.0f;
    r->omega_dot_e_radps2  = 0.0f;
    r->arrived             = true;
}

static void advance(position_ref_t *r, const limits_t *l, const motion_t *now, float sign)
{
    const float    jerk = next_jerk(l, now);
    const motion_t then = after(l, now, jerk);

    r->at                  = position_moved(&r->at, sign * covered_rad(l, now, jerk));
    r->omega_e_radps       = sign * then.omega;
    r->omega_dot_e_radps2  = sign * then.accel;
    r->omega_2dot_e_radps3 = sign * jerk;
    r->arrived             = false;
}

/* Holds the reference near a shaft that cannot follow. */
static void hold_near(position_ref_t *r, const position_t *is, float near_rad)
{
    const float ahead = position_way_rad(is, &r->at);

    r->waits = !base_within(ahead, near_rad);
    if (r->waits) {
        r->at      = position_moved(is, (ahead < 0.0f) ? -near_rad : near_rad);
        r->arrived = false;
    }
}

void position_ref_update(position_ref_t *r, const position_profile_t *profile,
                         const position_t *target, const position_t *is, float near_rad, float ts_s)
{
    const float    jerk  = PLANNED * profile->jerk_e_radps3;
    const float    decel = PLANNED * profile->decel_e_radps2;
    const limits_t l     = {.profile   = profile,
                            .jerk      = jerk,
                            .decel     = decel,
                            .per_jerk  = fpu_inverse(jerk),
                            .per_decel = fpu_inverse(decel),
                            .ts_s      = ts_s};
    const motion_t seen  = {.way_rad = position_way_rad(&r->at, target),
                            .omega   = r->omega_e_radps,
                            .accel   = r->omega_dot_e_radps2};
    const float    sign  = (spare_rad(&l, &seen) < 0.0f) ? -1.0f : 1.0f;
    const motion_t now   = {
          .way_rad = sign * seen.way_rad, .omega = sign * seen.omega, .accel = sign * seen.accel};

    if (is_there(&l, &now)) {
        arrive(r, target, ts_s);
    } else {
        advance(r, &l, &now, sign);
    }
    hold_near(r, is, near_rad);
}

void position_ref_take(position_ref_t *r, const position_motion_t *motion, const position_t *is,
                       float near_rad)
{
    r->at                  = motion->at;
    r->omega_e_radps       = motion->omega_e_radps;
    r->omega_dot_e_radps2  = motion->omega_dot_e_radps2;
    r->omega_2dot_e_radps3 = motion->omega_2dot_e_radps3;
    r->reach_e_radps2      = 0.0f; /* a profile that follows looks anew */
    r->arrived             = false;
    hold_near(r, is, near_rad);
}
