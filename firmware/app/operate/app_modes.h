/* SPDX-License-Identifier: MIT */
/**
 * @file app_modes.h
 * @brief The application's state machine: one period from raw samples to duty ratios and a gate request.
 *
 *     BOOT -> CALIBRATE -> READY -> (ALIGN, unless the angle is referenced) -> (PRECHARGE, if needed) -> RUN
 *     RUN -> (STOP, while an open bridge would not be safe, or when it is asked for) -> READY
 *     READY -> COMMISSION, or ALIGN alone, when that is asked for -> READY
 *
 * Anything wrong in a mode that uses it leads to FAULT in the same call, with the bridge open or, at a speed at which that
 * is not safe, the motor shorted (app_stop.h). FAULT ends by a reset
 * command without run. A run starts when run rises in READY, never by itself, and not while something is in its way
 * that may go again: heat, a dc link out of range, an active trip input, a shaft too fast for a precharge.
 *
 * The board's fault flags count while the gates are enabled: enabling is what clears them.
 * Hardware is not touched here: app.c does what the output says.
 */
#ifndef APP_MODES_H
#define APP_MODES_H

#include "app_config.h"
#include "app_status.h"

typedef struct {
    const board_sample_t *raw;
    uint16_t              board_faults;
    bool                  background_lost; /**< the background has not run for too long */
    bool          tick_missing;   /**< ticks stood still, and the background opened the bridge */
    bool          memory_changed; /**< constants are not what they were, app_watch_memory.h */
    app_command_t command;        /**< reset is true for one tick only */
} app_modes_input_t;

typedef struct {
    const app_config_t *config;
    app_mode_t          mode;
    app_fault_t         fault;
    drive_t             drive;
    app_scale_t         scale;
    app_angle_t         angle;
    app_position_t      position;
    position_command_t  to_position; /**< what the drive is given on the way to one */
    app_align_t         align;
    app_stop_t          stop;
    app_watch_heat_t    heat;
    app_commission_t    commission;
    float               current_max_A; /**< of the drive */
    float               per_sink_degC; /**< 1 / (trip - limit) of the heat sink */
    bool                too_hot;       /**< app_watch_heat_tick() said so */
    float zero_a_A; /**< READY: mean of what the current sensors show with the bridge open */
    float zero_b_A;
    app_scale_sample_t  sample;
    app_angle_reading_t reading;
    uint32_t            ticks;
    uint32_t            sum_a_cnt;
    uint32_t            sum_b_cnt;
    uint16_t            timer_ticks; /**< BOOT, CALIBRATE, PRECHARGE: since the mode began */
    bool                calibrated;
    bool                armed;            /**< READY has seen run = false */
    bool                commission_armed; /**< READY has seen commission = false */
    bool                align_armed;      /**< and align = false */
    bool                hot;         /**< above the temperature limit, or temperature unknown */
    bool                dc_link_out; /**< outside the drive's range */
    bool                tripped;     /**< READY: the trip input is active */
    bool                gate_on;     /**< gates were enabled by an earlier tick */
    uint16_t            phase_errors;
    app_snapshot_t      snapshot;
} app_modes_t;

/**
 * @return CTL_BAD_CONFIG when a constant of config or drive is out of range, or the two disagree about the control
 *         period or the pole pairs; m is then in FAULT for good.
 *
 * Context: init.
 */
ctl_status_t app_modes_init(app_modes_t *m, const app_config_t *config,
                            const drive_config_t *drive);

/** Context: control ISR. Bounded: drive_tick() or app_align_tick() and about as much again. */
bridge_t app_modes_tick(app_modes_t *m, const app_modes_input_t *in);

/** Something keeps a run from starting, by the tick before. Context: control ISR. */
bool app_modes_in_the_way(const app_modes_t *m);

/** Everything but the reset's cause and the cycle counts; of one tick, unless one interrupts. Context: background. */
void app_modes_status(const volatile app_modes_t *m, uint16_t board_faults, app_status_t *s);

#endif /* APP_MODES_H */
