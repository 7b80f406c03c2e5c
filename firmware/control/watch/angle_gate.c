/* SPDX-License-Identifier: MIT */
#include "angle_gate.h"

#include "check.h"
#include "frames.h"

/* Tolerance of a standing angle: one count to either side, and half a count of rounding. */
#define STANDS_cnt 1.5f

/* Chosen: least rotation beyond the band. Errors of quantised speeds are smaller. */
#define BEYOND_cnt 2.0f

/* Chosen: three errors of the same jump differ by the possible motion meanwhile, twice the gate. */
#define SAME_GATES 2.0f

CTL_PART bool angle_gate_check(const angle_gate_config_t *c)
{
    return base_in_range(c->gate_rad, 1.0e-6f, BASE_PI) &&
           base_in_range(c->step_rad, 1.0e-9f, c->gate_rad) &&
           base_in_range(c->count_rad, 1.0e-6f, BASE_PI) && check_positive(c->slow_e_radps2);
}

CTL_PART void angle_gate_reset(angle_gate_t *s, float theta_e_rad)
{
    const angle_gate_t start = {.stood_rad = theta_e_rad};

    *s = start;
}

/* EQ-ANGLE-GATE-2 */
static bool stands(angle_gate_t *s, const angle_gate_config_t *c, float theta_e_rad,
                   float omega_e_radps, float ts_s)
{
    if (!base_within(frames_wrap(theta_e_rad - s->stood_rad), STANDS_cnt * c->count_rad)) {
        s->stood_rad     = theta_e_rad;
        s->standing      = 0;
        s->speed_e_radps = fabsf(omega_e_radps);
        s->turned_rad    = 0.0f;
        return false;
    }
    s->speed_e_radps = base_max(s->speed_e_radps - (c->slow_e_radps2 * ts_s), 0.0f);
    s->turned_rad += ts_s * s->speed_e_radps;
    if (s->standing < ANGLE_GATE_HOLD) {
        s->standing = (int16_t)(s->standing + 1);
    }
    return (s->standing >= ANGLE_GATE_HOLD) &&
           (s->turned_rad > ((STANDS_cnt + BEYOND_cnt) * c->count_rad));
}

static void ignore(angle_gate_t *s, float error_rad)
{
    if (s->beyond == 0) {
        s->first_rad = error_rad;
    }
    s->beyond = (int16_t)(s->beyond + 1);
    if (s->ignored < UINT16_MAX) {
        s->ignored = (uint16_t)(s->ignored + 1U);
    }
}

CTL_PART angle_gate_result_t angle_gate_pass(angle_gate_t *s, const angle_gate_config_t *c,
                                             float theta_e_rad, float error_rad,
                                             float omega_e_radps, float ts_s)
{
    angle_gate_result_t out = {
        .error_rad = error_rad, .jump_rad = 0.0f, .innovation_rad = 0.0f, .used = false};

    if (stands(s, c, theta_e_rad, omega_e_radps, ts_s)) {
        s->lost = 1;
    }
    if (s->lost != 0) {
        return out;
    }
    if (base_within(error_rad, c->gate_rad)) { /* EQ-ANGLE-GATE-1 */
        s->beyond          = 0;
        out.innovation_rad = base_clamp(error_rad, -c->step_rad, c->step_rad); /* EQ-ANGLE-GATE-4 */
        out.used           = true;
    } else if (s->beyond < ANGLE_GATE_HOLD) {
        ignore(s, error_rad);
    } else if (base_within(frames_wrap(error_rad - s->first_rad), SAME_GATES * c->gate_rad)) {
        s->beyond    = 0;
        out.jump_rad = s->first_rad;
        out.innovation_rad =
            base_clamp(frames_wrap(error_rad - s->first_rad), -c->step_rad, c->step_rad);
    } else {
        s->lost = 1;
    }
    return out;
}
