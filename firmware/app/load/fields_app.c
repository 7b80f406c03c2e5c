/* SPDX-License-Identifier: MIT */
#include "fields_app.h"

static void setup(fields_t *f, board_setup_t *c)
{
    fields_u32(f, FIELD(f, c, pwm_cycles));
    fields_u16(f, FIELD(f, c, duty_full_cnt));
    fields_u16(f, FIELD(f, c, dead_time_cnt));
    fields_u16(f, FIELD(f, c, positions));
    fields_u16(f, FIELD(f, c, current_sensors));
    fields_u16(f, FIELD(f, c, chopper));
}

static void scale(fields_t *f, app_scale_config_t *c)
{
    fields_float(f, FIELD(f, c, current_A_per_cnt));
    fields_float(f, FIELD(f, c, current_zero_cnt));
    fields_float(f, FIELD(f, c, offset_max_cnt));
    fields_float(f, FIELD(f, c, dc_link_V_per_cnt));
    fields_u16(f, FIELD(f, c, ntc_first_cnt));
    fields_u16(f, FIELD(f, c, ntc_step_cnt));
    fields_u16(f, FIELD(f, c, ntc_points));
}

static void angle(fields_t *f, app_angle_config_t *c)
{
    fields_float(f, FIELD(f, c, index_theta_e_rad));
    fields_u16(f, FIELD(f, c, index_tolerance_cnt));
    fields_u16(f, FIELD(f, c, index_correct_max_cnt));
    fields_u16(f, FIELD(f, c, jump_cnt));
}

static void align(fields_t *f, app_align_config_t *c)
{
    fields_float(f, FIELD(f, c, current_A));
    fields_float(f, FIELD(f, c, bandwidth_radps));
    fields_float(f, FIELD(f, c, theta_e_rad));
    fields_u32(f, FIELD(f, c, watch_ticks));
    fields_u32(f, FIELD(f, c, ramp_ticks));
    fields_u32(f, FIELD(f, c, sweep_ticks));
    fields_u32(f, FIELD(f, c, settle_ticks));
    fields_u32(f, FIELD(f, c, still_ticks));
    fields_u16(f, FIELD(f, c, still_cnt));
    fields_u16(f, FIELD(f, c, quarter_error_cnt));
}

static void gate(fields_t *f, app_gate_config_t *c)
{
    fields_u16(f, FIELD(f, c, precharge_ticks));
    fields_float(f, FIELD(f, c, precharge_speed_e_radps));
    fields_u16(f, FIELD(f, c, duty_max_cnt));
    fields_u16(f, FIELD(f, c, pulse_min_cnt));
}

static void stop(fields_t *f, app_stop_config_t *c)
{
    uint16_t reaction = (uint16_t)c->reaction;

    FIELDS_NAME(f, reaction);
    fields_u16(f, &reaction);
    c->reaction = (reaction == (uint16_t)APP_STOP_RAMP) ? APP_STOP_RAMP : APP_STOP_COAST;
    fields_float(f, FIELD(f, c, still_e_radps));
    fields_flag(f, FIELD(f, c, short_circuit));
}

static void heat(fields_t *f, app_watch_heat_config_t *c)
{
    fields_float(f, FIELD(f, c, motor_A));
    fields_float(f, FIELD(f, c, motor_s));
    fields_float(f, FIELD(f, c, inverter_A));
    fields_float(f, FIELD(f, c, inverter_s));
}

static void chopper(fields_t *f, app_chopper_config_t *c)
{
    fields_u16(f, FIELD(f, c, on_cnt));
    fields_u16(f, FIELD(f, c, off_cnt));
    fields_float(f, FIELD(f, c, per_V2));
    fields_float(f, FIELD(f, c, tau_s));
}

void fields_app(fields_t *f, app_config_t *c)
{
    FIELDS_PART(setup, f, c, board);
    fields_float(f, FIELD(f, c, pwm_period_s));
    fields_float(f, FIELD(f, c, dead_time_s));
    FIELDS_PART(scale, f, c, scale);
    FIELDS_PART(angle, f, c, angle);
    FIELDS_PART(align, f, c, align);
    FIELDS_PART(gate, f, c, gate);
    FIELDS_PART(stop, f, c, stop);
    FIELDS_PART(heat, f, c, heat);
    FIELDS_PART(chopper, f, c, chopper);
    fields_float(f, FIELD(f, c, zero_drift_A));
    fields_float(f, FIELD(f, c, temperature_limit_degC));
    fields_float(f, FIELD(f, c, temperature_trip_degC));
    fields_u16(f, FIELD(f, c, boot_ticks));
    fields_u16(f, FIELD(f, c, calibrate_ticks));
    fields_u16(f, FIELD(f, c, background_ticks));
    fields_u16(f, FIELD(f, c, modbus_address));
    fields_u16(f, FIELD(f, c, modbus_gap_ticks));
    fields_u16(f, FIELD(f, c, modbus_timeout_ticks));
}
