/* SPDX-License-Identifier: MIT */
/**
 * @file app_status.h
 * @brief Status of the application: modes, faults, measurements. docs/modbus.md has their numbers.
 */
#ifndef APP_STATUS_H
#define APP_STATUS_H

#include "app_align.h"
#include "app_angle.h"
#include "app_brake.h"
#include "app_chopper.h"
#include "app_commission.h"
#include "app_homing.h"
#include "app_objects.h"
#include "app_path.h"
#include "app_position.h"
#include "app_trim.h"
#include "board.h"
#include "drive_tick.h"

typedef enum {
    APP_MODE_BOOT = 0,  /**< sensors and converter settle; bridge off */
    APP_MODE_CALIBRATE, /**< measures the current offsets; bridge off */
    APP_MODE_READY,     /**< bridge off, waits for run to rise */
    APP_MODE_ALIGN,     /**< finds the angle */
    APP_MODE_RUN,       /**< drive_tick() has the bridge */
    APP_MODE_FAULT,     /**< bridge off until a reset without run */
    APP_MODE_PRECHARGE, /**< all lower switches on: the gate drivers' supplies are charged */
    APP_MODE_STOP,      /**< run was withdrawn; the drive brakes before the bridge opens */
    APP_MODE_COMMISSION /**< measures the motor, commission.h */
} app_mode_t;

/** Why the mode is FAULT; the first reason is kept. */
typedef enum {
    APP_FAULT_NONE = 0,
    APP_FAULT_CONFIG,             /**< a constant is out of range; stays until power off */
    APP_FAULT_BOARD,              /**< see the board's flags */
    APP_FAULT_BACKGROUND,         /**< the background loop stood still */
    APP_FAULT_SAMPLE,             /**< invalid sample in CALIBRATE, ALIGN or RUN */
    APP_FAULT_OFFSET,             /**< a current offset is too far from nominal */
    APP_FAULT_TEMPERATURE_SENSOR, /**< broken, shorted, or too cold to tell */
    APP_FAULT_TEMPERATURE,        /**< heat sink too hot */
    APP_FAULT_INDEX,              /**< index pulse at a wrong position */
    APP_FAULT_ALIGN,              /**< alignment failed */
    APP_FAULT_DRIVE,              /**< see the drive's fault */
    APP_FAULT_TICK,               /**< no tick for too long; the background opened the bridge */
    APP_FAULT_HEAT,               /**< thermal model of motor or inverter tripped */
    APP_FAULT_MEMORY,             /**< constants in RAM have changed, or the stack was too short */
    APP_FAULT_COMMISSION,         /**< see the reason of the commissioning */
    APP_FAULT_CURRENT_SUM,        /**< the currents do not sum to zero, app_watch_sum.h */
    APP_FAULT_FOLLOWING           /**< the following error was beyond its window for too long */
} app_fault_t;

/** Snapshot of the tick of the first fault. It is kept until the next fault, even after a reset. */
typedef struct {
    app_fault_t    fault;
    app_mode_t     mode; /**< in which it happened */
    drive_fault_t  drive_fault;
    uint16_t       board_faults;
    board_sample_t raw;
    float          speed_e_radps;
    float          wanted_e_radps;
    uint32_t       ticks;
} app_snapshot_t;

typedef struct {
    app_mode_t            mode;
    app_fault_t           fault;
    drive_fault_t         drive_fault;
    uint16_t              board_faults; /**< flags of this tick */
    bool                  hot;          /**< above the temperature limit: no start */
    bool                  dc_link_out;  /**< outside the drive's range: no start */
    bool                  tripped;      /**< the trip input is active: no start */
    bool                  shorted;      /**< FAULT: the lower switches short the motor */
    bool                  gate_enable;
    bool                  voltage_limited; /**< the next voltage is limited */
    bool                  current_limited; /**< the current is at 0.9 of the limit or above */
    float                 derating;        /**< share of the current limit removed by heat */
    float                 motor_heat;      /**< 1: continuous load, app_watch_heat.h */
    float                 inverter_heat;
    uint16_t              position_jumps; /**< since the start; each dropped the reference */
    app_angle_reference_t reference;
    app_align_stage_t     align_stage;
    uint16_t              position_cnt;
    uint16_t              index_corrections;
    uint16_t              phase_errors;   /**< of the encoder since the start */
    uint16_t              ignored_angles; /**< rejected samples of this run, angle_gate.h */
    bool          without_angle;    /**< encoder lost: the drive brakes by the currents alone */
    uint16_t      ignored_currents; /**< rejected since start or reset, current_gate.h */
    board_reset_t reset_cause;
    float         theta_e_rad;
    float         speed_e_radps; /**< RUN: estimate; otherwise by difference */
    float         dc_link_V;
    float         temperature_degC;
    dq_t          i_A;     /**< RUN only */
    dq_t          i_ref_A; /**< RUN only */
    dq_t          v_V;     /**< RUN only */
#if APP_TRIM
    float ia_A; /**< phase currents */
    float ib_A;
#endif
    float                   d_omega; /**< RUN only: disturbance of the speed equation [rad/s^2] */
    float                   zero_a_cnt;
    float                   zero_b_cnt;
    uint16_t                tick_cycles;       /**< of the last tick; 65535 if more */
    uint16_t                tick_cycles_worst; /**< since the start */
    uint32_t                ticks;
    app_snapshot_t          snapshot;
    app_commission_status_t commission;
    app_control_state_t     state;             /**< app_control.h, as the next three */
    int16_t                 mode_of_operation; /**< in force */
    bool                    done;              /**< alignment or commissioning has ended */
    float                   demand_e_radps;    /**< output of the speed ramp */
    app_position_t          position;
    int32_t                 target_cnt;   /**< of the active set-point */
    bool                    acknowledged; /**< app_setpoint.h */
    bool                    arrived;      /**< the reference rests at the target */
    bool                    waits;        /**< the reference waits for a shaft that cannot follow */
    bool                    beyond;       /**< the following error is beyond its window */
    bool                    unled;        /**< no set-points for too long, app_path.h */
    bool                    held;         /**< a limit of position holds the set-point */
    app_homing_stage_t      homing;
    uint16_t                inputs; /**< active ones, BOARD_INPUT_ bits */
    app_brake_state_t       brake;
    float                   torque_share;        /**< RUN only: by the model, of the rated torque */
    float                   torque_demand_share; /**< RUN only: the same of their references */
#if BOARD_CHOPPER
    app_chopper_state_t chopper;
    float               chopper_heat; /**< 1: of the rated power */
#endif
#if APP_DISC_MAP
    app_disc_state_t disc; /**< map of the disc, app_disc.h */
#endif
} app_status_t;

/** A run follows one of these. */
typedef enum {
    APP_FOLLOWS_SPEED = 0,
    APP_FOLLOWS_POSITION,     /**< only drives with positions */
    APP_FOLLOWS_TORQUE,       /**< only drives with torques */
    APP_FOLLOWS_PATH,         /**< only drives with positions */
    APP_FOLLOWS_CYCLIC_SPEED, /**< of app_control.h alone, whose command follows the speed, as the
                                   next */
    APP_FOLLOWS_HOMING
} app_follows_t;

/** Command of the application modes. */
typedef struct {
    float omega_e_radps; /**< speed; out of the drive's range is a fault in RUN */
    bool  run;
    bool  reset;      /**< leave FAULT; ignored together with run */
    bool  commission; /**< measure the motor; starts when it rises in READY without run */
    bool  align;      /**< find the angle again; starts in the same way */
    float derating;   /**< unused share of the current limit, 0 .. 1 */
    app_commission_bounds_t bounds; /**< of the commissioning */
    app_follows_t           follows;
    position_t              target; /**< of a position, as the next */
    position_profile_t      profile;
    app_path_t             *path;                     /**< of a path, never NULL then */
    float                   torque_share;             /**< of the rated torque, as the next two */
    float                   torque_step;              /**< change in a period; > 0 */
    float                   torque_speed_max_e_radps; /**< speed limit, within the drive's */
} app_command_t;

/** Torque of these currents over the rated one, by the drive's model. Context: any. */
float app_torque_share(const drive_config_t *c, dq_t i_A);

#endif /* APP_STATUS_H */
