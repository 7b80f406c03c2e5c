/* SPDX-License-Identifier: MIT */
#include "inertia.h"

#include "fpu.h"

/* Chosen by simulation: the error falls to a third in 50 periods of full acceleration. Three times
 * this share lets motions with five times the inertia pass their targets by 100 counts. */
#define LEARN 0.02f

/* Least acceleration that teaches, of the largest. Chosen: half of this lets friction teach. */
#define TEACHES 0.15f

void inertia_learn(inertia_t *j, const inertia_seen_t *seen)
{
    const float asked = seen->asked_e_radps2;
    const float least = TEACHES * seen->most_e_radps2;

    if ((fabsf(asked) > least) && ((asked * seen->seen_e_radps2) > 0.0f)) {
        const float error = seen->more_e_radps2 - ((1.0f - j->ratio) * seen->seen_e_radps2);
        const float step  = LEARN * error * asked * fpu_inverse((asked * asked) + (least * least));

        j->ratio = base_clamp(j->ratio - step, INERTIA_LEAST, INERTIA_MOST);
        j->gain  = base_min(inertia_gain(j->ratio), j->gain_most);
    }
}

float inertia_ahead(inertia_t *j, float accel_e_radps2)
{
    const float change = accel_e_radps2 - j->accel_e_radps2;

    j->accel_e_radps2 = accel_e_radps2;
    return (1.0f - j->ratio) * change;
}
