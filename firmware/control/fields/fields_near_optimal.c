/* SPDX-License-Identifier: MIT */
#include "fields_near_optimal.h"

static void current_ref(fields_t *f, current_ref_config_t *c)
{
    fields_float(f, FIELD(f, c, current_max_A));
    fields_float(f, FIELD(f, c, iq_max_A));
    fields_float(f, FIELD(f, c, mtpa_A));
    fields_float(f, FIELD(f, c, mtpa_half_1pA));
    fields_flag(f, FIELD(f, c, mtpa_exact));
    fields_float(f, FIELD(f, c, circle_ApVs));
    fields_float(f, FIELD(f, c, torque_share));
    fields_float(f, FIELD(f, c, near_e_radps));
    fields_float(f, FIELD(f, c, id_rest_A));
    fields_float(f, FIELD(f, c, flux_A));
    fields_float(f, FIELD(f, c, l1_min));
    fields_float(f, FIELD(f, c, mtpa_per_period));
    fields_float(f, FIELD(f, c, weakening_per_period));
    fields_float(f, FIELD(f, c, chord_from));
    fields_float(f, FIELD(f, c, chord_slope));
    fields_float(f, FIELD(f, c, samples_1ps));
    fields_float(f, FIELD(f, c, regen_max_W_norm));
    fields_float(f, FIELD(f, c, regen_start_V));
    fields_float(f, FIELD(f, c, regen_per_V));
}

static void nosc(fields_t *f, nosc_gains_t *c)
{
    fields_i16(f, FIELD(f, c, order));
    fields_float(f, FIELD(f, c, iq_error_max_A));
    fields_float(f, FIELD(f, c, iq_speed_max_A));
    fields_float(f, FIELD(f, c, speed_A_per_radps));
    fields_float(f, FIELD(f, c, speed_radps_per_A));
    FIELDS_BEGIN(f, lambda);
    for (uint16_t i = 0U; i <= (uint16_t)NOSC_ORDER_MAX; i++) {
        for (uint16_t j = 0U; j < (uint16_t)NOSC_N_U; j++) {
            fields_floats(f, c->lambda[i][j], NOSC_N_E);
        }
    }
    FIELDS_END(f);
}

static void profile(fields_t *f, position_profile_t *c)
{
    fields_float(f, FIELD(f, c, speed_e_radps));
    fields_float(f, FIELD(f, c, accel_e_radps2));
    fields_float(f, FIELD(f, c, decel_e_radps2));
    fields_float(f, FIELD(f, c, jerk_e_radps3));
}

static void position(fields_t *f, position_gains_t *c)
{
    FIELDS_PART(nosc, f, c, nosc);
    FIELDS_BEGIN(f, theta);
    fields_floats(f, c->theta, NOSC_TERMS);
    FIELDS_END(f);
    fields_float(f, FIELD(f, c, speed_per_rad));
    fields_float(f, FIELD(f, c, near_rad));
    FIELDS_PART(profile, f, c, most);
}

void fields_near_optimal(fields_t *f, near_optimal_config_t *c)
{
    FIELDS_PART(current_ref, f, c, current_ref);
    FIELDS_PART(nosc, f, c, nosc);
    FIELDS_PART(position, f, c, position);
}
