/* SPDX-License-Identifier: MIT */
#include "commission_map.h"

/* Three times the samples of a half wave, with the voltage of R at this current. */
#define SAMPLES 250
/* Chosen: share of the current limit, of the wave and the d current together. */
#define SHARE  0.68f
#define HALVES 192
/* Chosen: of an inductance in a period, as in EQ-COMMISSION-3. */
#define HOLD 0.2f
/* Chosen: share of the current limit; reached when the back-EMF is this share of the dc link. */
#define BRAKE_SHARE     0.1f
#define BRAKE_EMF_SHARE 0.02f
/* Systematic error that the scatter of one run does not show; six motors, docs/commissioning.md. */
#define SYSTEMATIC 0.01f
/* Chosen: exceeds the measurement error of two equal inductances. */
#define CROSSED 1.1f
/* Chosen: share of a bin. Closer to zero current the inverter loss is unknown. */
#define CROSSING  0.4f
#define LARGEST_V 1.0e9f

/* Row of the bins for a wave and the sign of its current. */
static int16_t row_of(int16_t wave, bool negative)
{
    float row = (float)wave + 1.0f;

    if (wave <= 0) {
        row = negative ? 1.0f : 0.0f;
    }
    return (int16_t)base_clamp(row, 0.0f, (float)COMMISSION_MAP_ROWS - 1.0f);
}

static void add_to_bin(commission_inductance_t *l, float i_A, float di_A, float v_V, float step_A)
{
    const float size = fabsf(i_A);
    if (size < (CROSSING * step_A)) {
        return;
    }
    const int16_t place = (int16_t)base_clamp(size / step_A, 0.0f, (float)(COMMISSION_BINS - 1));
    commission_bin_t *b = &l->bins[row_of(l->axis, i_A < 0.0f)][place];
    b->dd += di_A * di_A;
    b->dv += di_A * v_V;
    b->vv += v_V * v_V;
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

static uint16_t share_of(float l_H, float mean_H)
{
    const float share = (float)COMMISSION_MAP_ONE * l_H / base_max(mean_H, 1.0e-9f);
    return (uint16_t)base_clamp(share + 0.5f, 0.0f, 65535.0f);
}

/* Chord inductances up to the largest current without the other one: the means over the bins. */
static void set_means(const commission_inductance_t *l, const commission_config_t *c,
                      commission_result_t *found)
{
    const float      noise = commission_inductance_noise(l);
    commission_bin_t d     = {0.0f, 0.0f, 0.0f, 0.0f};
    commission_bin_t q     = d;

    for (int16_t k = 0; k < COMMISSION_BINS; k++) {
        merge(&d, &l->bins[0][k]);
        merge(&d, &l->bins[1][k]);
        merge(&q, &l->bins[2][k]);
    }
    found->ld_H = bin_H(&d, noise, c->ts_s);
    found->lq_H = bin_H(&q, noise, c->ts_s);
}

static void set_map(const commission_inductance_t *l, const commission_config_t *c,
                    const commission_result_t *found, commission_map_t *map)
{
    const float noise = commission_inductance_noise(l);

    for (int16_t k = 0; k < COMMISSION_BINS; k++) {
        for (int16_t row = 0; row < 2; row++) {
            map->ld[row][k] =
                share_of(bin_H(&l->bins[row][k], noise, c->ts_s).value, found->ld_H.value);
        }
        for (int16_t row = 0; row < 3; row++) {
            map->lq[row][k] =
                share_of(bin_H(&l->bins[row + 2][k], noise, c->ts_s).value, found->lq_H.value);
        }
    }
    map->step_A = SHARE * c->current_max_A / (float)COMMISSION_BINS;
}

/* Ld above Lq means that the assumed d axis is the q axis of a reluctance motor. The d current then
 * was in the wrong axis: MAP begins again with the axes exchanged. */
static void turn_axes(commission_inductance_t *l, commission_result_t *found)
{
    const commission_value_t ld = found->ld_H;

    found->ld_H             = found->lq_H;
    found->lq_H             = ld;
    found->offset_rad.value = frames_wrap(found->offset_rad.value - (0.5f * BASE_PI));
    found->flux_Wb.value    = 0.0f;
    found->reluctance       = true;
    commission_inductance_start(l, LARGEST_V, 0.0f);
    l->turned = true;
}

static commission_step_t finish_means(commission_inductance_t *l, const commission_config_t *c,
                                      commission_result_t *found)
{
    commission_step_t step = COMMISSION_BUSY;

    set_means(l, c, found);
    const bool positive = (found->ld_H.value > 0.0f) && (found->lq_H.value > 0.0f);
    const bool crossed  = positive && (found->ld_H.value > (CROSSED * found->lq_H.value));

    if (crossed && !l->turned) {
        turn_axes(l, found);
    } else if (positive && !crossed) {
        l->axis++;
    } else {
        step = COMMISSION_FAILED;
    }
    return step;
}

/* The means and the map have a period each: together they take longer than one of 50 us. */
static commission_answer_t finish_map(commission_inductance_t *l, const commission_config_t *c,
                                      commission_result_t *found, commission_map_t *map)
{
    commission_step_t step = COMMISSION_DONE;

    if (l->axis == COMMISSION_MAP_WAVES) {
        step = finish_means(l, c, found);
    } else {
        set_map(l, c, found, map);
    }
    return commission_rest(step);
}

/* Shift of the wave: its mean current brakes a moving rotor. Without it the wave would drive the
 * rotor, as the current steps are finer on the side towards which the back-EMF pushes. */
static float brake_A(const commission_inductance_t *l, const commission_signal_t *s,
                     const commission_result_t *found, float bound_A)
{
    const float emf = l->angle.omega_e_radps * found->flux_Wb.value;
    return BRAKE_SHARE * bound_A * base_clamp(emf / (BRAKE_EMF_SHARE * s->dc_link_V), -1.0f, 1.0f);
}

/* d current beside the wave. */
static float beside_A(int16_t wave, float bound_A)
{
    const float bias_A = COMMISSION_MAP_BIAS * bound_A / (float)COMMISSION_BINS;
    return (wave > 1) ? (bias_A * (1.0f - (float)wave)) : 0.0f;
}

/* EQ-COMMISSION-20: amplitude of a wave. */
static float wave_A(int16_t wave, float bound_A)
{
    const float other_A = beside_A(wave, bound_A);

    return sqrtf((bound_A * bound_A) - (other_A * other_A));
}

/* EQ-COMMISSION-19; the wave along q has what is left of the dc link. */
static float hold_V(const commission_inductance_t *l, const commission_config_t *c,
                    const commission_result_t *found, float id_A, float iq_A, float bound_A)
{
    const float want_A = beside_A(l->axis, bound_A);
    return (l->axis > 1) ? ((found->r_Ohm.value * want_A) +
                            (HOLD * found->ld_H.value / c->ts_s * (want_A - id_A)) -
                            (l->angle.omega_e_radps * found->lq_H.value * iq_A))
                         : 0.0f;
}

/* Electrical speed from the counts of one period. */
static float counted_e_radps(const commission_inductance_t *l, const commission_config_t *c,
                             const commission_result_t *found, int32_t position_cnt)
{
    const float moved = (float)commission_moved_cnt(position_cnt, l->before_cnt);
    return (float)found->direction * (float)found->pole_pairs * BASE_TWO_PI * moved /
           ((float)found->counts_per_turn * c->ts_s);
}

/* Rest before a wave. At zero voltage a current would last for several L / R and turn the rotor.
 * The axes may be exchanged, so the smaller inductance counts. */
static commission_answer_t rest(commission_inductance_t *l, const commission_config_t *c,
                                const commission_signal_t *s, const commission_result_t *found)
{
    const float         end_Ohm = HOLD * base_min(found->ld_H.value, found->lq_H.value) / c->ts_s;
    const ab_t          end_V   = {-end_Ohm * s->i_A.alpha, -end_Ohm * s->i_A.beta};
    commission_answer_t out     = commission_inductance_rest(l, s);
    if (commission_inductance_decays(l)) {
        out.v_V = end_V;
        out.i_A = s->i_A;
    }
    return out;
}

commission_answer_t commission_map_tick(commission_inductance_t *l, const commission_config_t *c,
                                        const commission_signal_t *s, commission_result_t *found,
                                        commission_map_t *map)
{
    const float bound_A = SHARE * c->current_max_A;
    if (l->axis >= COMMISSION_MAP_WAVES) {
        return finish_map(l, c, found, map);
    }
    if (commission_inductance_rests(l)) {
        commission_wave_start(&l->wave, wave_A(l->axis, bound_A), SAMPLES, l->most_V);
        l->before_cnt = s->position_cnt;
        commission_angle_start(&l->angle, commission_angle_rad(found, s->position_cnt));
        return rest(l, c, s, found);
    }
    const float          omega = counted_e_radps(l, c, found, s->position_cnt);
    const float          theta = commission_angle_rad(found, s->position_cnt);
    const frames_angle_t angle = frames_angle(theta);
    const float ahead_rad      = 1.5f * c->ts_s * commission_angle_tick(&l->angle, theta, c->ts_s);
    const dq_t  i_A            = frames_park(s->i_A, angle);
    const dq_t  di_A           = frames_park(s->di_A, angle);
    const bool  d              = l->axis == 0;
    l->before_cnt              = s->position_cnt;

    if (l->wave.halves > 0) {
        const dq_t  v_V   = frames_park(s->v_V, angle);
        const float along = d ? i_A.d : i_A.q;
        const float step  = d ? di_A.d : di_A.q;
        const float emf   = d ? 0.0f : (omega * found->flux_Wb.value);
        const float mid_A = along - (0.5f * step);
        const float left  = (d ? v_V.d : v_V.q) - (found->r_Ohm.value * mid_A) - emf;
        add_to_bin(l, mid_A, step, left, wave_A(l->axis, bound_A) / (float)COMMISSION_BINS);
    }
    if (l->wave.halves > HALVES) {
        commission_inductance_next(l);
        return commission_rest(COMMISSION_BUSY);
    }
    const float shift_A = d ? 0.0f : brake_A(l, s, found, bound_A);
    const float wave_V  = commission_wave_tick(&l->wave, (d ? i_A.d : i_A.q) + shift_A,
                                              d ? di_A.d : di_A.q, s->dc_link_V);
    const dq_t  soon_A  = {i_A.d + (1.5f * di_A.d), i_A.q + (1.5f * di_A.q)};
    const dq_t  then_A  = {d ? soon_A.d : beside_A(l->axis, bound_A), d ? 0.0f : soon_A.q};
    const dq_t  want_V  = {d ? wave_V : hold_V(l, c, found, i_A.d, soon_A.q, bound_A),
                         d ? 0.0f : wave_V};
    const frames_angle_t then = frames_angle(frames_wrap(theta + ahead_rad));
    commission_answer_t  out  = commission_rest(COMMISSION_BUSY);
    out.v_V                   = frames_inverse_park(want_V, then);
    out.i_A                   = frames_inverse_park(then_A, then);
    return out;
}
