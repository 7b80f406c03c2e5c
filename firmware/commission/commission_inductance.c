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
/* Chosen: three times the samples of a half wave with this current; R and the loss are small. MAP
 * has the voltage of R at its current. */
#define LOOK_SAMPLES 36
#define MAP_SAMPLES  250
#define LOOK_AXES    4
#define MAP_SHARE    0.68f
#define MAP_HALVES   48
/* Chosen: share of the current limit; reached when the back-EMF is this share of the dc link. */
#define BRAKE_SHARE     0.1f
#define BRAKE_EMF_SHARE 0.02f
/* Systematic error that the scatter of one run does not show; six motors, docs/commissioning.md. */
#define SYSTEMATIC 0.01f
/* Chosen: exceeds the measurement error of two equal inductances. */
#define CROSSED 1.1f
/* Chosen: share of a bin. Closer to zero current the inverter loss is unknown. */
#define CROSSING 0.4f
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

static commission_answer_t rest(commission_inductance_t *l, const commission_signal_t *s)
{
    if (l->wait_ticks < REST_TICKS) {
        l->wait_ticks++;
    }
    if (l->wait_ticks > QUIET_TICKS) {
        commission_fit_add(&l->noise, s->di_A.alpha, s->di_A.beta, 0.0f);
    }
    return commission_rest(COMMISSION_BUSY);
}

/* Variance of di by noise, mean of both axes. */
static float noise_of(const commission_inductance_t *l)
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
    const float noise_A = sqrtf(0.5f * noise_of(l));
    return base_clamp(LOOK_NOISES * noise_A, LOOK_SHARE * c->current_max_A,
                      LOOK_MOST * c->current_max_A);
}

static void next_axis(commission_inductance_t *l)
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
    if (l->wait_ticks < REST_TICKS) {
        if (l->wait_ticks == 0) {
            set_direction(l);
        }
        const commission_answer_t zero = rest(l, s);
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
        next_axis(l);
        return commission_rest(COMMISSION_BUSY);
    }
    const float         i_A  = frames_park(s->i_A, l->direction).d;
    const float         di_A = frames_park(s->di_A, l->direction).d;
    const dq_t          v_V  = {commission_wave_tick(&l->wave, i_A, di_A, s->dc_link_V), 0.0f};
    commission_answer_t out  = commission_rest(COMMISSION_BUSY);
    out.v_V                  = frames_inverse_park(v_V, l->direction);
    return out;
}

static void add_to_bin(commission_inductance_t *l, float i_A, float di_A, float v_V, float step_A)
{
    const float size = fabsf(i_A);
    if (size < (CROSSING * step_A)) {
        return;
    }
    const int16_t place = (int16_t)base_clamp(size / step_A, 0.0f, (float)(COMMISSION_BINS - 1));
    commission_bin_t *b = &l->bins[l->axis][(i_A < 0.0f) ? 1 : 0][place];
    b->dd += square(di_A);
    b->dv += di_A * v_V;
    b->vv += square(v_V);
    b->n += 1.0f;
}

static void merge(commission_bin_t *into, const commission_bin_t *b)
{
    into->dd += b->dd;
    into->dv += b->dv;
    into->vv += b->vv;
    into->n += b->n;
}

/* EQ-COMMISSION-6; 0 with too few samples. */
static commission_value_t bin_H(const commission_bin_t *b, float noise_A2, float ts_s)
{
    commission_value_t out = {0.0f, 0.0f};
    const float        dd  = b->dd - (b->n * noise_A2);
    if ((b->n > 2.0f) && (dd > 0.0f)) {
        const float x    = b->dv / dd;
        const float rest = base_max(b->vv - (x * b->dv), 0.0f);
        out.value        = ts_s * x;
        out.error =
            (2.0f * ts_s * sqrtf(rest / ((b->n - 1.0f) * dd))) + (SYSTEMATIC * fabsf(out.value));
    }
    return out;
}

/* Chord inductance up to the largest current: the mean over the bins. */
static void set_map(commission_inductance_t *l, const commission_config_t *c,
                    commission_result_t *found, commission_map_t *map)
{
    const float      noise  = noise_of(l);
    commission_bin_t all[2] = {{0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f}};

    for (int16_t k = 0; k < COMMISSION_BINS; k++) {
        commission_bin_t q = l->bins[1][0][k];
        map->ld_H[0][k]    = bin_H(&l->bins[0][0][k], noise, c->ts_s).value;
        map->ld_H[1][k]    = bin_H(&l->bins[0][1][k], noise, c->ts_s).value;
        merge(&q, &l->bins[1][1][k]);
        map->lq_H[k] = bin_H(&q, noise, c->ts_s).value;
        merge(&all[0], &l->bins[0][0][k]);
        merge(&all[0], &l->bins[0][1][k]);
        merge(&all[1], &q);
    }
    found->ld_H = bin_H(&all[0], noise, c->ts_s);
    found->lq_H = bin_H(&all[1], noise, c->ts_s);
}

static void swap(float *a, float *b)
{
    const float kept = *a;
    *a               = *b;
    *b               = kept;
}

/* Ld above Lq means that the assumed d axis is the q axis of a reluctance motor. Swaps the axes. */
static void turn_if_crossed(commission_result_t *found, commission_map_t *map)
{
    if (!(found->ld_H.value > (CROSSED * found->lq_H.value))) {
        return;
    }
    swap(&found->ld_H.value, &found->lq_H.value);
    swap(&found->ld_H.error, &found->lq_H.error);
    for (int16_t k = 0; k < COMMISSION_BINS; k++) {
        swap(&map->ld_H[0][k], &map->lq_H[k]);
        map->ld_H[1][k] = map->ld_H[0][k];
    }
    found->offset_rad.value = frames_wrap(found->offset_rad.value - (0.5f * BASE_PI));
    found->flux_Wb.value    = 0.0f;
    found->reluctance       = true;
}

/* Shift of the wave: its mean current brakes a moving rotor. Without it the wave would drive the
 * rotor, as the current steps are finer on the side towards which the back-EMF pushes. */
static float brake_A(const commission_inductance_t *l, const commission_signal_t *s,
                     const commission_result_t *found, float bound_A)
{
    const float emf = l->angle.omega_e_radps * found->flux_Wb.value;
    return BRAKE_SHARE * bound_A * base_clamp(emf / (BRAKE_EMF_SHARE * s->dc_link_V), -1.0f, 1.0f);
}

commission_answer_t commission_inductance_map(commission_inductance_t   *l,
                                              const commission_config_t *c,
                                              const commission_signal_t *s,
                                              commission_result_t *found, commission_map_t *map)
{
    const float bound_A = MAP_SHARE * c->current_max_A;
    if (l->axis > 1) {
        map->step_A = bound_A / (float)COMMISSION_BINS;
        set_map(l, c, found, map);
        turn_if_crossed(found, map);
        return commission_rest(((found->ld_H.value > 0.0f) && (found->lq_H.value > 0.0f))
                                   ? COMMISSION_DONE
                                   : COMMISSION_FAILED);
    }
    if (l->wait_ticks < REST_TICKS) {
        commission_wave_start(&l->wave, bound_A, MAP_SAMPLES, l->most_V);
        l->before_cnt = s->position_cnt;
        commission_angle_start(&l->angle, commission_angle_rad(found, s->position_cnt));
        return rest(l, s);
    }
    const float moved = (float)commission_moved_cnt(s->position_cnt, l->before_cnt);
    const float omega = (float)found->direction * (float)found->pole_pairs * BASE_TWO_PI * moved /
                        ((float)found->counts_per_turn * c->ts_s);
    const float          theta = commission_angle_rad(found, s->position_cnt);
    const frames_angle_t angle = frames_angle(theta);
    (void)commission_angle_tick(&l->angle, theta, c->ts_s);
    const dq_t i_A  = frames_park(s->i_A, angle);
    const dq_t di_A = frames_park(s->di_A, angle);
    const dq_t v_V  = frames_park(s->v_V, angle);
    const bool d    = l->axis == 0;
    l->before_cnt   = s->position_cnt;

    if (l->wave.halves > 0) {
        const float along = d ? i_A.d : i_A.q;
        const float step  = d ? di_A.d : di_A.q;
        const float emf   = d ? 0.0f : (omega * found->flux_Wb.value);
        const float mid_A = along - (0.5f * step);
        const float left  = (d ? v_V.d : v_V.q) - (found->r_Ohm.value * mid_A) - emf;
        add_to_bin(l, mid_A, step, left, bound_A / (float)COMMISSION_BINS);
    }
    if (l->wave.halves > MAP_HALVES) {
        next_axis(l);
        return commission_rest(COMMISSION_BUSY);
    }
    const float shift_A = d ? 0.0f : brake_A(l, s, found, bound_A);
    const float wave_V  = commission_wave_tick(&l->wave, (d ? i_A.d : i_A.q) + shift_A,
                                              d ? di_A.d : di_A.q, s->dc_link_V);
    const dq_t  want_V  = {d ? wave_V : 0.0f, d ? 0.0f : wave_V};
    const dq_t  then_A  = {d ? (i_A.d + (1.5f * di_A.d)) : 0.0f,
                         d ? 0.0f : (i_A.q + (1.5f * di_A.q))};
    commission_answer_t out = commission_rest(COMMISSION_BUSY);
    out.v_V                 = frames_inverse_park(want_V, angle);
    out.i_A                 = frames_inverse_park(then_A, angle);
    return out;
}
