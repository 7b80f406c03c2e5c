/* SPDX-License-Identifier: MIT */
/**
 * @file app_stop.h
 * @brief How a run ends, so that a motor that still turns fast does not charge the dc link through an open bridge.
 *
 * An open bridge is a rectifier for the line-to-line EMF, sqrt(3) flux omega. Up to the speed
 *
 *     omega_link = v_dc,max / (sqrt(3) flux)                                       EQ-APP-STOP-1
 *
 * it leaves the dc link within its range, and opening is safe. Beyond,
 *
 *     run withdrawn   the drive brakes under control, within the dc link's limits, and opens when it is slow enough
 *     a fault         the lower switches short the motor: the EMF stays in it, the current settles below flux / L_d
 *
 * until the speed is below 0.8 omega_link. A trip of the board, its over-current included, always opens.
 */
#ifndef APP_STOP_H
#define APP_STOP_H

#include "board.h"
#include "bridge.h"
#include "drive_tick.h"

typedef enum {
    APP_STOP_COAST = 0, /**< run withdrawn: opens, once slower than omega_link */
    APP_STOP_RAMP       /**< run withdrawn: brakes to standstill, then opens */
} app_stop_reaction_t;

typedef struct {
    app_stop_reaction_t reaction;
    float               still_e_radps; /**< RAMP opens below; > 0 */
    bool
        short_circuit; /**< faults beyond omega_link short the motor; false: they open the bridge, for a
                             dc link that takes the EMF of any speed */
} app_stop_config_t;

typedef struct {
    const app_stop_config_t *config;
    float                    link_e_radps; /**< omega_link */
    float                    trip_current_A;
    bool                     shorted;
} app_stop_t;

/** @return CTL_BAD_CONFIG when a constant is out of range. Context: init. */
ctl_status_t app_stop_init(app_stop_t *s, const app_stop_config_t *config,
                           const drive_config_t *drive);

/** Run was withdrawn: whether the drive has to go on and brake. Context: control ISR. */
bool app_stop_is_braking(const app_stop_t *s, float omega_e_radps);

/** A fault in a tick with enabled gates: decides between open and short. Context: control ISR. */
void app_stop_fault(app_stop_t *s, float omega_e_radps, drive_fault_t drive_fault,
                    uint16_t board_faults);

/** What a tick with a speed, and whether it is known, and with phase currents tells. */
typedef struct {
    float    omega_e_radps;
    float    ia_A;
    float    ib_A;
    bool     valid;
    uint16_t board_faults;
} app_stop_input_t;

/** The bridge of a tick in FAULT: shorted until the speed is known to be low, else open. Context: control ISR. */
bridge_t app_stop_bridge(app_stop_t *s, const app_stop_input_t *in);

#endif /* APP_STOP_H */
