/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
/* Does not compile if a member has another type than its row says, or an enumeration another size. */
#ifndef REGISTER_TYPES_H
#define REGISTER_TYPES_H

#define IS(t, m, type) (void)sizeof((1) ? &((const t *)0)->m : (const type *)0)
#define FITS(type) \
    (void)sizeof(char[((sizeof(type) == 1U) || (sizeof(type) == sizeof(int))) ? 1 : -1])

static void register_types(void)
{
    IS(app_config_t, temperature_limit_degC, float);
    IS(app_config_t, temperature_trip_degC, float);
    IS(app_registers_request_t, can_node, uint16_t);
    IS(app_registers_request_t, can_rate_kbps, uint16_t);
    IS(app_registers_request_t, line.baud_Bd, uint32_t);
    IS(app_registers_request_t, line.direction, uint16_t);
    IS(app_registers_request_t, line.format, uint16_t);
    IS(app_registers_request_t, modbus_address, uint16_t);
    IS(app_registers_request_t, objects.accel_e_radps2, float);
    IS(app_registers_request_t, objects.bounds.current_A, float);
    IS(app_registers_request_t, objects.bounds.speed_m_radps, float);
    IS(app_registers_request_t, objects.controlword, uint16_t);
    IS(app_registers_request_t, objects.current_max_A, float);
    IS(app_registers_request_t, objects.decel_e_radps2, float);
    IS(app_registers_request_t, objects.disable_option, int16_t);
    IS(app_registers_request_t, objects.following_s, float);
    IS(app_registers_request_t, objects.interpolation_s, float);
    IS(app_registers_request_t, objects.jerk_e_radps3, float);
    IS(app_registers_request_t, objects.lost_option, int16_t);
    IS(app_registers_request_t, objects.mode_of_operation, int16_t);
    IS(app_registers_request_t, objects.omega_e_radps, float);
    IS(app_registers_request_t, objects.omega_offset_e_radps, float);
    IS(app_registers_request_t, objects.profile_e_radps, float);
    IS(app_registers_request_t, objects.quick_e_radps2, float);
    IS(app_registers_request_t, objects.quick_option, int16_t);
    IS(app_registers_request_t, objects.shutdown_option, int16_t);
    IS(app_registers_request_t, objects.torque_most, float);
    IS(app_registers_request_t, objects.torque_offset, float);
    IS(app_registers_request_t, objects.torque_share, float);
    IS(app_registers_request_t, objects.torque_slope_1ps, float);
    IS(app_registers_request_t, objects.torque_speed_max_e_radps, float);
    IS(app_registers_request_t, objects.window_e_radps, float);
    IS(app_registers_request_t, positions.following_window, uint32_t);
    IS(app_registers_request_t, positions.least, int32_t);
    IS(app_registers_request_t, positions.most, int32_t);
    IS(app_registers_request_t, positions.offset, int32_t);
    IS(app_registers_request_t, positions.target, int32_t);
    IS(app_registers_request_t, positions.window, uint16_t);
    IS(app_registers_request_t, scope.before, uint16_t);
    IS(app_registers_request_t, scope.decimation, uint16_t);
    IS(app_registers_request_t, scope.level, float);
    IS(app_registers_request_t, scope.signal[0], uint16_t);
    IS(app_registers_request_t, scope.signal[1], uint16_t);
    IS(app_registers_request_t, scope.signal[2], uint16_t);
    IS(app_registers_request_t, scope.signal[3], uint16_t);
    IS(app_registers_request_t, scope.trigger, uint16_t);
    IS(app_registers_request_t, units.feed, uint32_t);
    IS(app_registers_request_t, units.feed_shaft, uint16_t);
    IS(app_registers_request_t, units.gear_motor, uint16_t);
    IS(app_registers_request_t, units.gear_shaft, uint16_t);
    IS(app_registers_request_t, units.polarity, uint16_t);
    IS(app_status_t, align_stage, app_align_stage_t);
    IS(app_status_t, board_faults, uint16_t);
    IS(app_status_t, commission.found.coulomb_Nm.error, float);
    IS(app_status_t, commission.found.coulomb_Nm.value, float);
    IS(app_status_t, commission.found.counts_per_turn, int32_t);
    IS(app_status_t, commission.found.coupling, commission_coupling_t);
    IS(app_status_t, commission.found.damping.error, float);
    IS(app_status_t, commission.found.damping.value, float);
    IS(app_status_t, commission.found.direction, int16_t);
    IS(app_status_t, commission.found.flux_Wb.error, float);
    IS(app_status_t, commission.found.flux_Wb.value, float);
    IS(app_status_t, commission.found.friction_Nms.error, float);
    IS(app_status_t, commission.found.friction_Nms.value, float);
    IS(app_status_t, commission.found.inertia_kgm2.error, float);
    IS(app_status_t, commission.found.inertia_kgm2.value, float);
    IS(app_status_t, commission.found.ld_H.error, float);
    IS(app_status_t, commission.found.ld_H.value, float);
    IS(app_status_t, commission.found.load_share.error, float);
    IS(app_status_t, commission.found.load_share.value, float);
    IS(app_status_t, commission.found.lq_H.error, float);
    IS(app_status_t, commission.found.lq_H.value, float);
    IS(app_status_t, commission.found.offset_rad.error, float);
    IS(app_status_t, commission.found.offset_rad.value, float);
    IS(app_status_t, commission.found.pole_pairs, int16_t);
    IS(app_status_t, commission.found.r_Ohm.error, float);
    IS(app_status_t, commission.found.r_Ohm.value, float);
    IS(app_status_t, commission.found.reluctance, bool);
    IS(app_status_t, commission.found.resonance_Hz.error, float);
    IS(app_status_t, commission.found.resonance_Hz.value, float);
    IS(app_status_t, commission.found.searched_Hz, float);
    IS(app_status_t, commission.found.v_loss_V.error, float);
    IS(app_status_t, commission.found.v_loss_V.value, float);
    IS(app_status_t, commission.percent, int16_t);
    IS(app_status_t, commission.reason, commission_reason_t);
    IS(app_status_t, commission.stage, commission_stage_t);
    IS(app_status_t, dc_link_V, float);
    IS(app_status_t, demand_e_radps, float);
    IS(app_status_t, derating, float);
    IS(app_status_t, drive_fault, drive_fault_t);
    IS(app_status_t, fault, app_fault_t);
    IS(app_status_t, i_A.d, float);
    IS(app_status_t, i_A.q, float);
    IS(app_status_t, i_ref_A.d, float);
    IS(app_status_t, i_ref_A.q, float);
    IS(app_status_t, ignored_angles, uint16_t);
    IS(app_status_t, ignored_currents, uint16_t);
    IS(app_status_t, index_corrections, uint16_t);
    IS(app_status_t, inverter_heat, float);
    IS(app_status_t, mode, app_mode_t);
    IS(app_status_t, mode_of_operation, int16_t);
    IS(app_status_t, motor_heat, float);
    IS(app_status_t, phase_errors, uint16_t);
    IS(app_status_t, position_cnt, uint16_t);
    IS(app_status_t, position_jumps, uint16_t);
    IS(app_status_t, reference, app_angle_reference_t);
    IS(app_status_t, reset_cause, board_reset_t);
    IS(app_status_t, snapshot.board_faults, uint16_t);
    IS(app_status_t, snapshot.drive_fault, drive_fault_t);
    IS(app_status_t, snapshot.fault, app_fault_t);
    IS(app_status_t, snapshot.mode, app_mode_t);
    IS(app_status_t, snapshot.raw.dc_link_cnt, uint16_t);
    IS(app_status_t, snapshot.raw.ia_cnt, uint16_t);
    IS(app_status_t, snapshot.raw.ib_cnt, uint16_t);
    IS(app_status_t, snapshot.raw.index_cnt, uint16_t);
    IS(app_status_t, snapshot.raw.position_cnt, uint16_t);
    IS(app_status_t, snapshot.raw.temperature_cnt, uint16_t);
    IS(app_status_t, snapshot.speed_e_radps, float);
    IS(app_status_t, snapshot.ticks, uint32_t);
    IS(app_status_t, snapshot.wanted_e_radps, float);
    IS(app_status_t, speed_e_radps, float);
    IS(app_status_t, temperature_degC, float);
    IS(app_status_t, theta_e_rad, float);
    IS(app_status_t, tick_cycles, uint16_t);
    IS(app_status_t, tick_cycles_worst, uint16_t);
    IS(app_status_t, ticks, uint32_t);
    IS(app_status_t, torque_demand_share, float);
    IS(app_status_t, torque_share, float);
    IS(app_status_t, v_V.d, float);
    IS(app_status_t, v_V.q, float);
    IS(app_status_t, zero_a_cnt, float);
    IS(app_status_t, zero_b_cnt, float);
    IS(drive_config_t, current_max_A, float);
    IS(drive_config_t, dc_link_max_V, float);
    IS(drive_config_t, dc_link_min_V, float);
    IS(drive_config_t, hardware.encoder_positions, uint32_t);
    IS(drive_config_t, hardware.pole_pairs, uint16_t);
    IS(drive_config_t, rated_current_A, float);
    IS(drive_config_t, rated_torque_Nm, float);
    IS(drive_config_t, speed_max_e_radps, float);
    IS(drive_config_t, trip_current_A, float);
    IS(drive_config_t, trip_speed_e_radps, float);
    IS(drive_config_t, ts_s, float);
    FITS(app_align_stage_t);
    FITS(app_angle_reference_t);
    FITS(app_fault_t);
    FITS(app_mode_t);
    FITS(board_reset_t);
    FITS(commission_coupling_t);
    FITS(commission_reason_t);
    FITS(commission_stage_t);
    FITS(drive_fault_t);
}

#endif /* REGISTER_TYPES_H */
