/* SPDX-License-Identifier: MIT */
#include "current_gate.h"

#include "check.h"
#include "frames.h"

#define LAST_THREE 7U

CTL_PART void current_gate_reset(current_gate_t *s)
{
    const current_gate_t quiet = {.recent = 0U, .jumped = false, .ignored = 0U};

    *s = quiet;
}

static bool is_number(float i_A)
{
    return base_within(i_A, CHECK_LARGEST);
}

/* One comparison for both phases. A current that is no number is beyond the trip level. */
static bool is_far(float ia_A, float ib_A, const current_gate_input_t *in)
{
    const float a_A = fabsf(ia_A - in->i_hat_A.a);
    const float b_A = fabsf(ib_A - in->i_hat_A.b);

    return in->expected && !(base_max(a_A, b_A) <= in->jump_A);
}

CTL_PART current_gate_verdict_t current_gate_judge(current_gate_t *s, float ia_A, float ib_A,
                                                   const current_gate_input_t *in)
{
    const bool     beyond = sample_over_current(ia_A, ib_A, in->trip_A);
    const bool     far    = is_far(ia_A, ib_A, in);
    const uint16_t before = (uint16_t)(((uint16_t)(s->recent << 1)) & LAST_THREE);

    if (!beyond && !far) {
        s->recent = before;
        s->jumped = false;
        return CURRENT_GATE_GOOD;
    }
    const bool spike = beyond || !s->jumped;

    s->recent = (uint16_t)(before | (beyond ? 1U : 0U));
    s->jumped = far;
    if (beyond && (!in->expected || (before != 0U) || !is_number(ia_A) || !is_number(ib_A))) {
        return CURRENT_GATE_TRIP;
    }
    if (spike && (s->ignored < UINT16_MAX)) {
        s->ignored = (uint16_t)(s->ignored + 1U);
    }
    return spike ? CURRENT_GATE_SPIKE : CURRENT_GATE_GOOD;
}

CTL_PART drive_sample_t current_gate_replaced(const drive_sample_t *s, dq_t i_A, float theta_rad)
{
    const abc_t    i_abc = frames_inverse_clarke(frames_inverse_park(i_A, frames_angle(theta_rad)));
    drive_sample_t out   = *s;

    out.ia_A = i_abc.a;
    out.ib_A = i_abc.b;
    return out;
}
