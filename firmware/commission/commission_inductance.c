/* SPDX-License-Identifier: MIT */
#include "commission_inductance.h"

/* Chosen: the reluctance torque hardly moves the rotor. */
#define LOOK_SHARE 0.06f
/* Chosen. The extrapolation of EQ-COMMISSION-2 has sqrt(13) times the noise of a sample. The end of a
 * half wave is then five standard deviations away. */
#define LOOK_NOISES 25.0f
/* With more noise than this share the current stays at it. */
#define LOOK_MOST   0.3f
#define LOOK_HALVES 40
/* Chosen: three times the samples of a half wave with this current; R and the loss are small. */
#define LOOK_SAMPLES 36
#define LOOK_AXES    4
/* Periods at zero voltage before each wave: the current decays and its noise is measured. */
#define REST_TICKS 200
/* The noise is measured after this many periods: the current has then decayed. */
#define QUIET_TICKS 100

void commission_inductance_start(commission_inductance_t *l, float most_V, float most_Ohm)
{
    const commission_inductance_t fresh = {.most_V = most_V, .most_Ohm = most_Ohm};
    *l                                  = fresh;
}

static float square(float x)
{
    return x * x;
}

bool commission_inductance_rests(const commission_inductance_t *l)
{
    return l->wait_ticks < REST_TICKS;
}

bool commission_inductance_decays(const commission_inductance_t *l)
{
    return l->wait_ticks <= QUIET_TICKS;
}

commission_answer_t commission_inductance_rest(commission_inductance_t   *l,
                                               const commission_signal_t *s)
{
    if (commission_inductance_rests(l)) {
        l->wait_ticks++;
    }
    if (!commission_inductance_decays(l)) {
        commission_fit_add(&l->noise, s->di_A.alpha, s->di_A.beta, 0.0f);
    }
    return commission_rest(COMMISSION_BUSY);
}

float commission_inductance_noise(const commission_inductance_t *l)
{
    return 0.5f * (l->noise.aa + l->noise.bb) / base_max((float)l->noise.n, 1.0f);
}

/* EQ-COMMISSION-4 without the noise of di. */
static commission_fitted_t solve(const commission_inductance_t *l, const commission_fit_t *sums)
{
    const float      share = (float)sums->n / base_max((float)l->noise.n, 1.0f);
    commission_fit_t clean = *sums;

    clean.aa -= share * l->noise.aa;
    clean.ab -= share * l->noise.ab;
    clean.bb -= share * l->noise.bb;
    commission_fitted_t out = commission_fit_solve(&clean);
    out.valid               = out.valid && (clean.aa > 0.0f);
    return out;
}

/* Current of LOOK: small, and well above the noise of one sample. */
static float look_A(const commission_inductance_t *l, const commission_config_t *c)
{
    const float noise_A = sqrtf(0.5f * commission_inductance_noise(l));
    return base_clamp(LOOK_NOISES * noise_A, LOOK_SHARE * c->current_max_A,
                      LOOK_MOST * c->current_max_A);
}

void commission_inductance_next(commission_inductance_t *l)
{
    l->axis++;
    l->wait_ticks = 0;
}

/* Inductances from LOOK, EQ-COMMISSION-5. The larger one is taken for the q axis. */
static bool set_look(commission_inductance_t *l, const commission_config_t *c,
                     commission_result_t *found)
{
    const commission_fitted_t a = solve(l, &l->alpha);
    const commission_fitted_t b = solve(l, &l->beta);
    if (!a.valid || !b.valid) {
        return false;
    }
    const float mean  = 0.5f * (a.x0 + b.x1) * c->ts_s;
    const float cos2  = 0.5f * (a.x0 - b.x1) * c->ts_s;
    const float sin2  = 0.5f * (a.x1 + b.x0) * c->ts_s;
    const float half  = sqrtf(square(cos2) + square(sin2));
    found->ld_H.value = mean - half;
    found->lq_H.value = mean + half;
    found->odd_V      = l->power_W / base_max(l->size_A, 1.0e-9f);
    return found->ld_H.value > 0.0f;
}

/* Direction of the wave: alpha, beta, then the two axes that these waves showed. Along its own axis
 * each inductance gets its own amplitude. In alpha and beta the smaller inductance sets it. */
static void set_direction(commission_inductance_t *l)
{
    const commission_fitted_t a = solve(l, &l->alpha);
    const commission_fitted_t b = solve(l, &l->beta);
    const float large = 0.5f * commission_angle_of(a.x1 + b.x0, a.x0 - b.x1); /* EQ-COMMISSION-5 */
    const frames_angle_t alpha = {1.0f, 0.0f};
    const frames_angle_t beta  = {0.0f, 1.0f};

    switch (l->axis) {
    case 0:
        l->direction = alpha;
        break;
    case 1:
        l->direction = beta;
        break;
    default:
        l->direction = frames_angle(large + ((l->axis == 2) ? (0.5f * BASE_PI) : 0.0f));
        break;
    }
}

/* The stored energy has no mean over whole waves: v i is what R and the inverter take. */
static void add_power(commission_inductance_t *l, const commission_signal_t *s)
{
    const ab_t mid_A = {s->i_A.alpha - (0.5f * s->di_A.alpha), s->i_A.beta - (0.5f * s->di_A.beta)};
    l->power_W += (s->v_V.alpha * mid_A.alpha) + (s->v_V.beta * mid_A.beta);
    l->size_A += sqrtf(square(mid_A.alpha) + square(mid_A.beta));
}

commission_answer_t commission_inductance_look(commission_inductance_t   *l,
                                               const commission_config_t *c,
                                               const commission_signal_t *s,
                                               commission_result_t       *found)
{
    if (l->axis >= LOOK_AXES) {
        return commission_rest(set_look(l, c, found) ? COMMISSION_DONE : COMMISSION_FAILED);
    }
    if (commission_inductance_rests(l)) {
        if (l->wait_ticks == 0) {
            set_direction(l);
        }
        const commission_answer_t zero = commission_inductance_rest(l, s);
        const float               i_A  = look_A(l, c);
        commission_wave_start(&l->wave, i_A, LOOK_SAMPLES, base_max(l->most_V, i_A * l->most_Ohm));
        return zero;
    }
    if (l->wave.halves > 0) {
        commission_fit_add(&l->alpha, s->di_A.alpha, s->di_A.beta,
                           s->v_V.alpha); /* EQ-COMMISSION-4 */
        commission_fit_add(&l->beta, s->di_A.alpha, s->di_A.beta, s->v_V.beta);
        add_power(l, s);
    }
    if (l->wave.halves > LOOK_HALVES) {
        commission_inductance_next(l);
        return commission_rest(COMMISSION_BUSY);
    }
    const float         i_A  = frames_park(s->i_A, l->direction).d;
    const float         di_A = frames_park(s->di_A, l->direction).d;
    const dq_t          v_V  = {commission_wave_tick(&l->wave, i_A, di_A, s->dc_link_V), 0.0f};
    commission_answer_t out  = commission_rest(COMMISSION_BUSY);
    out.v_V                  = frames_inverse_park(v_V, l->direction);
    return out;
}
