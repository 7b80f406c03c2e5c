/* SPDX-License-Identifier: MIT */
#include "fields_foc.h"

static void axis(fields_t *f, foc_axis_t *c)
{
    fields_float(f, FIELD(f, c, kp_V_per_A));
    fields_float(f, FIELD(f, c, ki_tick));
    fields_float(f, FIELD(f, c, ki_per_kp));
}

void fields_foc(fields_t *f, foc_config_t *c)
{
    FIELDS_PART(axis, f, c, d);
    FIELDS_PART(axis, f, c, q);
    fields_float(f, FIELD(f, c, current_max_A));
    fields_float(f, FIELD(f, c, iq_max_A));
    fields_float(f, FIELD(f, c, mtpa_A));
    fields_float(f, FIELD(f, c, id_min_A));
    fields_float(f, FIELD(f, c, voltage_share));
    fields_float(f, FIELD(f, c, weakening_A_per_V));
}

void fields_speed_difference(fields_t *f, speed_difference_config_t *c)
{
    fields_i16(f, FIELD(f, c, periods));
    fields_float(f, FIELD(f, c, inv_span_1ps));
    fields_float(f, FIELD(f, c, edge_gap_max_s));
    fields_float(f, FIELD(f, c, count_rad));
}

void fields_speed_observer(fields_t *f, speed_observer_gains_t *c)
{
    fields_float(f, FIELD(f, c, gain_w));
    fields_float(f, FIELD(f, c, gain_f_1ps));
}
