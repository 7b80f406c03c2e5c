/* SPDX-License-Identifier: MIT */
/**
 * @file app_modes.h
 * @brief The application's state machine: one period from raw samples to duty ratios and a gate
 * request.
 *
 *     BOOT -> CALIBRATE -> READY
 *     READY -> (ALIGN, without a reference) -> (PRECHARGE, if needed) -> RUN
 *
 *     RUN -> (STOP, while an open bridge is unsafe, or on request) -> READY
 *     READY -> COMMISSION, or ALIGN alone, on request -> READY
 *
 * A fault leads to FAULT in the same call, in each mode that depends on the faulty part. The bridge
 * opens; at a speed at which this is unsafe, the motor is shorted (app_stop.h). A reset command
 * without run ends FAULT.
 *
 * A holding brake that is used keeps the bridge on until it has closed: a withdrawn run brakes to
 * standstill first, whatever app_stop.h says. Faults do not wait for it.
 *
 * A run starts only when run rises in READY. Some temporary conditions prevent a start: heat, a dc
 * link out of range, an active trip input, a shaft too fast for a precharge.
 *
 * The board's fault flags count only while the gates are enabled, as enabling clears them. This
 * module does not access hardware: app.c executes its output.
 */
#ifndef APP_MODES_H
#define APP_MODES_H

#include "app_config.h"
#include "app_part.h"
#include "app_status.h"
#include "app_watch_sum.h"

typedef struct {
    const board_sample_t *raw;
    uint16_t              board_faults;
    bool                  background_lost; /**< the background has not run for too long */
    bool          tick_missing;   /**< ticks stood still, and the background opened the bridge */
    bool          memory_changed; /**< constants have changed, app_watch_memory.h */
    uint16_t      slow;           /**< APP_SLOW_SINK, APP_SLOW_HEAT: work of this period */
    app_command_t command;        /**< reset is true for one tick only */
} app_modes_input_t;

typedef struct {
    const app_config_t *config;
    app_mode_t          mode;
    app_fault_t         fault;
    drive_t             drive;
    app_angle_t         angle;
    app_position_t      position;
    position_command_t  to_position; /**< position command to the drive */
    app_align_t         align;
    app_stop_t          stop;
    app_watch_heat_t    heat;
    app_commission_t    commission;
    float               per_sink_degC; /**< 1 / (trip - limit) of the heat sink */
    float               over_degC;     /**< temperature of the heat sink, less its limit */
    app_fault_t
          sink_fault; /**< of a driven motor: temperature, its sensor, or the following error */
    bool  too_hot;    /**< the same: app_watch_heat_tick() returned false */
    float zero_a_A;   /**< READY: mean of the measured currents with the bridge open */
    float zero_b_A;
    app_scale_t         scale; /**< beside sample: the tick reaches both by one pointer */
    app_scale_sample_t  sample;
    app_angle_reading_t reading;
    uint32_t            ticks;
    uint32_t            sum_a_cnt;
    uint32_t            sum_b_cnt;
    uint16_t            timer_ticks; /**< BOOT, CALIBRATE, PRECHARGE: since the mode began */
    bool                calibrated;
    bool                armed;            /**< READY has seen run = false */
    bool                commission_armed; /**< READY has seen commission = false */
    bool                align_armed;      /**< READY has seen align = false */
    bool                hot;         /**< above the temperature limit, or temperature unknown */
    bool                dc_link_out; /**< outside the drive's range */
    bool                tripped;     /**< READY: the trip input is active */
    bool                locked;      /**< no start: a stored image or record is lost */
    bool                gate_on;     /**< gates were enabled by an earlier tick */
    uint16_t            phase_errors;
    app_snapshot_t      snapshot;
    law_aim_t           aim;          /**< to_position or to_torque, to the drive */
    torque_command_t    to_torque;    /**< torque command to the drive */
    uint32_t            torque_ticks; /**< of the last period that followed a torque */
    app_brake_t         brake;
#if BOARD_CHOPPER
    app_chopper_t chopper; /**< its app_chopper_tick() is of app.c */
#endif
#if BOARD_CURRENT_SENSORS == 3
    app_watch_sum_t sum;
    bool            sum_differs;
#endif
} app_modes_t;

/**
 * @return CTL_BAD_CONFIG: a constant is out of range, or config and drive disagree about the
 * control
 *         period or the pole pairs. The mode is then FAULT, permanently.
 *
 * Context: init.
 */
ctl_status_t app_modes_init(app_modes_t *m, const app_config_t *config,
                            const drive_config_t *drive);

/** Executes one period. Context: control ISR. Cost: twice drive_tick() or app_align_tick(). */
APP_PART bridge_t app_modes_tick(app_modes_t *m, const app_modes_input_t *in);

/** True if a temporary condition prevented a start in the previous tick. Context: control ISR. */
bool app_modes_in_the_way(const app_modes_t *m);

/** Tells the holding brake what the mode wants of it, app_brake_tick(). Context: control ISR, every
 * turn of the slow work. It runs from flash. */
void app_modes_brake(app_modes_t *m, const app_objects_t *o, bool turn, float ts_s);

/** Scope: 1 while the chopper's resistor is on. Context: control ISR. */
static inline float app_modes_chopper(const app_modes_t *m)
{
#if BOARD_CHOPPER
    return m->chopper.on ? 1.0f : 0.0f;
#else
    (void)m;
    return 0.0f;
#endif
}

/**
 * @brief Fills the status, except reset cause and cycle counts.
 *
 * The values belong to one tick, unless a tick interrupts the call. Context: background.
 */
void app_modes_status(const volatile app_modes_t *m, uint16_t board_faults, app_status_t *s);

#endif /* APP_MODES_H */
