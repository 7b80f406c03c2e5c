/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
#include "app_registers.h"

#include <stddef.h>

/* Offset of a member. Test unit.app_registers compares its type. */
#define AT(t, m) ((uint16_t)offsetof(t, m))

/* An enumeration is as short as a char, or an int. */
#define OF_ENUM(t) \
    ((sizeof(t) == sizeof(unsigned char)) ? APP_REGISTERS_AS_CHAR : APP_REGISTERS_AS_INT)

const app_registers_entry_t app_registers_map_holding[APP_REGISTERS_MAP_HOLDING] = {
    {APP_REGISTERS_CONTROLWORD, APP_REGISTERS_U16, 0.0f, 0.0f, 65535.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, objects.controlword), false},
    {APP_REGISTERS_MODE_OF_OPERATION, APP_REGISTERS_I16, 0.0f, -1.0f, 10.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I16, AT(app_registers_request_t, objects.mode_of_operation), false},
    {APP_REGISTERS_SPEED, APP_REGISTERS_I32, 10.0f, -1000000.0f, 1000000.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.omega_e_radps), false},
    {APP_REGISTERS_SPEED_RPM, APP_REGISTERS_I32, 10.0f, -10000000.0f, 10000000.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.omega_e_radps), true},
    {APP_REGISTERS_SPEED_RPM_16, APP_REGISTERS_I16, 1.0f, -32768.0f, 32767.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.omega_e_radps), true},
    {APP_REGISTERS_ACCELERATION, APP_REGISTERS_U32, 1.0f, 0.0f, 1000000.0f, false, 0xE69AU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.accel_e_radps2), false},
    {APP_REGISTERS_DECELERATION, APP_REGISTERS_U32, 1.0f, 0.0f, 1000000.0f, false, 0xF39AU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.decel_e_radps2), false},
    {APP_REGISTERS_QUICK_STOP_DECELERATION, APP_REGISTERS_U32, 1.0f, 0.0f, 1000000.0f, false, 0x5374U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.quick_e_radps2), false},
    {APP_REGISTERS_QUICK_STOP_OPTION, APP_REGISTERS_I16, 0.0f, 0.0f, 6.0f, false, 0x5E5CU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I16, AT(app_registers_request_t, objects.quick_option), false},
    {APP_REGISTERS_SHUTDOWN_OPTION, APP_REGISTERS_I16, 0.0f, 0.0f, 1.0f, false, 0x71C5U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I16, AT(app_registers_request_t, objects.shutdown_option), false},
    {APP_REGISTERS_DISABLE_OPTION, APP_REGISTERS_I16, 0.0f, 0.0f, 1.0f, false, 0xC3CAU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I16, AT(app_registers_request_t, objects.disable_option), false},
    {APP_REGISTERS_LOST_OPTION, APP_REGISTERS_I16, 0.0f, 2.0f, 3.0f, false, 0x8547U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I16, AT(app_registers_request_t, objects.lost_option), false},
    {APP_REGISTERS_MAX_CURRENT, APP_REGISTERS_I32, 1000.0f, 0.0f, 1000000.0f, false, 0xCE5FU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.current_max_A), false},
    {APP_REGISTERS_SPEED_WINDOW, APP_REGISTERS_U16, 10.0f, 0.0f, 6553.5f, false, 0x1933U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.window_e_radps), false},
    {APP_REGISTERS_COMMISSION_CURRENT, APP_REGISTERS_U16, 100.0f, 0.0f, 655.35f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.bounds.current_A), false},
    {APP_REGISTERS_COMMISSION_SPEED, APP_REGISTERS_U16, 10.0f, 0.0f, 6553.5f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.bounds.speed_m_radps), false},
    {APP_REGISTERS_INERTIA_START, APP_REGISTERS_U16, 0.0f, 0.0f, 5000.0f, false, 0x77A7U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 0U, false},
    {APP_REGISTERS_MODBUS_ADDRESS, APP_REGISTERS_U16, 0.0f, 1.0f, 247.0f, false, 0xB5EFU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, modbus_address), false},
    {APP_REGISTERS_MODBUS_TIMEOUT, APP_REGISTERS_U16, 1000.0f, 0.01f, 60.0f, false, 0x974DU, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 1U, false},
    {APP_REGISTERS_BAUD_RATE, APP_REGISTERS_U32, 0.0f, 9600.0f, 115200.0f, true, 0x76FFU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U32, AT(app_registers_request_t, line.baud_Bd), false},
    {APP_REGISTERS_LINE_FORMAT, APP_REGISTERS_U16, 0.0f, 0.0f, 2.0f, true, 0x949EU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, line.format), false},
    {APP_REGISTERS_DIRECTION_PIN, APP_REGISTERS_U16, 0.0f, 0.0f, 1.0f, true, 0x00A7U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, line.direction), false},
    {APP_REGISTERS_SCOPE_COMMAND, APP_REGISTERS_U16, 0.0f, 0.0f, 2.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 2U, false},
    {APP_REGISTERS_SCOPE_SIGNAL_1, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.signal[0]), false},
    {APP_REGISTERS_SCOPE_SIGNAL_2, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.signal[1]), false},
    {APP_REGISTERS_SCOPE_SIGNAL_3, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.signal[2]), false},
    {APP_REGISTERS_SCOPE_SIGNAL_4, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.signal[3]), false},
    {APP_REGISTERS_SCOPE_DECIMATION, APP_REGISTERS_U16, 0.0f, 1.0f, 65535.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.decimation), false},
    {APP_REGISTERS_SCOPE_TRIGGER, APP_REGISTERS_U16, 0.0f, 0.0f, 2.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.trigger), false},
    {APP_REGISTERS_SCOPE_CHANNEL, APP_REGISTERS_U16, 0.0f, 1.0f, 4.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 3U, false},
    {APP_REGISTERS_SCOPE_LEVEL, APP_REGISTERS_I32, 1000.0f, -1000000.0f, 1000000.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, scope.level), false},
    {APP_REGISTERS_SCOPE_BEFORE, APP_REGISTERS_U16, 0.0f, 0.0f, 511.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, scope.before), false},
    {APP_REGISTERS_STORE_PARAMETERS, APP_REGISTERS_U32, 0.0f, 1.70225701e+09f, 1.70225701e+09f, false, 0x0000U, 0x65766173UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 4U, false},
    {APP_REGISTERS_RESTORE_PARAMETERS, APP_REGISTERS_U32, 0.0f, 1.68410712e+09f, 1.68410712e+09f, false, 0x0000U, 0x64616F6CUL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 5U, false},
    {APP_REGISTERS_ACCEPT_FALLBACK, APP_REGISTERS_U32, 0.0f, 1.70153612e+09f, 1.70153612e+09f, false, 0x0000U, 0x656B6174UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 6U, false},
    {APP_REGISTERS_TARGET_POSITION, APP_REGISTERS_I32, 0.0f, -1e+09f, 1e+09f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I32, AT(app_registers_request_t, objects.target_cnt), false},
    {APP_REGISTERS_PROFILE_VELOCITY, APP_REGISTERS_U32, 10.0f, 0.0f, 1000000.0f, false, 0xF4A4U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.profile_e_radps), false},
    {APP_REGISTERS_PROFILE_JERK, APP_REGISTERS_U32, 1.0f, 0.0f, 4e+09f, false, 0xF519U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.jerk_e_radps3), false},
    {APP_REGISTERS_POSITION_WINDOW, APP_REGISTERS_U16, 0.0f, 1.0f, 65535.0f, false, 0xA0A3U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, objects.position_window_cnt), false},
    {APP_REGISTERS_SENSOR_TRIM, APP_REGISTERS_U16, 0.0f, 0.0f, 1.0f, false, 0x8D42U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 7U, false},
    {APP_REGISTERS_TORQUE, APP_REGISTERS_I16, 1000.0f, -32.768f, 32.767f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.torque_share), false},
    {APP_REGISTERS_TORQUE_OFFSET, APP_REGISTERS_I16, 1000.0f, -32.768f, 32.767f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.torque_offset), false},
    {APP_REGISTERS_MAX_TORQUE, APP_REGISTERS_U16, 1000.0f, 0.0f, 33.0f, false, 0x3404U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.torque_most), false},
    {APP_REGISTERS_TORQUE_SLOPE, APP_REGISTERS_U32, 1000.0f, 0.0f, 1000000.0f, false, 0xF5F6U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.torque_slope_1ps), false},
    {APP_REGISTERS_TORQUE_SPEED_MAX, APP_REGISTERS_U32, 10.0f, 0.0f, 10000000.0f, false, 0x3BCBU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.torque_speed_max_e_radps), true},
    {APP_REGISTERS_MAX_CURRENT_SHARE, APP_REGISTERS_U16, 1000.0f, 0.0f, 65.535f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 8U, false},
    {APP_REGISTERS_VELOCITY_OFFSET, APP_REGISTERS_I32, 10.0f, -10000000.0f, 10000000.0f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.omega_offset_e_radps), true},
    {APP_REGISTERS_INTERPOLATION_PERIOD, APP_REGISTERS_U16, 1000.0f, 0.001f, 0.1f, false, 0x4703U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.interpolation_s), false},
    {APP_REGISTERS_POSITION_OFFSET, APP_REGISTERS_I32, 0.0f, -1e+09f, 1e+09f, false, 0x0000U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_I32, AT(app_registers_request_t, objects.offset_cnt), false},
    {APP_REGISTERS_FOLLOWING_WINDOW, APP_REGISTERS_U32, 0.0f, 0.0f, 1e+09f, false, 0x1241U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U32, AT(app_registers_request_t, objects.following_window_cnt), false},
    {APP_REGISTERS_FOLLOWING_TIMEOUT, APP_REGISTERS_U16, 1000.0f, 0.0f, 65.535f, false, 0x8EF2U, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_FLOAT, AT(app_registers_request_t, objects.following_s), false},
    {APP_REGISTERS_CAN_NODE, APP_REGISTERS_U16, 0.0f, 1.0f, 127.0f, false, 0x017FU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, can_node), false},
    {APP_REGISTERS_CAN_RATE, APP_REGISTERS_U16, 0.0f, 125.0f, 1000.0f, false, 0x474BU, 0UL, APP_REGISTERS_REQUESTED, APP_REGISTERS_AS_U16, AT(app_registers_request_t, can_rate_kbps), false},
};

const app_registers_entry_t app_registers_map_input[APP_REGISTERS_MAP_INPUT] = {
    {APP_REGISTERS_STATUSWORD, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 9U, false},
    {APP_REGISTERS_MODE_NOW, APP_REGISTERS_I16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_I16, AT(app_status_t, mode_of_operation), false},
    {APP_REGISTERS_ERROR_CODE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 10U, false},
    {APP_REGISTERS_MODE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(app_mode_t), AT(app_status_t, mode), false},
    {APP_REGISTERS_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(app_fault_t), AT(app_status_t, fault), false},
    {APP_REGISTERS_DRIVE_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(drive_fault_t), AT(app_status_t, drive_fault), false},
    {APP_REGISTERS_BOARD_FAULTS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, board_faults), false},
    {APP_REGISTERS_CONDITIONS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 11U, false},
    {APP_REGISTERS_REFERENCE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(app_angle_reference_t), AT(app_status_t, reference), false},
    {APP_REGISTERS_ALIGN_STAGE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(app_align_stage_t), AT(app_status_t, align_stage), false},
    {APP_REGISTERS_SPEED_NOW, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, speed_e_radps), false},
    {APP_REGISTERS_SPEED_NOW_RPM, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, speed_e_radps), true},
    {APP_REGISTERS_SPEED_DEMAND_RPM, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, demand_e_radps), true},
    {APP_REGISTERS_IQ, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, i_A.q), false},
    {APP_REGISTERS_ID, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, i_A.d), false},
    {APP_REGISTERS_IQ_REF, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, i_ref_A.q), false},
    {APP_REGISTERS_ID_REF, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, i_ref_A.d), false},
    {APP_REGISTERS_VQ, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, v_V.q), false},
    {APP_REGISTERS_VD, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, v_V.d), false},
    {APP_REGISTERS_DC_LINK, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, dc_link_V), false},
    {APP_REGISTERS_TEMPERATURE, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, temperature_degC), false},
    {APP_REGISTERS_THETA, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, theta_e_rad), false},
    {APP_REGISTERS_POSITION, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, position_cnt), false},
    {APP_REGISTERS_CORRECTIONS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, index_corrections), false},
    {APP_REGISTERS_ZERO_A, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, zero_a_cnt), false},
    {APP_REGISTERS_ZERO_B, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, zero_b_cnt), false},
    {APP_REGISTERS_CYCLES, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, tick_cycles), false},
    {APP_REGISTERS_CYCLES_WORST, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, tick_cycles_worst), false},
    {APP_REGISTERS_TICKS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U32, AT(app_status_t, ticks), false},
    {APP_REGISTERS_RESET_CAUSE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(board_reset_t), AT(app_status_t, reset_cause), false},
    {APP_REGISTERS_PHASE_ERRORS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, phase_errors), false},
    {APP_REGISTERS_IGNORED_ANGLES, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, ignored_angles), false},
    {APP_REGISTERS_IGNORED_CURRENTS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, ignored_currents), false},
    {APP_REGISTERS_JUMPS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, position_jumps), false},
    {APP_REGISTERS_MOTOR_HEAT, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, motor_heat), false},
    {APP_REGISTERS_INVERTER_HEAT, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, inverter_heat), false},
    {APP_REGISTERS_DERATING, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, derating), false},
    {APP_REGISTERS_FIRST_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(app_fault_t), AT(app_status_t, snapshot.fault), false},
    {APP_REGISTERS_FIRST_MODE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(app_mode_t), AT(app_status_t, snapshot.mode), false},
    {APP_REGISTERS_FIRST_DRIVE_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(drive_fault_t), AT(app_status_t, snapshot.drive_fault), false},
    {APP_REGISTERS_FIRST_BOARD_FAULTS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.board_faults), false},
    {APP_REGISTERS_FIRST_IA, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.raw.ia_cnt), false},
    {APP_REGISTERS_FIRST_IB, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.raw.ib_cnt), false},
    {APP_REGISTERS_FIRST_DC_LINK, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.raw.dc_link_cnt), false},
    {APP_REGISTERS_FIRST_TEMPERATURE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.raw.temperature_cnt), false},
    {APP_REGISTERS_FIRST_POSITION, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.raw.position_cnt), false},
    {APP_REGISTERS_FIRST_INDEX, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U16, AT(app_status_t, snapshot.raw.index_cnt), false},
    {APP_REGISTERS_FIRST_SAMPLE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 12U, false},
    {APP_REGISTERS_FIRST_SPEED, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, snapshot.speed_e_radps), false},
    {APP_REGISTERS_FIRST_WANTED, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, snapshot.wanted_e_radps), false},
    {APP_REGISTERS_FIRST_TICKS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_U32, AT(app_status_t, snapshot.ticks), false},
    {APP_REGISTERS_POSITION_NOW, APP_REGISTERS_I32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 13U, false},
    {APP_REGISTERS_POSITION_TARGET, APP_REGISTERS_I32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_I32, AT(app_status_t, target_cnt), false},
    {APP_REGISTERS_DISC_MAP, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 14U, false},
    {APP_REGISTERS_INERTIA_RATIO, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 15U, false},
    {APP_REGISTERS_INERTIA_CHANGES, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 16U, false},
    {APP_REGISTERS_RING_FREQUENCY, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 17U, false},
    {APP_REGISTERS_INERTIA_BELIEVED, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 18U, false},
    {APP_REGISTERS_TRIM_A, APP_REGISTERS_I16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 19U, false},
    {APP_REGISTERS_TRIM_B, APP_REGISTERS_I16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 20U, false},
    {APP_REGISTERS_TRIM_GAIN, APP_REGISTERS_I16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 21U, false},
    {APP_REGISTERS_TRIM_BLOCKS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 22U, false},
    {APP_REGISTERS_COMMISSION_STAGE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(commission_stage_t), AT(app_status_t, commission.stage), false},
    {APP_REGISTERS_COMMISSION_REASON, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(commission_reason_t), AT(app_status_t, commission.reason), false},
    {APP_REGISTERS_COMMISSION_PERCENT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_I16, AT(app_status_t, commission.percent), false},
    {APP_REGISTERS_FOUND_DIRECTION, APP_REGISTERS_I16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_I16, AT(app_status_t, commission.found.direction), false},
    {APP_REGISTERS_FOUND_POLE_PAIRS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_I16, AT(app_status_t, commission.found.pole_pairs), false},
    {APP_REGISTERS_FOUND_COUNTS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_I32, AT(app_status_t, commission.found.counts_per_turn), false},
    {APP_REGISTERS_FOUND_RELUCTANCE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_BOOL, AT(app_status_t, commission.found.reluctance), false},
    {APP_REGISTERS_FOUND_R, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.r_Ohm.value), false},
    {APP_REGISTERS_FOUND_R_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.r_Ohm.error), false},
    {APP_REGISTERS_FOUND_V_LOSS, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.v_loss_V.value), false},
    {APP_REGISTERS_FOUND_V_LOSS_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.v_loss_V.error), false},
    {APP_REGISTERS_FOUND_LD, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.ld_H.value), false},
    {APP_REGISTERS_FOUND_LD_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.ld_H.error), false},
    {APP_REGISTERS_FOUND_LQ, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.lq_H.value), false},
    {APP_REGISTERS_FOUND_LQ_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.lq_H.error), false},
    {APP_REGISTERS_FOUND_FLUX, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.flux_Wb.value), false},
    {APP_REGISTERS_FOUND_FLUX_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.flux_Wb.error), false},
    {APP_REGISTERS_FOUND_INERTIA, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.inertia_kgm2.value), false},
    {APP_REGISTERS_FOUND_INERTIA_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.inertia_kgm2.error), false},
    {APP_REGISTERS_FOUND_FRICTION, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.friction_Nms.value), false},
    {APP_REGISTERS_FOUND_FRICTION_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.friction_Nms.error), false},
    {APP_REGISTERS_FOUND_COULOMB, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.coulomb_Nm.value), false},
    {APP_REGISTERS_FOUND_COULOMB_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.coulomb_Nm.error), false},
    {APP_REGISTERS_FOUND_OFFSET, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.offset_rad.value), false},
    {APP_REGISTERS_FOUND_OFFSET_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.offset_rad.error), false},
    {APP_REGISTERS_FOUND_COUPLING, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, OF_ENUM(commission_coupling_t), AT(app_status_t, commission.found.coupling), false},
    {APP_REGISTERS_FOUND_SEARCHED, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.searched_Hz), false},
    {APP_REGISTERS_FOUND_RESONANCE, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.resonance_Hz.value), false},
    {APP_REGISTERS_FOUND_RESONANCE_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.resonance_Hz.error), false},
    {APP_REGISTERS_FOUND_DAMPING, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.damping.value), false},
    {APP_REGISTERS_FOUND_DAMPING_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.damping.error), false},
    {APP_REGISTERS_FOUND_LOAD_SHARE, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.load_share.value), false},
    {APP_REGISTERS_FOUND_LOAD_SHARE_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, commission.found.load_share.error), false},
    {APP_REGISTERS_SCOPE_STATE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 23U, false},
    {APP_REGISTERS_SCOPE_TICKS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 24U, false},
    {APP_REGISTERS_RECORD_NUMBER, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 25U, false},
    {APP_REGISTERS_RECORD_COUNT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 26U, false},
    {APP_REGISTERS_PARAMETERS_STATE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 27U, false},
    {APP_REGISTERS_PARAMETERS_DONE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 28U, false},
    {APP_REGISTERS_PARAMETERS_NUMBER, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 29U, false},
    {APP_REGISTERS_PARAMETERS_WRITES, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 30U, false},
    {APP_REGISTERS_PARAMETERS_DROPPED, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 31U, false},
    {APP_REGISTERS_SUPPORTED_MODES, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 32U, false},
    {APP_REGISTERS_POLE_PAIRS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_U16, AT(drive_config_t, hardware.pole_pairs), false},
    {APP_REGISTERS_ENCODER_POSITIONS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_U32, AT(drive_config_t, hardware.encoder_positions), false},
    {APP_REGISTERS_CONTROL_PERIOD, APP_REGISTERS_U32, 1e+09f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, ts_s), false},
    {APP_REGISTERS_SPEED_MAX, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, speed_max_e_radps), false},
    {APP_REGISTERS_SPEED_MAX_RPM, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, speed_max_e_radps), true},
    {APP_REGISTERS_SPEED_TRIP, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, trip_speed_e_radps), false},
    {APP_REGISTERS_CURRENT_MAX, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, current_max_A), false},
    {APP_REGISTERS_CURRENT_TRIP, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, trip_current_A), false},
    {APP_REGISTERS_DC_LINK_MIN, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, dc_link_min_V), false},
    {APP_REGISTERS_DC_LINK_MAX, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, dc_link_max_V), false},
    {APP_REGISTERS_TEMPERATURE_LIMIT, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_CONFIG, APP_REGISTERS_AS_FLOAT, AT(app_config_t, temperature_limit_degC), false},
    {APP_REGISTERS_TEMPERATURE_TRIP, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_CONFIG, APP_REGISTERS_AS_FLOAT, AT(app_config_t, temperature_trip_degC), false},
    {APP_REGISTERS_FOUND_MAP_STEP, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 33U, false},
    {APP_REGISTERS_FOUND_MAP_BIAS, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 34U, false},
    {APP_REGISTERS_FOUND_LD_POSITIVE_1, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 35U, false},
    {APP_REGISTERS_FOUND_LD_POSITIVE_2, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 36U, false},
    {APP_REGISTERS_FOUND_LD_POSITIVE_3, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 37U, false},
    {APP_REGISTERS_FOUND_LD_POSITIVE_4, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 38U, false},
    {APP_REGISTERS_FOUND_LD_NEGATIVE_1, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 39U, false},
    {APP_REGISTERS_FOUND_LD_NEGATIVE_2, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 40U, false},
    {APP_REGISTERS_FOUND_LD_NEGATIVE_3, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 41U, false},
    {APP_REGISTERS_FOUND_LD_NEGATIVE_4, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 42U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_0_1, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 43U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_0_2, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 44U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_0_3, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 45U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_0_4, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 46U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_1_1, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 47U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_1_2, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 48U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_1_3, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 49U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_1_4, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 50U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_2_1, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 51U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_2_2, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 52U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_2_3, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 53U, false},
    {APP_REGISTERS_FOUND_LQ_BESIDE_2_4, APP_REGISTERS_U16, 10000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_COMPUTED, APP_REGISTERS_AS_U16, 54U, false},
    {APP_REGISTERS_TORQUE_NOW, APP_REGISTERS_I16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, torque_share), false},
    {APP_REGISTERS_TORQUE_DEMAND, APP_REGISTERS_I16, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_STATUS, APP_REGISTERS_AS_FLOAT, AT(app_status_t, torque_demand_share), false},
    {APP_REGISTERS_RATED_CURRENT, APP_REGISTERS_U32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, rated_current_A), false},
    {APP_REGISTERS_RATED_TORQUE, APP_REGISTERS_U32, 1000.0f, 0.0f, 0.0f, false, 0x0000U, 0UL, APP_REGISTERS_DRIVE, APP_REGISTERS_AS_FLOAT, AT(drive_config_t, rated_torque_Nm), false},
};

float app_registers_map_real(const app_registers_t *r, uint16_t number)
{
    float x = 0.0f;

    switch (number) {
    case 1U: /* MODBUS_TIMEOUT */
        x = (float)r->requested.modbus_timeout_ticks * r->drive->ts_s;
        break;
    case 8U: /* MAX_CURRENT_SHARE */
        x = app_registers_current_share(r);
        break;
    case 15U: /* INERTIA_RATIO */
        x = app_registers_inertia(r);
        break;
    case 17U: /* RING_FREQUENCY */
        x = app_registers_ring(r);
        break;
    case 18U: /* INERTIA_BELIEVED */
        x = app_registers_inertia_believed(r);
        break;
    case 19U: /* TRIM_A */
        x = app_registers_trimmed(r).a_A;
        break;
    case 20U: /* TRIM_B */
        x = app_registers_trimmed(r).b_A;
        break;
    case 21U: /* TRIM_GAIN */
        x = app_registers_trimmed(r).gain;
        break;
    case 33U: /* FOUND_MAP_STEP */
        x = app_registers_map_step_A(r);
        break;
    case 34U: /* FOUND_MAP_BIAS */
        x = app_registers_map_bias_A(r);
        break;
    case 35U: /* FOUND_LD_POSITIVE_1 */
        x = app_registers_mapped(r, 0, 0);
        break;
    case 36U: /* FOUND_LD_POSITIVE_2 */
        x = app_registers_mapped(r, 0, 1);
        break;
    case 37U: /* FOUND_LD_POSITIVE_3 */
        x = app_registers_mapped(r, 0, 2);
        break;
    case 38U: /* FOUND_LD_POSITIVE_4 */
        x = app_registers_mapped(r, 0, 3);
        break;
    case 39U: /* FOUND_LD_NEGATIVE_1 */
        x = app_registers_mapped(r, 1, 0);
        break;
    case 40U: /* FOUND_LD_NEGATIVE_2 */
        x = app_registers_mapped(r, 1, 1);
        break;
    case 41U: /* FOUND_LD_NEGATIVE_3 */
        x = app_registers_mapped(r, 1, 2);
        break;
    case 42U: /* FOUND_LD_NEGATIVE_4 */
        x = app_registers_mapped(r, 1, 3);
        break;
    case 43U: /* FOUND_LQ_BESIDE_0_1 */
        x = app_registers_mapped(r, 2, 0);
        break;
    case 44U: /* FOUND_LQ_BESIDE_0_2 */
        x = app_registers_mapped(r, 2, 1);
        break;
    case 45U: /* FOUND_LQ_BESIDE_0_3 */
        x = app_registers_mapped(r, 2, 2);
        break;
    case 46U: /* FOUND_LQ_BESIDE_0_4 */
        x = app_registers_mapped(r, 2, 3);
        break;
    case 47U: /* FOUND_LQ_BESIDE_1_1 */
        x = app_registers_mapped(r, 3, 0);
        break;
    case 48U: /* FOUND_LQ_BESIDE_1_2 */
        x = app_registers_mapped(r, 3, 1);
        break;
    case 49U: /* FOUND_LQ_BESIDE_1_3 */
        x = app_registers_mapped(r, 3, 2);
        break;
    case 50U: /* FOUND_LQ_BESIDE_1_4 */
        x = app_registers_mapped(r, 3, 3);
        break;
    case 51U: /* FOUND_LQ_BESIDE_2_1 */
        x = app_registers_mapped(r, 4, 0);
        break;
    case 52U: /* FOUND_LQ_BESIDE_2_2 */
        x = app_registers_mapped(r, 4, 1);
        break;
    case 53U: /* FOUND_LQ_BESIDE_2_3 */
        x = app_registers_mapped(r, 4, 2);
        break;
    case 54U: /* FOUND_LQ_BESIDE_2_4 */
        x = app_registers_mapped(r, 4, 3);
        break;
    default:
        break;
    }
    return x;
}

uint32_t app_registers_map_whole(const app_registers_t *r, uint16_t number)
{
    uint32_t x = 0U;

    switch (number) {
    case 0U: /* INERTIA_START */
        x = app_registers_inertia_start(r);
        break;
    case 2U: /* SCOPE_COMMAND */
        x = 0U;
        break;
    case 3U: /* SCOPE_CHANNEL */
        x = (uint32_t)r->requested.scope.channel + 1U;
        break;
    case 4U: /* STORE_PARAMETERS */
        x = 1U;
        break;
    case 5U: /* RESTORE_PARAMETERS */
        x = 1U;
        break;
    case 6U: /* ACCEPT_FALLBACK */
        x = 1U;
        break;
    case 7U: /* SENSOR_TRIM */
        x = app_registers_trim_on(r);
        break;
    case 9U: /* STATUSWORD */
        x = app_registers_statusword(r);
        break;
    case 10U: /* ERROR_CODE */
        x = app_error_code(r->status.fault, r->status.drive_fault);
        break;
    case 11U: /* CONDITIONS */
        x = app_registers_conditions(r);
        break;
    case 12U: /* FIRST_SAMPLE */
        x = app_registers_first_sample(r);
        break;
    case 13U: /* POSITION_NOW */
        x = (uint32_t)app_registers_position(r);
        break;
    case 14U: /* DISC_MAP */
        x = app_registers_disc(r);
        break;
    case 16U: /* INERTIA_CHANGES */
        x = app_registers_inertia_changes(r);
        break;
    case 22U: /* TRIM_BLOCKS */
        x = app_registers_trim_blocks(r);
        break;
    case 23U: /* SCOPE_STATE */
        x = app_registers_scope_state(r);
        break;
    case 24U: /* SCOPE_TICKS */
        x = app_registers_scope_ticks(r);
        break;
    case 25U: /* RECORD_NUMBER */
        x = app_registers_record_number(r);
        break;
    case 26U: /* RECORD_COUNT */
        x = app_registers_record_count(r);
        break;
    case 27U: /* PARAMETERS_STATE */
        x = app_registers_stored_state(r);
        break;
    case 28U: /* PARAMETERS_DONE */
        x = app_registers_stored_done(r);
        break;
    case 29U: /* PARAMETERS_NUMBER */
        x = app_registers_stored_number(r);
        break;
    case 30U: /* PARAMETERS_WRITES */
        x = app_registers_stored_writes(r);
        break;
    case 31U: /* PARAMETERS_DROPPED */
        x = app_registers_stored_dropped(r);
        break;
    case 32U: /* SUPPORTED_MODES */
        x = app_registers_modes(r);
        break;
    default:
        break;
    }
    return x;
}

void app_registers_map_put(const app_registers_t *r, app_registers_request_t *w, uint16_t number, float x)
{
    switch (number) {
    case 0U: /* INERTIA_START */
        app_registers_set_inertia_start(w, x);
        break;
    case 1U: /* MODBUS_TIMEOUT */
        w->modbus_timeout_ticks = app_registers_ticks(r, x);
        break;
    case 2U: /* SCOPE_COMMAND */
        w->scope_command = (uint16_t)x;
        break;
    case 3U: /* SCOPE_CHANNEL */
        w->scope.channel = (uint16_t)(x - 1.0f);
        break;
    case 4U: /* STORE_PARAMETERS */
        w->store_command = (uint16_t)APP_PARAMETERS_STORE;
        break;
    case 5U: /* RESTORE_PARAMETERS */
        w->store_command = (uint16_t)APP_PARAMETERS_RESTORE;
        break;
    case 6U: /* ACCEPT_FALLBACK */
        w->store_command = (uint16_t)APP_PARAMETERS_ACCEPT;
        break;
    case 7U: /* SENSOR_TRIM */
        app_registers_set_trim(w, x);
        break;
    case 8U: /* MAX_CURRENT_SHARE */
        app_registers_set_current_share(r, w, x);
        break;
    default:
        break;
    }
}
