/* SPDX-License-Identifier: MIT */
#include "fields_drive.h"

static void motor(fields_t *f, motor_reduced_t *c)
{
    fields_float(f, FIELD(f, c, l1));
    fields_float(f, FIELD(f, c, l2));
    fields_float(f, FIELD(f, c, l3));
    fields_float(f, FIELD(f, c, l4));
    fields_float(f, FIELD(f, c, l5));
    fields_float(f, FIELD(f, c, l6));
    fields_float(f, FIELD(f, c, l7));
    fields_float(f, FIELD(f, c, l8));
    fields_float(f, FIELD(f, c, l9));
    fields_float(f, FIELD(f, c, l10));
    fields_float(f, FIELD(f, c, l11));
    fields_float(f, FIELD(f, c, inv_l6));
    fields_float(f, FIELD(f, c, inv_l8));
}

static void dead_time(fields_t *f, dead_time_config_t *c)
{
    fields_float(f, FIELD(f, c, share));
    fields_float(f, FIELD(f, c, inv_fade_1pA));
}

static void hardware(fields_t *f, drive_hardware_t *c)
{
    fields_u32(f, FIELD(f, c, encoder_positions));
    fields_u16(f, FIELD(f, c, pole_pairs));
    fields_u16(f, FIELD(f, c, updates_per_period));
    fields_float(f, FIELD(f, c, dead_time_s));
    fields_flag(f, FIELD(f, c, edge_times));
}

void fields_drive(fields_t *f, drive_config_t *c)
{
    fields_float(f, FIELD(f, c, ts_s));
    fields_float(f, FIELD(f, c, current_max_A));
    fields_float(f, FIELD(f, c, trip_current_A));
    fields_float(f, FIELD(f, c, trip_speed_e_radps));
    fields_float(f, FIELD(f, c, speed_max_e_radps));
    fields_float(f, FIELD(f, c, dc_link_min_V));
    fields_float(f, FIELD(f, c, dc_link_max_V));
    fields_flag(f, FIELD(f, c, positions));
    fields_flag(f, FIELD(f, c, overmodulation));
    FIELDS_PART(motor, f, c, motor);
    FIELDS_PART(dead_time, f, c, dead_time);
    fields_float(f, FIELD(f, c, rated_current_A));
    fields_float(f, FIELD(f, c, rated_torque_Nm));
    fields_flag(f, FIELD(f, c, torques));
    FIELDS_PART(hardware, f, c, hardware);
}
