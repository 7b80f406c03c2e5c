/* SPDX-License-Identifier: MIT */
/* Generated from registers.toml. Do not edit: python3 host_tools/registers/generate.py. */
/* clang-format off */
#include "app_canopen_map.h"

#include <stddef.h>

const app_canopen_object_t app_canopen_map[APP_CANOPEN_OBJECTS] = {
    {0x1000U, 0U, 4U, false, NULL, 0x00020192UL}, /* Device type */
    {0x1005U, 0U, 4U, false, NULL, 0x00000080UL}, /* COB-ID of SYNC */
    {0x1010U, 0U, 1U, false, NULL, 0x00000001UL}, /* Highest sub-index */
    {0x1010U, 1U, 4U, true, &app_registers_map_holding[32], 0x00000000UL}, /* STORE_PARAMETERS */
    {0x1011U, 0U, 1U, false, NULL, 0x00000001UL}, /* Highest sub-index */
    {0x1011U, 1U, 4U, true, &app_registers_map_holding[33], 0x00000000UL}, /* RESTORE_PARAMETERS */
    {0x1018U, 0U, 1U, false, NULL, 0x00000004UL}, /* Highest sub-index */
    {0x1018U, 1U, 4U, false, NULL, 0x00000000UL}, /* Vendor */
    {0x1018U, 2U, 4U, false, NULL, 0x00028335UL}, /* Product */
    {0x1018U, 3U, 4U, false, NULL, 0x00010000UL}, /* Revision */
    {0x1018U, 4U, 4U, false, NULL, 0x00000000UL}, /* Serial number */
    {0x6007U, 0U, 2U, true, &app_registers_map_holding[11], 0x00000000UL}, /* LOST_OPTION */
    {0x603FU, 0U, 2U, false, &app_registers_map_input[2], 0x00000000UL}, /* ERROR_CODE */
    {0x6040U, 0U, 2U, true, &app_registers_map_holding[0], 0x00000000UL}, /* CONTROLWORD */
    {0x6041U, 0U, 2U, false, &app_registers_map_input[0], 0x00000000UL}, /* STATUSWORD */
    {0x605AU, 0U, 2U, true, &app_registers_map_holding[8], 0x00000000UL}, /* QUICK_STOP_OPTION */
    {0x605BU, 0U, 2U, true, &app_registers_map_holding[9], 0x00000000UL}, /* SHUTDOWN_OPTION */
    {0x605CU, 0U, 2U, true, &app_registers_map_holding[10], 0x00000000UL}, /* DISABLE_OPTION */
    {0x6060U, 0U, 1U, true, &app_registers_map_holding[1], 0x00000000UL}, /* MODE_OF_OPERATION */
    {0x6061U, 0U, 1U, false, &app_registers_map_input[1], 0x00000000UL}, /* MODE_NOW */
    {0x6064U, 0U, 4U, false, &app_registers_map_input[51], 0x00000000UL}, /* POSITION_NOW */
    {0x6065U, 0U, 4U, true, &app_registers_map_holding[51], 0x00000000UL}, /* FOLLOWING_WINDOW */
    {0x6066U, 0U, 2U, true, &app_registers_map_holding[52], 0x00000000UL}, /* FOLLOWING_TIMEOUT */
    {0x6067U, 0U, 4U, true, &app_registers_map_holding[38], 0x00000000UL}, /* POSITION_WINDOW */
    {0x606BU, 0U, 4U, false, &app_registers_map_input[12], 0x00000000UL}, /* SPEED_DEMAND_RPM */
    {0x606CU, 0U, 4U, false, &app_registers_map_input[11], 0x00000000UL}, /* SPEED_NOW_RPM */
    {0x606DU, 0U, 2U, true, &app_registers_map_holding[13], 0x00000000UL}, /* SPEED_WINDOW */
    {0x6071U, 0U, 2U, true, &app_registers_map_holding[42], 0x00000000UL}, /* TORQUE */
    {0x6072U, 0U, 2U, true, &app_registers_map_holding[44], 0x00000000UL}, /* MAX_TORQUE */
    {0x6073U, 0U, 2U, true, &app_registers_map_holding[47], 0x00000000UL}, /* MAX_CURRENT_SHARE */
    {0x6074U, 0U, 2U, false, &app_registers_map_input[144], 0x00000000UL}, /* TORQUE_DEMAND */
    {0x6075U, 0U, 4U, false, &app_registers_map_input[145], 0x00000000UL}, /* RATED_CURRENT */
    {0x6076U, 0U, 4U, false, &app_registers_map_input[146], 0x00000000UL}, /* RATED_TORQUE */
    {0x6077U, 0U, 2U, false, &app_registers_map_input[143], 0x00000000UL}, /* TORQUE_NOW */
    {0x6079U, 0U, 4U, false, &app_registers_map_input[19], 0x00000000UL}, /* DC_LINK */
    {0x607AU, 0U, 4U, true, &app_registers_map_holding[35], 0x00000000UL}, /* TARGET_POSITION */
    {0x607CU, 0U, 4U, true, &app_registers_map_holding[66], 0x00000000UL}, /* HOME_OFFSET */
    {0x607DU, 0U, 1U, false, NULL, 0x00000002UL}, /* Highest sub-index */
    {0x607DU, 1U, 4U, true, &app_registers_map_holding[60], 0x00000000UL}, /* POSITION_LEAST */
    {0x607DU, 2U, 4U, true, &app_registers_map_holding[61], 0x00000000UL}, /* POSITION_MOST */
    {0x607EU, 0U, 1U, true, &app_registers_map_holding[59], 0x00000000UL}, /* POLARITY */
    {0x607FU, 0U, 4U, true, &app_registers_map_holding[39], 0x00000000UL}, /* PROFILE_SPEED_MAX */
    {0x6080U, 0U, 4U, true, &app_registers_map_holding[46], 0x00000000UL}, /* TORQUE_SPEED_MAX */
    {0x6081U, 0U, 4U, true, &app_registers_map_holding[40], 0x00000000UL}, /* PROFILE_VELOCITY_RPM */
    {0x6083U, 0U, 4U, true, &app_registers_map_holding[5], 0x00000000UL}, /* ACCELERATION */
    {0x6084U, 0U, 4U, true, &app_registers_map_holding[6], 0x00000000UL}, /* DECELERATION */
    {0x6085U, 0U, 4U, true, &app_registers_map_holding[7], 0x00000000UL}, /* QUICK_STOP_DECELERATION */
    {0x6087U, 0U, 4U, true, &app_registers_map_holding[45], 0x00000000UL}, /* TORQUE_SLOPE */
    {0x608FU, 0U, 1U, false, NULL, 0x00000002UL}, /* Highest sub-index */
    {0x608FU, 1U, 4U, false, &app_registers_map_input[109], 0x00000000UL}, /* ENCODER_POSITIONS */
    {0x608FU, 2U, 4U, false, NULL, 0x00000001UL}, /* Motor revolutions */
    {0x6091U, 0U, 1U, false, NULL, 0x00000002UL}, /* Highest sub-index */
    {0x6091U, 1U, 4U, true, &app_registers_map_holding[55], 0x00000000UL}, /* GEAR_MOTOR */
    {0x6091U, 2U, 4U, true, &app_registers_map_holding[56], 0x00000000UL}, /* GEAR_SHAFT */
    {0x6092U, 0U, 1U, false, NULL, 0x00000002UL}, /* Highest sub-index */
    {0x6092U, 1U, 4U, true, &app_registers_map_holding[57], 0x00000000UL}, /* FEED */
    {0x6092U, 2U, 4U, true, &app_registers_map_holding[58], 0x00000000UL}, /* FEED_SHAFT */
    {0x6098U, 0U, 1U, true, &app_registers_map_holding[62], 0x00000000UL}, /* HOMING_METHOD */
    {0x6099U, 0U, 1U, false, NULL, 0x00000002UL}, /* Highest sub-index */
    {0x6099U, 1U, 4U, true, &app_registers_map_holding[63], 0x00000000UL}, /* HOMING_SPEED_SWITCH */
    {0x6099U, 2U, 4U, true, &app_registers_map_holding[64], 0x00000000UL}, /* HOMING_SPEED_ZERO */
    {0x609AU, 0U, 4U, true, &app_registers_map_holding[65], 0x00000000UL}, /* HOMING_ACCELERATION */
    {0x60A4U, 0U, 1U, false, NULL, 0x00000001UL}, /* Highest sub-index */
    {0x60A4U, 1U, 4U, true, &app_registers_map_holding[37], 0x00000000UL}, /* PROFILE_JERK */
    {0x60A8U, 0U, 4U, false, NULL, 0x00000000UL}, /* Unit of positions */
    {0x60A9U, 0U, 4U, false, NULL, 0xFFB44700UL}, /* Unit of speeds */
    {0x60B0U, 0U, 4U, true, &app_registers_map_holding[50], 0x00000000UL}, /* POSITION_OFFSET */
    {0x60B1U, 0U, 4U, true, &app_registers_map_holding[48], 0x00000000UL}, /* VELOCITY_OFFSET */
    {0x60B2U, 0U, 2U, true, &app_registers_map_holding[43], 0x00000000UL}, /* TORQUE_OFFSET */
    {0x60C2U, 0U, 1U, false, NULL, 0x00000002UL}, /* Highest sub-index */
    {0x60C2U, 1U, 1U, true, &app_registers_map_holding[49], 0x00000000UL}, /* INTERPOLATION_PERIOD */
    {0x60C2U, 2U, 1U, true, NULL, 0xFFFFFFFDUL}, /* INTERPOLATION_POWER */
    {0x60FDU, 0U, 4U, false, &app_registers_map_input[56], 0x00000000UL}, /* DIGITAL_INPUTS */
    {0x60FEU, 0U, 1U, false, NULL, 0x00000001UL}, /* Highest sub-index */
    {0x60FEU, 1U, 4U, false, &app_registers_map_input[152], 0x00000000UL}, /* DIGITAL_OUTPUTS */
    {0x60FFU, 0U, 4U, true, &app_registers_map_holding[3], 0x00000000UL}, /* SPEED_RPM */
    {0x6502U, 0U, 4U, false, &app_registers_map_input[107], 0x00000000UL}, /* SUPPORTED_MODES */
};

const app_canopen_preset_t app_canopen_received[APP_CANOPEN_PDOS] = {
    {{0x60400010UL, 0x00000000UL}, 1U, 255U, 0U},
    {{0x60400010UL, 0x60600008UL}, 2U, 255U, 0U},
    {{0x60400010UL, 0x607A0020UL}, 2U, 255U, 0U},
    {{0x60400010UL, 0x60FF0020UL}, 2U, 255U, 0U},
};

const app_canopen_preset_t app_canopen_sent[APP_CANOPEN_PDOS] = {
    {{0x60410010UL, 0x00000000UL}, 1U, 255U, 100U},
    {{0x60410010UL, 0x60610008UL}, 2U, 255U, 100U},
    {{0x60410010UL, 0x60640020UL}, 2U, 1U, 100U},
    {{0x60410010UL, 0x606C0020UL}, 2U, 1U, 100U},
};
