/* SPDX-License-Identifier: MIT */
#include "app_trim.h"

#define BLOCK_s      0.25f /* chosen: with SHARE, a time constant of 1 s */
#define SHARE        0.25f /* stable while L_q - L_d is below eight times the believed one */
#define BLOCK_MOST_s 1.0f  /* chosen: a slower turn sees other currents */
#define STEP_MOST    0.3f  /* chosen: [rad] of a control period; twice the angle has ten samples */
#define GAP_MOST     1.5f  /* chosen: [rad] of a late pass, below half a turn */
#define SPEED_MOVES  0.05f /* chosen: EQ-TRIM-1 has the mean speed for its end */
#define SALIENCY     0.1f  /* derived: 10 % of L_d and L_q do not change the sign of L_q - L_d */
#define I_LEAST      0.1f  /* chosen: below it voltages of the dead time read as 0.1 A */
#define I_MOVES      0.25f /* chosen: with L 30 % wrong a step then reads as 10 mA */
#define LATE         1.5f  /* control periods from a sample to the middle of its voltage */
#define ALIKE        0.25f /* chosen: cos^2 of 60 degrees */
#define COS_30       0.866025404f

void app_trim_reset(app_trim_t *t)
{
    const app_trim_t nothing = {.count = 0U};

    *t = nothing;
}

void app_trim_zeroed(app_trim_t *t)
{
    t->values.a_A = 0.0f;
    t->values.b_A = 0.0f;
    t->begun      = false;
    t->ended      = false;
}

void app_trim_end(app_trim_t *t)
{
    const app_trim_values_t nothing = {0.0f, 0.0f, 0.0f};

    t->values = nothing;
    t->begun  = false;
    t->ended  = true;
}

static dq_t times(dq_t x, dq_t y) /* as complex numbers d + jq */
{
    const dq_t z = {(x.d * y.d) - (x.q * y.q), (x.d * y.q) + (x.q * y.d)};
    return z;
}

static dq_t plus(dq_t x, dq_t y)
{
    const dq_t z = {x.d + y.d, x.q + y.q};
    return z;
}

static dq_t scaled(dq_t x, float k)
{
    const dq_t z = {k * x.d, k * x.q};
    return z;
}

static float squared(dq_t x)
{
    return (x.d * x.d) + (x.q * x.q);
}

/* exp(-j angle). */
static dq_t back(float angle_rad)
{
    const frames_angle_t a = frames_angle(angle_rad);
    const dq_t           z = {a.cos, -a.sin};
    return z;
}

static dq_t flux_Wb(const motor_reduced_t *m, dq_t i_A)
{
    const dq_t psi = {i_A.d * m->inv_l8, i_A.q * m->inv_l6};
    return psi;
}

static void begin_sums(app_trim_t *t, const app_trim_seen_t *seen, dq_t i_A)
{
    const app_trim_sums_t none = {.unit = {0.0f, 0.0f}};

    t->sums[0]       = none;
    t->sums[1]       = none;
    t->i_A           = none.unit;
    t->moved_e_radps = 0.0f;
    t->count         = 0U;
    t->first_A       = i_A;
    t->first_e_radps = seen->omega_e_radps;
    t->first_rad     = seen->theta_e_rad;
    t->first_ticks   = seen->ticks;
    t->begun         = true;
}

static void add_sums(app_trim_sum_t *s, dq_t y, dq_t unit)
{
    s->turned = plus(s->turned, times(y, unit));
    s->plain  = plus(s->plain, y);
}

/* A sample, added to the sums of h. */
static void add_to(app_trim_sums_t *s, float h, const app_trim_seen_t *seen, dq_t i_A,
                   float moved_e_radps, const app_trim_config_t *c)
{
    const motor_reduced_t *m        = c->motor;
    const float            w        = seen->omega_e_radps;
    const float            r_Ohm    = m->l7 * m->inv_l8;
    const dq_t             psi      = scaled(flux_Wb(m, i_A), h + 1.0f);
    const dq_t             v_V      = times(seen->v_V, back(h * LATE * w * c->ts_s));
    const float            full_Wb  = psi.d + (m->l5 * m->inv_l6);
    const dq_t             y_V      = {(v_V.d - (r_Ohm * i_A.d)) + (w * psi.q),
                                       (v_V.q - (r_Ohm * i_A.q)) - (w * full_Wb)};
    const dq_t             y_radps2 = {i_A.q * (m->l1 + (m->l11 * i_A.d)), -h * w * moved_e_radps};
    const dq_t             unit     = back(h * seen->theta_e_rad);

    add_sums(&s->voltage, y_V, unit);
    add_sums(&s->torque, y_radps2, unit);
    s->unit = plus(s->unit, unit);
}

static float since_first_s(const app_trim_t *t, const app_trim_seen_t *seen,
                           const app_trim_config_t *c)
{
    const uint32_t passed_ticks = seen->ticks - t->first_ticks;

    return (float)passed_ticks * c->ts_s;
}

/* The part of a block that turns h times. The change of x from its first sample to the one after
 * its last is taken off. The means are taken off: they matter where a block is not whole turns. */
static dq_t turned_mean(const app_trim_sum_t *s, dq_t unit, float per, dq_t change)
{
    const dq_t mean = plus(s->turned, scaled(times(s->plain, unit), -per));
    return plus(scaled(mean, per), scaled(change, -1.0f));
}

/* A block that has ended. */
typedef struct {
    float per;    /* 1 / samples */
    float per_s;  /* 1 / length */
    dq_t  mean_A; /* current */
    float mean_e_radps;
    dq_t  first_Wb; /* flux linkages of the currents, less their means, and speeds, the same */
    dq_t  last_Wb;
    dq_t  first_e_radps;
    dq_t  last_e_radps;
    float first_rad;
    float last_rad;
} block_t;

static dq_t change(const block_t *b, float h, dq_t first, dq_t last)
{
    const dq_t to = times(last, back(h * b->last_rad));
    return scaled(plus(to, scaled(times(first, back(h * b->first_rad)), -1.0f)), b->per_s);
}

/* conj(E_h) by EQ-TRIM-1 and 2. @return false: the torque contradicts it, EQ-TRIM-5. */
static bool error_A(float h, const app_trim_sums_t *s, const block_t *b, const motor_reduced_t *m,
                    dq_t *e_A)
{
    const dq_t r_V =
        turned_mean(&s->voltage, s->unit, b->per, change(b, h, b->first_Wb, b->last_Wb));
    const dq_t a_radps2 =
        turned_mean(&s->torque, s->unit, b->per, change(b, h, b->first_e_radps, b->last_e_radps));
    const float k      = 2.0f / ((h + 1.0f) * b->mean_e_radps * (m->inv_l6 - m->inv_l8));
    const dq_t  conj_A = {k * r_V.q, -k * r_V.d};
    const float along  = (conj_A.d * a_radps2.q) - (conj_A.q * a_radps2.d); /* with -j a */

    e_A->d = conj_A.d;
    e_A->q = -conj_A.q;
    return (along > 0.0f) && ((along * along) >= (ALIKE * squared(conj_A) * squared(a_radps2)));
}

static block_t ended_block(const app_trim_t *t, const app_trim_seen_t *seen, dq_t i_A,
                           const app_trim_config_t *c)
{
    const float   per    = 1.0f / (float)t->count;
    const dq_t    mean_A = scaled(t->i_A, per);
    const dq_t    less_A = scaled(mean_A, -1.0f);
    const float   mean   = t->moved_e_radps * per;
    const float   moved  = seen->omega_e_radps - t->first_e_radps;
    const block_t b      = {.per           = per,
                            .per_s         = 1.0f / since_first_s(t, seen, c),
                            .mean_A        = mean_A,
                            .mean_e_radps  = t->first_e_radps + mean,
                            .first_Wb      = flux_Wb(c->motor, plus(t->first_A, less_A)),
                            .last_Wb       = flux_Wb(c->motor, plus(i_A, less_A)),
                            .first_e_radps = {-mean, 0.0f},
                            .last_e_radps  = {moved - mean, 0.0f},
                            .first_rad     = t->first_rad,
                            .last_rad      = seen->theta_e_rad};
    return b;
}

static bool is_within_bounds(const app_trim_values_t *v, const app_trim_config_t *c)
{
    return base_within(v->a_A, c->offset_most_A) && base_within(v->b_A, c->offset_most_A) &&
           base_within(v->gain, APP_TRIM_GAIN_MOST); /* false for a NaN */
}

/* Learns from a block. @return true: the values have changed. */
static bool learn_block(app_trim_t *t, const block_t *b, const app_trim_config_t *c)
{
    const float        i2_A2   = squared(b->mean_A);
    const float        least_A = I_LEAST * c->current_max_A;
    app_trim_values_t *v       = &t->values;
    dq_t               e_A;
    bool               learned = false;

    if (i2_A2 < (least_A * least_A)) {
        return false;
    }
    if (error_A(1.0f, &t->sums[0], b, c->motor, &e_A)) { /* EQ-TRIM-3 */
        v->a_A += SHARE * e_A.d;
        v->b_A += SHARE * 0.5f * ((BASE_SQRT3 * e_A.q) - e_A.d);
        learned = true;
    }
    if (error_A(2.0f, &t->sums[1], b, c->motor, &e_A)) { /* EQ-TRIM-4 */
        const dq_t ratio = scaled(times(e_A, b->mean_A), 1.0f / i2_A2);

        v->gain += SHARE * BASE_SQRT3 * ((COS_30 * ratio.d) + (0.5f * ratio.q));
        learned = true;
    }
    if (!is_within_bounds(v, c)) {
        app_trim_end(t);
    } else if (learned && (t->blocks < UINT16_MAX)) {
        t->blocks = (uint16_t)(t->blocks + 1U);
    } else {
        /* the count is at its end, or nothing to count */
    }
    return learned;
}

static bool can_learn(const app_trim_t *t, const app_trim_seen_t *seen, const app_trim_config_t *c)
{
    const motor_reduced_t *m     = c->motor;
    const float            w     = fabsf(seen->omega_e_radps);
    const float            l_H   = fabsf(m->inv_l6 - m->inv_l8);
    const float            r_Ohm = m->l7 * m->inv_l8;

    return seen->runs && !t->ended && (l_H >= (SALIENCY * (m->inv_l6 + m->inv_l8))) &&
           ((w * l_H) >= r_Ohm) && ((w * c->ts_s) <= STEP_MOST);
}

/* The sample goes on with the block. */
static bool continues_block(const app_trim_t *t, const app_trim_seen_t *seen, dq_t i_A,
                            const app_trim_config_t *c)
{
    const float    moves_A    = I_MOVES * c->current_max_A;
    const uint32_t late_ticks = seen->ticks - t->ticks;
    const float    gap_rad    = fabsf(seen->omega_e_radps) * (float)late_ticks * c->ts_s;

    return base_within(seen->omega_e_radps - t->first_e_radps,
                       SPEED_MOVES * fabsf(t->first_e_radps)) &&
           base_within(i_A.d - t->first_A.d, moves_A) &&
           base_within(i_A.q - t->first_A.q, moves_A) && (gap_rad <= GAP_MOST) &&
           (since_first_s(t, seen, c) <= BLOCK_MOST_s) && (t->count < UINT16_MAX);
}

static void add(app_trim_t *t, const app_trim_seen_t *seen, dq_t i_A, const app_trim_config_t *c)
{
    const float moved_e_radps = seen->omega_e_radps - t->first_e_radps;

    add_to(&t->sums[0], 1.0f, seen, i_A, moved_e_radps, c);
    add_to(&t->sums[1], 2.0f, seen, i_A, moved_e_radps, c);
    t->i_A = plus(t->i_A, i_A);
    t->moved_e_radps += moved_e_radps;
    t->count = (uint16_t)(t->count + 1U);
}

bool app_trim_see(app_trim_t *t, const app_trim_seen_t *seen, const app_trim_config_t *c)
{
    if (seen->ticks == t->ticks) {
        return false;
    }
    const dq_t i_A =
        frames_park(frames_clarke(seen->ia_A, seen->ib_A), frames_angle(seen->theta_e_rad));
    const bool turned  = !base_within(seen->theta_e_rad - t->before_rad, BASE_PI); /* to zero */
    bool       changed = false;

    t->begun = t->begun && can_learn(t, seen, c) && continues_block(t, seen, i_A, c);
    if (turned && t->begun && (since_first_s(t, seen, c) >= BLOCK_s)) {
        const block_t b = ended_block(t, seen, i_A, c);

        changed  = learn_block(t, &b, c);
        t->begun = false;
    }
    if (turned && !t->begun && can_learn(t, seen, c)) {
        begin_sums(t, seen, i_A);
    }
    if (t->begun) {
        add(t, seen, i_A, c);
    }
    t->before_rad = seen->theta_e_rad;
    t->ticks      = seen->ticks;
    return changed;
}
