/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
#include "app_registers.h"

const app_registers_entry_t app_registers_map_holding[APP_REGISTERS_MAP_HOLDING] = {
    {APP_REGISTERS_CONTROLWORD, APP_REGISTERS_U16, 0.0f, 0.0f, 65535.0f, false, false, 0UL},
    {APP_REGISTERS_MODE_OF_OPERATION, APP_REGISTERS_I16, 0.0f, -1.0f, 6.0f, true, false, 0UL},
    {APP_REGISTERS_SPEED, APP_REGISTERS_I32, 10.0f, -1000000.0f, 1000000.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_RPM, APP_REGISTERS_I32, 10.0f, -10000000.0f, 10000000.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_RPM_16, APP_REGISTERS_I16, 1.0f, -32768.0f, 32767.0f, false, false, 0UL},
    {APP_REGISTERS_ACCELERATION, APP_REGISTERS_U32, 1.0f, 0.0f, 1000000.0f, false, true, 0UL},
    {APP_REGISTERS_DECELERATION, APP_REGISTERS_U32, 1.0f, 0.0f, 1000000.0f, false, true, 0UL},
    {APP_REGISTERS_QUICK_STOP_DECELERATION, APP_REGISTERS_U32, 1.0f, 0.0f, 1000000.0f, false, true, 0UL},
    {APP_REGISTERS_QUICK_STOP_OPTION, APP_REGISTERS_I16, 0.0f, 0.0f, 6.0f, false, true, 0UL},
    {APP_REGISTERS_SHUTDOWN_OPTION, APP_REGISTERS_I16, 0.0f, 0.0f, 1.0f, false, true, 0UL},
    {APP_REGISTERS_DISABLE_OPTION, APP_REGISTERS_I16, 0.0f, 0.0f, 1.0f, false, true, 0UL},
    {APP_REGISTERS_LOST_OPTION, APP_REGISTERS_I16, 0.0f, 2.0f, 3.0f, false, true, 0UL},
    {APP_REGISTERS_MAX_CURRENT, APP_REGISTERS_I32, 1000.0f, 0.0f, 1000000.0f, false, true, 0UL},
    {APP_REGISTERS_SPEED_WINDOW, APP_REGISTERS_U16, 10.0f, 0.0f, 6553.5f, false, true, 0UL},
    {APP_REGISTERS_COMMISSION_CURRENT, APP_REGISTERS_U16, 100.0f, 0.0f, 655.35f, false, false, 0UL},
    {APP_REGISTERS_COMMISSION_SPEED, APP_REGISTERS_U16, 10.0f, 0.0f, 6553.5f, false, false, 0UL},
    {APP_REGISTERS_MODBUS_ADDRESS, APP_REGISTERS_U16, 0.0f, 1.0f, 247.0f, false, true, 0UL},
    {APP_REGISTERS_MODBUS_TIMEOUT, APP_REGISTERS_U16, 1000.0f, 0.01f, 60.0f, false, true, 0UL},
    {APP_REGISTERS_BAUD_RATE, APP_REGISTERS_U32, 0.0f, 9600.0f, 115200.0f, true, true, 0UL},
    {APP_REGISTERS_LINE_FORMAT, APP_REGISTERS_U16, 0.0f, 0.0f, 2.0f, true, true, 0UL},
    {APP_REGISTERS_DIRECTION_PIN, APP_REGISTERS_U16, 0.0f, 0.0f, 1.0f, true, true, 0UL},
    {APP_REGISTERS_SCOPE_COMMAND, APP_REGISTERS_U16, 0.0f, 0.0f, 2.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_SIGNAL_1, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_SIGNAL_2, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_SIGNAL_3, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_SIGNAL_4, APP_REGISTERS_U16, 0.0f, 0.0f, 255.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_DECIMATION, APP_REGISTERS_U16, 0.0f, 1.0f, 65535.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_TRIGGER, APP_REGISTERS_U16, 0.0f, 0.0f, 2.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_CHANNEL, APP_REGISTERS_U16, 0.0f, 1.0f, 4.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_LEVEL, APP_REGISTERS_I32, 1000.0f, -1000000.0f, 1000000.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_BEFORE, APP_REGISTERS_U16, 0.0f, 0.0f, 511.0f, false, false, 0UL},
    {APP_REGISTERS_STORE_PARAMETERS, APP_REGISTERS_U32, 0.0f, 1.70225701e+09f, 1.70225701e+09f, false, false, 0x65766173UL},
    {APP_REGISTERS_RESTORE_PARAMETERS, APP_REGISTERS_U32, 0.0f, 1.68410712e+09f, 1.68410712e+09f, false, false, 0x64616F6CUL},
    {APP_REGISTERS_ACCEPT_FALLBACK, APP_REGISTERS_U32, 0.0f, 1.70153612e+09f, 1.70153612e+09f, false, false, 0x656B6174UL},
    {APP_REGISTERS_TARGET_POSITION, APP_REGISTERS_I32, 0.0f, -1e+09f, 1e+09f, false, false, 0UL},
    {APP_REGISTERS_PROFILE_VELOCITY, APP_REGISTERS_U32, 10.0f, 0.0f, 1000000.0f, false, true, 0UL},
    {APP_REGISTERS_PROFILE_JERK, APP_REGISTERS_U32, 1.0f, 0.0f, 4e+09f, false, true, 0UL},
    {APP_REGISTERS_POSITION_WINDOW, APP_REGISTERS_U16, 0.0f, 1.0f, 65535.0f, false, true, 0UL},
};

const app_registers_entry_t app_registers_map_input[APP_REGISTERS_MAP_INPUT] = {
    {APP_REGISTERS_STATUSWORD, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_MODE_NOW, APP_REGISTERS_I16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ERROR_CODE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_MODE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_DRIVE_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_BOARD_FAULTS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CONDITIONS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_REFERENCE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ALIGN_STAGE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_NOW, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_NOW_RPM, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_DEMAND_RPM, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_IQ, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ID, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_IQ_REF, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ID_REF, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_VQ, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_VD, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_DC_LINK, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_TEMPERATURE, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_THETA, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_POSITION, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CORRECTIONS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ZERO_A, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ZERO_B, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CYCLES, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CYCLES_WORST, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_TICKS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_RESET_CAUSE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_PHASE_ERRORS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_IGNORED_ANGLES, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_IGNORED_CURRENTS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_JUMPS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_MOTOR_HEAT, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_INVERTER_HEAT, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_DERATING, APP_REGISTERS_U16, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_MODE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_DRIVE_FAULT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_BOARD_FAULTS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_IA, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_IB, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_DC_LINK, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_TEMPERATURE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_POSITION, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_INDEX, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_SAMPLE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_SPEED, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_WANTED, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FIRST_TICKS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_POSITION_NOW, APP_REGISTERS_I32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_POSITION_TARGET, APP_REGISTERS_I32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_COMMISSION_STAGE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_COMMISSION_REASON, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_COMMISSION_PERCENT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_DIRECTION, APP_REGISTERS_I16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_POLE_PAIRS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_COUNTS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_RELUCTANCE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_R, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_R_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_V_LOSS, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_V_LOSS_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_LD, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_LD_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_LQ, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_LQ_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_FLUX, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_FLUX_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_INERTIA, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_INERTIA_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_FRICTION, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_FRICTION_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_COULOMB, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_COULOMB_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_OFFSET, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_FOUND_OFFSET_ERROR, APP_REGISTERS_DEC, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_STATE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SCOPE_TICKS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_RECORD_NUMBER, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_RECORD_COUNT, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_PARAMETERS_STATE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_PARAMETERS_DONE, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_PARAMETERS_NUMBER, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_PARAMETERS_WRITES, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SUPPORTED_MODES, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_POLE_PAIRS, APP_REGISTERS_U16, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_ENCODER_POSITIONS, APP_REGISTERS_U32, 0.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CONTROL_PERIOD, APP_REGISTERS_U32, 1e+09f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_MAX, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_MAX_RPM, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_SPEED_TRIP, APP_REGISTERS_I32, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CURRENT_MAX, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_CURRENT_TRIP, APP_REGISTERS_I32, 1000.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_DC_LINK_MIN, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_DC_LINK_MAX, APP_REGISTERS_U16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_TEMPERATURE_LIMIT, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
    {APP_REGISTERS_TEMPERATURE_TRIP, APP_REGISTERS_I16, 10.0f, 0.0f, 0.0f, false, false, 0UL},
};

float app_registers_map_holding_real(const app_registers_t *r, uint16_t address)
{
    float x = 0.0f;

    switch (address) {
    case APP_REGISTERS_SPEED:
        x = r->wanted.objects.omega_e_radps;
        break;
    case APP_REGISTERS_SPEED_RPM:
        x = r->wanted.objects.omega_e_radps * r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_SPEED_RPM_16:
        x = r->wanted.objects.omega_e_radps * r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_ACCELERATION:
        x = r->wanted.objects.accel_e_radps2;
        break;
    case APP_REGISTERS_DECELERATION:
        x = r->wanted.objects.decel_e_radps2;
        break;
    case APP_REGISTERS_QUICK_STOP_DECELERATION:
        x = r->wanted.objects.quick_e_radps2;
        break;
    case APP_REGISTERS_MAX_CURRENT:
        x = r->wanted.objects.current_max_A;
        break;
    case APP_REGISTERS_SPEED_WINDOW:
        x = r->wanted.objects.window_e_radps;
        break;
    case APP_REGISTERS_COMMISSION_CURRENT:
        x = r->wanted.objects.bounds.current_A;
        break;
    case APP_REGISTERS_COMMISSION_SPEED:
        x = r->wanted.objects.bounds.speed_m_radps;
        break;
    case APP_REGISTERS_MODBUS_TIMEOUT:
        x = (float)r->wanted.modbus_timeout_ticks * r->drive->ts_s;
        break;
    case APP_REGISTERS_SCOPE_LEVEL:
        x = r->wanted.scope.level;
        break;
    case APP_REGISTERS_PROFILE_VELOCITY:
        x = r->wanted.objects.profile_e_radps;
        break;
    case APP_REGISTERS_PROFILE_JERK:
        x = r->wanted.objects.jerk_e_radps3;
        break;
    default:
        break;
    }
    return x;
}

uint32_t app_registers_map_holding_whole(const app_registers_t *r, uint16_t address)
{
    uint32_t x = 0U;

    switch (address) {
    case APP_REGISTERS_CONTROLWORD:
        x = r->wanted.objects.controlword;
        break;
    case APP_REGISTERS_MODE_OF_OPERATION:
        x = app_registers_signed(r->wanted.objects.mode_of_operation);
        break;
    case APP_REGISTERS_QUICK_STOP_OPTION:
        x = app_registers_signed(r->wanted.objects.quick_option);
        break;
    case APP_REGISTERS_SHUTDOWN_OPTION:
        x = app_registers_signed(r->wanted.objects.shutdown_option);
        break;
    case APP_REGISTERS_DISABLE_OPTION:
        x = app_registers_signed(r->wanted.objects.disable_option);
        break;
    case APP_REGISTERS_LOST_OPTION:
        x = app_registers_signed(r->wanted.objects.lost_option);
        break;
    case APP_REGISTERS_MODBUS_ADDRESS:
        x = r->wanted.modbus_address;
        break;
    case APP_REGISTERS_BAUD_RATE:
        x = r->wanted.line.baud_Bd;
        break;
    case APP_REGISTERS_LINE_FORMAT:
        x = r->wanted.line.format;
        break;
    case APP_REGISTERS_DIRECTION_PIN:
        x = r->wanted.line.direction;
        break;
    case APP_REGISTERS_SCOPE_COMMAND:
        x = 0U;
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_1:
        x = r->wanted.scope.signal[0];
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_2:
        x = r->wanted.scope.signal[1];
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_3:
        x = r->wanted.scope.signal[2];
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_4:
        x = r->wanted.scope.signal[3];
        break;
    case APP_REGISTERS_SCOPE_DECIMATION:
        x = r->wanted.scope.decimation;
        break;
    case APP_REGISTERS_SCOPE_TRIGGER:
        x = r->wanted.scope.trigger;
        break;
    case APP_REGISTERS_SCOPE_CHANNEL:
        x = (uint32_t)r->wanted.scope.channel + 1U;
        break;
    case APP_REGISTERS_SCOPE_BEFORE:
        x = r->wanted.scope.before;
        break;
    case APP_REGISTERS_STORE_PARAMETERS:
        x = 1U;
        break;
    case APP_REGISTERS_RESTORE_PARAMETERS:
        x = 1U;
        break;
    case APP_REGISTERS_ACCEPT_FALLBACK:
        x = 1U;
        break;
    case APP_REGISTERS_TARGET_POSITION:
        x = (uint32_t)r->wanted.objects.target_cnt;
        break;
    case APP_REGISTERS_POSITION_WINDOW:
        x = r->wanted.objects.position_window_cnt;
        break;
    default:
        break;
    }
    return x;
}

float app_registers_map_input_real(const app_registers_t *r, uint16_t address)
{
    float x = 0.0f;

    switch (address) {
    case APP_REGISTERS_SPEED_NOW:
        x = r->status.speed_e_radps;
        break;
    case APP_REGISTERS_SPEED_NOW_RPM:
        x = r->status.speed_e_radps * r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_SPEED_DEMAND_RPM:
        x = r->status.demand_e_radps * r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_IQ:
        x = r->status.i_A.q;
        break;
    case APP_REGISTERS_ID:
        x = r->status.i_A.d;
        break;
    case APP_REGISTERS_IQ_REF:
        x = r->status.i_ref_A.q;
        break;
    case APP_REGISTERS_ID_REF:
        x = r->status.i_ref_A.d;
        break;
    case APP_REGISTERS_VQ:
        x = r->status.v_V.q;
        break;
    case APP_REGISTERS_VD:
        x = r->status.v_V.d;
        break;
    case APP_REGISTERS_DC_LINK:
        x = r->status.dc_link_V;
        break;
    case APP_REGISTERS_TEMPERATURE:
        x = r->status.temperature_degC;
        break;
    case APP_REGISTERS_THETA:
        x = r->status.theta_e_rad;
        break;
    case APP_REGISTERS_ZERO_A:
        x = r->status.zero_a_cnt;
        break;
    case APP_REGISTERS_ZERO_B:
        x = r->status.zero_b_cnt;
        break;
    case APP_REGISTERS_MOTOR_HEAT:
        x = r->status.motor_heat;
        break;
    case APP_REGISTERS_INVERTER_HEAT:
        x = r->status.inverter_heat;
        break;
    case APP_REGISTERS_DERATING:
        x = r->status.derating;
        break;
    case APP_REGISTERS_FIRST_SPEED:
        x = r->status.snapshot.speed_e_radps;
        break;
    case APP_REGISTERS_FIRST_WANTED:
        x = r->status.snapshot.wanted_e_radps;
        break;
    case APP_REGISTERS_FOUND_R:
        x = r->status.commission.found.r_Ohm.value;
        break;
    case APP_REGISTERS_FOUND_R_ERROR:
        x = r->status.commission.found.r_Ohm.error;
        break;
    case APP_REGISTERS_FOUND_V_LOSS:
        x = r->status.commission.found.v_loss_V.value;
        break;
    case APP_REGISTERS_FOUND_V_LOSS_ERROR:
        x = r->status.commission.found.v_loss_V.error;
        break;
    case APP_REGISTERS_FOUND_LD:
        x = r->status.commission.found.ld_H.value;
        break;
    case APP_REGISTERS_FOUND_LD_ERROR:
        x = r->status.commission.found.ld_H.error;
        break;
    case APP_REGISTERS_FOUND_LQ:
        x = r->status.commission.found.lq_H.value;
        break;
    case APP_REGISTERS_FOUND_LQ_ERROR:
        x = r->status.commission.found.lq_H.error;
        break;
    case APP_REGISTERS_FOUND_FLUX:
        x = r->status.commission.found.flux_Wb.value;
        break;
    case APP_REGISTERS_FOUND_FLUX_ERROR:
        x = r->status.commission.found.flux_Wb.error;
        break;
    case APP_REGISTERS_FOUND_INERTIA:
        x = r->status.commission.found.inertia_kgm2.value;
        break;
    case APP_REGISTERS_FOUND_INERTIA_ERROR:
        x = r->status.commission.found.inertia_kgm2.error;
        break;
    case APP_REGISTERS_FOUND_FRICTION:
        x = r->status.commission.found.friction_Nms.value;
        break;
    case APP_REGISTERS_FOUND_FRICTION_ERROR:
        x = r->status.commission.found.friction_Nms.error;
        break;
    case APP_REGISTERS_FOUND_COULOMB:
        x = r->status.commission.found.coulomb_Nm.value;
        break;
    case APP_REGISTERS_FOUND_COULOMB_ERROR:
        x = r->status.commission.found.coulomb_Nm.error;
        break;
    case APP_REGISTERS_FOUND_OFFSET:
        x = r->status.commission.found.offset_rad.value;
        break;
    case APP_REGISTERS_FOUND_OFFSET_ERROR:
        x = r->status.commission.found.offset_rad.error;
        break;
    case APP_REGISTERS_CONTROL_PERIOD:
        x = r->drive->ts_s;
        break;
    case APP_REGISTERS_SPEED_MAX:
        x = r->drive->speed_max_e_radps;
        break;
    case APP_REGISTERS_SPEED_MAX_RPM:
        x = r->drive->speed_max_e_radps * r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_SPEED_TRIP:
        x = r->drive->trip_speed_e_radps;
        break;
    case APP_REGISTERS_CURRENT_MAX:
        x = r->drive->current_max_A;
        break;
    case APP_REGISTERS_CURRENT_TRIP:
        x = r->drive->trip_current_A;
        break;
    case APP_REGISTERS_DC_LINK_MIN:
        x = r->drive->dc_link_min_V;
        break;
    case APP_REGISTERS_DC_LINK_MAX:
        x = r->drive->dc_link_max_V;
        break;
    case APP_REGISTERS_TEMPERATURE_LIMIT:
        x = r->config->temperature_limit_degC;
        break;
    case APP_REGISTERS_TEMPERATURE_TRIP:
        x = r->config->temperature_trip_degC;
        break;
    default:
        break;
    }
    return x;
}

uint32_t app_registers_map_input_whole(const app_registers_t *r, uint16_t address)
{
    uint32_t x = 0U;

    switch (address) {
    case APP_REGISTERS_STATUSWORD:
        x = app_registers_statusword(r);
        break;
    case APP_REGISTERS_MODE_NOW:
        x = app_registers_signed(r->status.mode_of_operation);
        break;
    case APP_REGISTERS_ERROR_CODE:
        x = app_error_code(r->status.fault, r->status.drive_fault);
        break;
    case APP_REGISTERS_MODE:
        x = (uint32_t)r->status.mode;
        break;
    case APP_REGISTERS_FAULT:
        x = (uint32_t)r->status.fault;
        break;
    case APP_REGISTERS_DRIVE_FAULT:
        x = (uint32_t)r->status.drive_fault;
        break;
    case APP_REGISTERS_BOARD_FAULTS:
        x = r->status.board_faults;
        break;
    case APP_REGISTERS_CONDITIONS:
        x = app_registers_conditions(r);
        break;
    case APP_REGISTERS_REFERENCE:
        x = (uint32_t)r->status.reference;
        break;
    case APP_REGISTERS_ALIGN_STAGE:
        x = (uint32_t)r->status.align_stage;
        break;
    case APP_REGISTERS_POSITION:
        x = r->status.position_cnt;
        break;
    case APP_REGISTERS_CORRECTIONS:
        x = r->status.index_corrections;
        break;
    case APP_REGISTERS_CYCLES:
        x = r->status.tick_cycles;
        break;
    case APP_REGISTERS_CYCLES_WORST:
        x = r->status.tick_cycles_worst;
        break;
    case APP_REGISTERS_TICKS:
        x = r->status.ticks;
        break;
    case APP_REGISTERS_RESET_CAUSE:
        x = (uint32_t)r->status.reset_cause;
        break;
    case APP_REGISTERS_PHASE_ERRORS:
        x = r->status.phase_errors;
        break;
    case APP_REGISTERS_IGNORED_ANGLES:
        x = r->status.ignored_angles;
        break;
    case APP_REGISTERS_IGNORED_CURRENTS:
        x = r->status.ignored_currents;
        break;
    case APP_REGISTERS_JUMPS:
        x = r->status.position_jumps;
        break;
    case APP_REGISTERS_FIRST_FAULT:
        x = (uint32_t)r->status.snapshot.fault;
        break;
    case APP_REGISTERS_FIRST_MODE:
        x = (uint32_t)r->status.snapshot.mode;
        break;
    case APP_REGISTERS_FIRST_DRIVE_FAULT:
        x = (uint32_t)r->status.snapshot.drive_fault;
        break;
    case APP_REGISTERS_FIRST_BOARD_FAULTS:
        x = r->status.snapshot.board_faults;
        break;
    case APP_REGISTERS_FIRST_IA:
        x = r->status.snapshot.raw.ia_cnt;
        break;
    case APP_REGISTERS_FIRST_IB:
        x = r->status.snapshot.raw.ib_cnt;
        break;
    case APP_REGISTERS_FIRST_DC_LINK:
        x = r->status.snapshot.raw.dc_link_cnt;
        break;
    case APP_REGISTERS_FIRST_TEMPERATURE:
        x = r->status.snapshot.raw.temperature_cnt;
        break;
    case APP_REGISTERS_FIRST_POSITION:
        x = r->status.snapshot.raw.position_cnt;
        break;
    case APP_REGISTERS_FIRST_INDEX:
        x = r->status.snapshot.raw.index_cnt;
        break;
    case APP_REGISTERS_FIRST_SAMPLE:
        x = app_registers_first_sample(r);
        break;
    case APP_REGISTERS_FIRST_TICKS:
        x = r->status.snapshot.ticks;
        break;
    case APP_REGISTERS_POSITION_NOW:
        x = (uint32_t)app_registers_position(r);
        break;
    case APP_REGISTERS_POSITION_TARGET:
        x = (uint32_t)r->status.target_cnt;
        break;
    case APP_REGISTERS_COMMISSION_STAGE:
        x = (uint32_t)r->status.commission.stage;
        break;
    case APP_REGISTERS_COMMISSION_REASON:
        x = (uint32_t)r->status.commission.reason;
        break;
    case APP_REGISTERS_COMMISSION_PERCENT:
        x = (uint32_t)r->status.commission.percent;
        break;
    case APP_REGISTERS_FOUND_DIRECTION:
        x = (uint32_t)r->status.commission.found.direction;
        break;
    case APP_REGISTERS_FOUND_POLE_PAIRS:
        x = (uint32_t)r->status.commission.found.pole_pairs;
        break;
    case APP_REGISTERS_FOUND_COUNTS:
        x = (uint32_t)r->status.commission.found.counts_per_turn;
        break;
    case APP_REGISTERS_FOUND_RELUCTANCE:
        x = r->status.commission.found.reluctance ? 1U : 0U;
        break;
    case APP_REGISTERS_SCOPE_STATE:
        x = app_registers_scope_state(r);
        break;
    case APP_REGISTERS_SCOPE_TICKS:
        x = app_registers_scope_ticks(r);
        break;
    case APP_REGISTERS_RECORD_NUMBER:
        x = app_registers_record_number(r);
        break;
    case APP_REGISTERS_RECORD_COUNT:
        x = app_registers_record_count(r);
        break;
    case APP_REGISTERS_PARAMETERS_STATE:
        x = app_registers_stored_state(r);
        break;
    case APP_REGISTERS_PARAMETERS_DONE:
        x = app_registers_stored_done(r);
        break;
    case APP_REGISTERS_PARAMETERS_NUMBER:
        x = app_registers_stored_number(r);
        break;
    case APP_REGISTERS_PARAMETERS_WRITES:
        x = app_registers_stored_writes(r);
        break;
    case APP_REGISTERS_SUPPORTED_MODES:
        x = r->drive->positions ? 0x00010025UL : 0x00010024UL;
        break;
    case APP_REGISTERS_POLE_PAIRS:
        x = r->drive->hardware.pole_pairs;
        break;
    case APP_REGISTERS_ENCODER_POSITIONS:
        x = r->drive->hardware.encoder_positions;
        break;
    default:
        break;
    }
    return x;
}

void app_registers_map_put(const app_registers_t *r, app_registers_wanted_t *w, uint16_t address, float x, int32_t n)
{
    switch (address) {
    case APP_REGISTERS_CONTROLWORD:
        w->objects.controlword = (uint16_t)x;
        break;
    case APP_REGISTERS_MODE_OF_OPERATION:
        w->objects.mode_of_operation = (int16_t)x;
        break;
    case APP_REGISTERS_SPEED:
        w->objects.omega_e_radps = x;
        break;
    case APP_REGISTERS_SPEED_RPM:
        w->objects.omega_e_radps = x / r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_SPEED_RPM_16:
        w->objects.omega_e_radps = x / r->rpm_per_e_radps;
        break;
    case APP_REGISTERS_ACCELERATION:
        w->objects.accel_e_radps2 = x;
        break;
    case APP_REGISTERS_DECELERATION:
        w->objects.decel_e_radps2 = x;
        break;
    case APP_REGISTERS_QUICK_STOP_DECELERATION:
        w->objects.quick_e_radps2 = x;
        break;
    case APP_REGISTERS_QUICK_STOP_OPTION:
        w->objects.quick_option = (int16_t)x;
        break;
    case APP_REGISTERS_SHUTDOWN_OPTION:
        w->objects.shutdown_option = (int16_t)x;
        break;
    case APP_REGISTERS_DISABLE_OPTION:
        w->objects.disable_option = (int16_t)x;
        break;
    case APP_REGISTERS_LOST_OPTION:
        w->objects.lost_option = (int16_t)x;
        break;
    case APP_REGISTERS_MAX_CURRENT:
        w->objects.current_max_A = x;
        break;
    case APP_REGISTERS_SPEED_WINDOW:
        w->objects.window_e_radps = x;
        break;
    case APP_REGISTERS_COMMISSION_CURRENT:
        w->objects.bounds.current_A = x;
        break;
    case APP_REGISTERS_COMMISSION_SPEED:
        w->objects.bounds.speed_m_radps = x;
        break;
    case APP_REGISTERS_MODBUS_ADDRESS:
        w->modbus_address = (uint16_t)x;
        break;
    case APP_REGISTERS_MODBUS_TIMEOUT:
        w->modbus_timeout_ticks = app_registers_ticks(r, x);
        break;
    case APP_REGISTERS_BAUD_RATE:
        w->line.baud_Bd = (uint32_t)x;
        break;
    case APP_REGISTERS_LINE_FORMAT:
        w->line.format = (uint16_t)x;
        break;
    case APP_REGISTERS_DIRECTION_PIN:
        w->line.direction = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_COMMAND:
        w->scope_command = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_1:
        w->scope.signal[0] = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_2:
        w->scope.signal[1] = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_3:
        w->scope.signal[2] = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_SIGNAL_4:
        w->scope.signal[3] = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_DECIMATION:
        w->scope.decimation = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_TRIGGER:
        w->scope.trigger = (uint16_t)x;
        break;
    case APP_REGISTERS_SCOPE_CHANNEL:
        w->scope.channel = (uint16_t)(x - 1.0f);
        break;
    case APP_REGISTERS_SCOPE_LEVEL:
        w->scope.level = x;
        break;
    case APP_REGISTERS_SCOPE_BEFORE:
        w->scope.before = (uint16_t)x;
        break;
    case APP_REGISTERS_STORE_PARAMETERS:
        w->store_command = (uint16_t)APP_PARAMETERS_STORE;
        break;
    case APP_REGISTERS_RESTORE_PARAMETERS:
        w->store_command = (uint16_t)APP_PARAMETERS_RESTORE;
        break;
    case APP_REGISTERS_ACCEPT_FALLBACK:
        w->store_command = (uint16_t)APP_PARAMETERS_ACCEPT;
        break;
    case APP_REGISTERS_TARGET_POSITION:
        w->objects.target_cnt = n;
        break;
    case APP_REGISTERS_PROFILE_VELOCITY:
        w->objects.profile_e_radps = x;
        break;
    case APP_REGISTERS_PROFILE_JERK:
        w->objects.jerk_e_radps3 = x;
        break;
    case APP_REGISTERS_POSITION_WINDOW:
        w->objects.position_window_cnt = (uint16_t)x;
        break;
    default:
        break;
    }
}
