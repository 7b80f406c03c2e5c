/* SPDX-License-Identifier: MIT */
#include "commission_response.h"

/* Below this share of the diagonal's product the rows do not tell the three apart. */
#define LEAST_DETERMINANT 1.0e-6f
/* Above every block of the search; with 1,000 cycles a phase still fits its 32 bits. */
#define MOST_SAMPLES 1.0e6f

void commission_block_start(commission_block_t *b, float ts_s, float hz, float least_s)
{
    const float              cycles = base_clamp(hz * least_s, 2.0f, 1000.0f);
    const commission_block_t fresh  = {.cycles = (int16_t)(cycles + 0.5f)};

    *b         = fresh;
    b->samples = (int32_t)base_clamp((float)b->cycles / (hz * ts_s), 4.0f, MOST_SAMPLES);
}

float commission_block_Hz(const commission_block_t *b, float ts_s)
{
    return (float)b->cycles / ((float)b->samples * ts_s);
}

/* Angle of the oscillation at a sample; whole numbers keep it exact. */
static frames_angle_t phase_of(const commission_block_t *b)
{
    const int32_t within = ((int32_t)b->cycles * b->at) % b->samples;
    return frames_angle(BASE_TWO_PI * (float)within / (float)b->samples);
}

float commission_block_wave(const commission_block_t *b)
{
    return phase_of(b).cos;
}

static void add_turned(commission_phasor_t *sum, frames_angle_t phase, float x)
{
    sum->re += phase.cos * x;
    sum->im -= phase.sin * x;
}

bool commission_block_add(commission_block_t *b, int32_t step_cnt, float torque_Nm)
{
    const frames_angle_t phase = phase_of(b);

    add_turned(&b->way_cnt, phase, (float)step_cnt);
    add_turned(&b->torque_Nm, phase, torque_Nm);
    b->turned_cnt = (int32_t)((uint32_t)b->turned_cnt + (uint32_t)step_cnt);
    b->at++;
    return b->at >= b->samples;
}

static float length2(commission_phasor_t x)
{
    return (x.re * x.re) + (x.im * x.im);
}

commission_response_t commission_block_response(const commission_block_t  *b,
                                                const commission_config_t *c,
                                                const commission_result_t *known)
{
    const float          rad   = BASE_TWO_PI / (float)known->counts_per_turn;
    const float          delta = BASE_TWO_PI * (float)b->cycles / (float)b->samples;
    const frames_angle_t half  = frames_angle(0.5f * delta);
    const float          chord = 2.0f * half.sin;
    const float          w     = delta / c->ts_s;
    const float          mean  = 2.0f / (float)b->samples; /* amplitude of a sum */
    /* j e^(j delta/2) P */
    const commission_phasor_t p = {-(half.sin * b->way_cnt.re) - (half.cos * b->way_cnt.im),
                                   (half.cos * b->way_cnt.re) - (half.sin * b->way_cnt.im)};
    const float               signed_rad = (float)known->direction * rad;
    const float               j_kgm2     = known->inertia_kgm2.value;
    const float               to_Nm      = j_kgm2 * signed_rad * w * w / chord;
    const float               line       = (delta * delta) / (chord * chord);
    const float               q2         = length2(b->torque_Nm);
    const float               steps_cnt  = mean * sqrtf(length2(b->way_cnt));
    commission_response_t     out        = {.cnt     = steps_cnt / chord,
                                            .j_Nm    = fabsf(to_Nm) * steps_cnt,
                                            .m_radps = rad * steps_cnt * delta / (chord * c->ts_s)};

    if (q2 > 0.0f) { /* EQ-COMMISSION-17 */
        const float per = to_Nm * line / q2;
        out.y.re        = (per * ((p.re * b->torque_Nm.re) + (p.im * b->torque_Nm.im))) - 1.0f;
        out.y.im        = per * ((p.im * b->torque_Nm.re) - (p.re * b->torque_Nm.im));
    }
    return out;
}

void commission_ring_fit_start(commission_ring_fit_t *f, float at_Hz)
{
    f->at_Hz = at_Hz;
    f->n     = 0;
}

void commission_ring_fit_add(commission_ring_fit_t *f, float hz, commission_phasor_t y)
{
    if ((f->n >= 0) && (f->n < COMMISSION_RING_ANSWERS)) {
        f->ratio[f->n] = hz / f->at_Hz;
        f->y[f->n]     = y;
        f->n++;
    }
}

/* Real and imaginary part of the product of y and its denominator: x[3] = 0 in row[0 .. 2]. */
typedef struct {
    float real[4];
    float imag[4];
} rows_t;

static rows_t rows_of(const commission_ring_fit_t *f, int16_t k)
{
    const float               u  = f->ratio[k];
    const commission_phasor_t y  = f->y[k];
    const float               u2 = u * u;
    const float               w  = sqrtf(length2(y));
    const rows_t              r  = {{w * y.re, -(w * u * y.im), w * u2, w * u2 * y.re},
                                    {w * y.im, w * u * y.re, 0.0f, w * u2 * y.im}};
    return r;
}

/* Normal equations: upper triangle 00 01 02 11 12 22, and right side. */
typedef struct {
    float a[6];
    float b[3];
} normal_t;

static void add_row(normal_t *m, const float row[4])
{
    int16_t at = 0;
    for (int16_t i = 0; i < 3; i++) {
        for (int16_t k = i; k < 3; k++) {
            m->a[at] += row[i] * row[k];
            at++;
        }
        m->b[i] += row[i] * row[3];
    }
}

static float square_off(const float row[4], const float x[3])
{
    const float off = row[3] - ((row[0] * x[0]) + (row[1] * x[1]) + (row[2] * x[2]));
    return off * off;
}

/* Squares of what the solution leaves. From the rows: the sums have lost it by rounding. */
static float rest_of(const commission_ring_fit_t *f, int16_t n, const float x[3])
{
    float rest = 0.0f;
    for (int16_t k = 0; k < n; k++) {
        const rows_t r = rows_of(f, k);
        rest += square_off(r.real, x) + square_off(r.imag, x);
    }
    return rest;
}

bool commission_ring_fit_solve(const commission_ring_fit_t *f, commission_result_t *found)
{
    normal_t      m = {{0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
    const int16_t n = (f->n < COMMISSION_RING_ANSWERS) ? f->n : COMMISSION_RING_ANSWERS;
    for (int16_t k = 0; k < n; k++) {
        const rows_t r = rows_of(f, k);
        add_row(&m, r.real);
        add_row(&m, r.imag);
    }
    const float *const a   = m.a;
    const float *const b   = m.b;
    const float        c00 = (a[3] * a[5]) - (a[4] * a[4]);
    const float        c01 = (a[2] * a[4]) - (a[1] * a[5]);
    const float        c02 = (a[1] * a[4]) - (a[2] * a[3]);
    const float        c11 = (a[0] * a[5]) - (a[2] * a[2]);
    const float        c12 = (a[1] * a[2]) - (a[0] * a[4]);
    const float        c22 = (a[0] * a[3]) - (a[1] * a[1]);
    const float        det = (a[0] * c00) + (a[1] * c01) + (a[2] * c02);

    if ((n < 2) || !(det > (LEAST_DETERMINANT * a[0] * a[3] * a[5]))) {
        return false;
    }
    const float inv  = 1.0f / det;
    const float x[3] = {inv * ((c00 * b[0]) + (c01 * b[1]) + (c02 * b[2])),
                        inv * ((c01 * b[0]) + (c11 * b[1]) + (c12 * b[2])),
                        inv * ((c02 * b[0]) + (c12 * b[1]) + (c22 * b[2]))};
    if (!(x[0] > 0.0f) || !(x[1] > 0.0f) || !(x[2] > 0.0f)) {
        return false;
    }
    const float root     = sqrtf(x[0]);
    const float variance = rest_of(f, n, x) / (float)((2 * n) - 3);
    const float per      = 2.0f * sqrtf(variance * inv);
    const float one      = 1.0f + x[2];

    found->resonance_Hz.value = root * f->at_Hz; /* EQ-COMMISSION-18 */
    found->resonance_Hz.error = 0.5f * per * sqrtf(base_max(c00, 0.0f)) * f->at_Hz / root;
    found->damping.value      = 0.5f * x[1] / root;
    found->damping.error      = 0.5f * per * sqrtf(base_max(c11, 0.0f)) / root;
    found->load_share.value   = x[2] / one;
    found->load_share.error   = per * sqrtf(base_max(c22, 0.0f)) / (one * one);
    return true;
}
