/* SPDX-License-Identifier: MIT */
/**
 * @file app_stop.h
 * @brief Ends a run safely: a fast motor must not charge the dc link through an open bridge.
 *
 * An open bridge is a rectifier for the line-to-line EMF, sqrt(3) flux omega. Up to the speed
 *
 *     omega_link = v_dc,max / (sqrt(3) flux)                                       EQ-APP-STOP-1
 *
 * the dc link stays within its range, and opening is safe. Above it,
 *
 *     run withdrawn   the drive brakes under control within the dc link's limits, then opens
 *     a fault         the lower switches short the motor; its current settles below flux / L_d
 *
 * until the speed is below 0.8 omega_link. A trip of the board, over-current included, always
 * opens.
 */
#ifndef APP_STOP_H
#define APP_STOP_H

#include "board.h"
#include "bridge.h"
#include "drive_tick.h"

typedef enum {
    APP_STOP_COAST = 0, /**< run withdrawn: opens below omega_link */
    APP_STOP_RAMP       /**< run withdrawn: brakes to standstill, then opens */
} app_stop_reaction_t;

typedef struct {
    app_stop_reaction_t reaction;
    float               still_e_radps; /**< RAMP opens below; > 0 */
    bool short_circuit; /**< a fault above omega_link shorts the motor; false: it opens the bridge,
                             for a dc link that withstands the EMF at any speed */
} app_stop_config_t;

typedef struct {
    const app_stop_config_t *config;
    float                    link_e_radps; /**< omega_link */
    float                    trip_current_A;
    bool                     shorted;
} app_stop_t;

/** @return CTL_BAD_CONFIG when a constant is out of range. Context: init, or the loader. */
ctl_status_t app_stop_check(const app_stop_config_t *config, const drive_config_t *drive);

/** @return Result of the check. After CTL_BAD_CONFIG s is unusable. Context: init. */
ctl_status_t app_stop_init(app_stop_t *s, const app_stop_config_t *config,
                           const drive_config_t *drive);

/** After run was withdrawn: true if the drive must still brake. Context: control ISR. */
bool app_stop_is_braking(const app_stop_t *s, float omega_e_radps);

/** At a fault with enabled gates: decides between open and short. Context: control ISR. */
void app_stop_fault(app_stop_t *s, float omega_e_radps, drive_fault_t drive_fault,
                    uint16_t board_faults);

/** Inputs of one tick: speed, phase currents, whether each is known, and the board's faults. */
typedef struct {
    float    omega_e_radps;
    float    ia_A;
    float    ib_A;
    bool     speed_known;
    bool     valid; /**< currents */
    uint16_t board_faults;
} app_stop_input_t;

/** Bridge in FAULT: shorted until the speed is known to be low, then open. Context: control ISR. */
bridge_t app_stop_bridge(app_stop_t *s, const app_stop_input_t *in);

#endif /* APP_STOP_H */
