/* SPDX-License-Identifier: MIT */
/**
 * @file app_registers.h
 * @brief The application as 16-bit registers, from registers.toml. docs/modbus.md has the units.
 *
 * Holding registers are commands of the operator; input registers report the application. Values
 * are rounded to their unit and limited to their type. Context: background.
 */
#ifndef APP_REGISTERS_H
#define APP_REGISTERS_H

#include "app_config.h"
#include "app_control.h"
#include "app_error.h"
#include "app_loader.h"
#include "app_parameters.h"
#include "app_registers_map.h"
#include "app_status.h"
#include "app_traces.h"
#include "app_trim.h"
#include "app_units.h"
#include "app_watch_inertia.h"
#include "app_watch_ring.h"

/** Input registers are also holding registers from this address on, for function 23. */
#define APP_REGISTERS_INPUTS_TOO 4096U

/** Bits of APP_REGISTERS_CONDITIONS. */
enum {
    APP_REGISTERS_HOT           = 1,
    APP_REGISTERS_SILENT        = 2,
    APP_REGISTERS_GATE          = 4,
    APP_REGISTERS_DC_OUT        = 8,
    APP_REGISTERS_TRIPPED       = 16,
    APP_REGISTERS_SHORTED       = 32,
    APP_REGISTERS_WITHOUT_ANGLE = 64,
    APP_REGISTERS_VOLTAGE_LIMIT = 128,
    APP_REGISTERS_CURRENT_LIMIT = 256,
    APP_REGISTERS_DERATED       = 512,
    APP_REGISTERS_DEFAULTS      = 1024,
    APP_REGISTERS_IMAGE_LOST    = 2048,
    APP_REGISTERS_RECORD_LOST   = 4096,
    APP_REGISTERS_RINGS         = 8192,
    APP_REGISTERS_CHOPPER       = 16384
};

/** Bits of APP_REGISTERS_STATUSWORD; the state has bits 0 to 3, 5 and 6. */
enum {
    APP_REGISTERS_VOLTAGE            = 16, /**< dc link within its range */
    APP_REGISTERS_WARNING            = 128,
    APP_REGISTERS_STOPPED_BY_SILENCE = 256,
    APP_REGISTERS_REMOTE             = 512,
    APP_REGISTERS_REACHED            = 1024,
    APP_REGISTERS_LIMITED            = 2048,
    APP_REGISTERS_OF_MODE =
        4096, /**< velocity: speed is zero; position: set-point taken; homing: done; the cyclic
                   modes: follows the command */
    APP_REGISTERS_FOLLOWING_ERROR =
        8192, /**< positions: the reference waits for a shaft that cannot follow, or the following
                   error is beyond its window */
    APP_REGISTERS_BRIDGE_ON = 16384
};

#define APP_REGISTERS_REFERENCED 0x8000U /**< bit 15 of it: beyond an int of 16 bits */

/** Bits of APP_REGISTERS_FIRST_SAMPLE. */
enum { APP_REGISTERS_SAMPLE_VALID = 1, APP_REGISTERS_SAMPLE_INDEX = 2 };

typedef enum {
    APP_REGISTERS_OK = 0,
    APP_REGISTERS_BAD_ADDRESS, /**< a register does not exist, or half of a value is written */
    APP_REGISTERS_BAD_VALUE,   /**< out of range; nothing was written */
    APP_REGISTERS_BUSY         /**< refused while the bridge is on; nothing was written */
} app_registers_result_t;

/** Contents of the holding registers. */
typedef struct app_registers_request {
    app_objects_t         objects; /**< without its positions */
    app_units_t           units;
    app_units_scale_t     scale; /**< of these units */
    app_units_positions_t positions;
    uint32_t              window_cnt;         /**< counts of its window */
    float                 speed_most_e_radps; /**< limit of the commanded speeds; 0: the drive's */
    app_scope_setup_t     scope;
    uint16_t              scope_command; /**< 1 arms, 2 stops */
    uint16_t              modbus_address;
    uint32_t              modbus_timeout_ticks;
    board_line_t          line;
    uint16_t              can_node; /**< 1 .. 127 */
    uint16_t              can_rate_kbps;
    uint16_t              store_command; /**< app_parameters_command_t */
#if APP_WATCH_INERTIA
    uint16_t inertia_start; /**< INERTIA_START, in thousandths; 0: the law keeps the drive's */
#endif
#if APP_TRIM
    uint16_t trim; /**< 1: trims the current sensors, app_trim.h */
#endif
} app_registers_request_t;

typedef struct app_registers {
    const app_config_t   *config;
    const drive_config_t *drive;
    float                 rpm_per_e_radps;
    app_status_t          status;
#if APP_WATCH_INERTIA
    app_watch_inertia_t inertia;         /**< that changes of speed showed */
    uint16_t            inertia_started; /**< INERTIA_START that it began with */
#endif
#if APP_TRIM
    app_trim_t        trim;
    app_trim_values_t trimmed; /**< values in force */
#endif
    app_watch_ring_t                 ring; /**< oscillation of the torque current */
    app_registers_request_t          requested;
    app_registers_request_t          trial; /**< copy that writes change until they are accepted */
    volatile app_scope_t            *scope; /**< NULL: neither scope nor record */
    const volatile app_record_t     *record;
    const volatile commission_map_t *map;        /**< of the commissioning; NULL: none */
    app_loader_t                    *loader;     /**< serves APP_LOADER_FIRST and up; NULL: none */
    const app_parameters_t          *parameters; /**< NULL: they cannot be stored now */
    bool                             changed;    /**< command is new; its taker clears this */
    bool                             silent;     /**< stopped by a communication time-out */
    bool                             by_can;     /**< CAN wrote the control word last */
} app_registers_t;

/**
 * @brief Sets the registers from the constants, which must stay valid.
 * @return CTL_BAD_CONFIG: the address or the time-out is out of range. Context: init.
 */
ctl_status_t app_registers_init(app_registers_t *r, const app_config_t *config,
                                const drive_config_t *drive);

/** The shaft has the drive's inertia, and the law keeps it. */
void app_registers_init_inertia(app_registers_t *r);

/** Lets the status that has just been read show the inertia, app_watch_inertia.h. A law without an
 * estimate of the load shows none. @param believed Inertia that the law has, over the drive's. */
void app_registers_see_inertia(app_registers_t *r, float believed);

/** Inertia that the law is to believe, over the drive's. If INERTIA_START allows it, that is the
 * learned one in runs with a commanded speed and an encoder; else it is 1. */
float app_registers_inertia_wanted(const app_registers_t *r);

/** Value of INERTIA_START, and a write to it. */
uint16_t app_registers_inertia_start(const app_registers_t *r);
void     app_registers_set_inertia_start(app_registers_request_t *w, float thousandths);

/** Inertia that the law believes, over the drive's. */
float app_registers_inertia_believed(const app_registers_t *r);

/** Stops an enabled operation whose set-points have ended, as app_registers_silence(). */
void app_registers_see_path(app_registers_t *r);

/** Lets the status that has just been read show an oscillation, app_watch_ring.h. */
void app_registers_see_ring(app_registers_t *r);

/** Believes the current sensors, and learns them by default. Context: init. */
void app_registers_init_trim(app_registers_t *r);

/** Lets the status that has just been read trim the current sensors, app_trim.h. */
void app_registers_see_trim(app_registers_t *r, volatile app_scale_t *scale);

/** Value of SENSOR_TRIM, and a write to it. */
uint16_t app_registers_trim_on(const app_registers_t *r);
void     app_registers_set_trim(app_registers_request_t *w, float on);

/** Values that are taken off the readings. An image without APP_TRIM has zeros. */
app_trim_values_t app_registers_trimmed(const app_registers_t *r);

/** Blocks that taught it. */
uint16_t app_registers_trim_blocks(const app_registers_t *r);

/** State of the brake chopper, app_chopper.h. */
app_chopper_state_t app_registers_chopper(const app_registers_t *r);

/** Heat of the chopper's resistor; 0: no chopper. */
float app_registers_chopper_heat(const app_registers_t *r);

/** Digital outputs of 60FEh: bit 0 while the holding brake is set. */
uint16_t app_registers_outputs(const app_registers_t *r);

/** True if a condition keeps the chopper's resistor off. */
bool app_registers_chopper_rests(const app_registers_t *r);

/** State of the map of the encoder disc, app_disc.h. */
app_disc_state_t app_registers_disc(const app_registers_t *r);

/** Inductance of a bin over the mean; 0: not measured. @param row Of commission_map_t, first ld. */
float app_registers_mapped(const app_registers_t *r, int16_t row, int16_t bin);

/** Width of a bin [A]; 0: not measured. */
float app_registers_map_step_A(const app_registers_t *r);

/** d current beside the q waves [A]. */
float app_registers_map_bias_A(const app_registers_t *r);

/** Frequency of the last oscillation [Hz]; 0: none since the start. */
float app_registers_ring(const app_registers_t *r);

/** Inertia of the shaft over the drive's; 1 until something was learned. */
float app_registers_inertia(const app_registers_t *r);

/** Changes of speed that taught it. */
uint16_t app_registers_inertia_changes(const app_registers_t *r);

/** Reads `count` holding registers. APP_REGISTERS_INPUTS_TOO and up are the input registers. */
app_registers_result_t app_registers_read_holding(const app_registers_t *r, uint16_t first,
                                                  uint16_t count, uint16_t *values);

/** Name of the board; empty until the application knows its image. */
const char *app_registers_board(const app_registers_t *r);

/** Reads `count` input registers from `first` on. */
app_registers_result_t app_registers_read_input(const app_registers_t *r, uint16_t first,
                                                uint16_t count, uint16_t *values);

/** Begins writes of which nothing is requested: `trial` is the copy that they change. */
void app_registers_begin(app_registers_t *r);

/** One of these writes, to holding registers other than the loader's. A refused one may have
 * written some of them. */
app_registers_result_t app_registers_try(app_registers_t *r, uint16_t first, uint16_t count,
                                         const uint16_t *values);

/** Ends them. @return false: their values contradict each other or the drive. */
bool app_registers_fits(app_registers_t *r);

/** Writes all registers, or none if one address or value is refused. */
app_registers_result_t app_registers_write(app_registers_t *r, uint16_t first, uint16_t count,
                                           const uint16_t *values);

/** Words of a stored parameter: its digest (app_registers_entry_t), and the value as two words, the
 * high one first. */
#define APP_REGISTERS_SAVED_EACH 3U

/** Reads the APP_REGISTERS_SAVED * APP_REGISTERS_SAVED_EACH words of all parameters. */
void app_registers_saved_read(const app_registers_t *r, uint16_t *words);

/**
 * @brief Sets the parameters that this firmware has too. Others stay as they are.
 *
 * @param r       Registers.
 * @param words   Stored parameters in any order.
 * @param count   Their number.
 * @param unknown Number of those that this firmware does not have.
 * @return false: one is out of range, and none was set.
 *
 * Context: init.
 */
bool app_registers_saved_take(app_registers_t *r, const uint16_t *words, uint16_t count,
                              uint16_t *unknown);

/** Communication time-out: stops an enabled operation. */
void app_registers_silence(app_registers_t *r);

/** Number of control periods in a time below one hour. */
uint32_t app_registers_ticks(const app_registers_t *r, float time_s);

/** Position units that are counts, and default positions. Context: init. */
void app_registers_init_units(app_registers_t *r);

/** Reduces new units. A speed or a torque keeps its number when POLARITY reverses it.
 * @return false: units or positions are out of range. */
bool app_registers_see_units(const app_registers_t *r, app_registers_request_t *w);

/** Command of a request, with its positions in counts and its speeds within PROFILE_SPEED_MAX. */
void app_registers_command(const app_registers_request_t *w, app_objects_t *out);

/** True if PROFILE_SPEED_MAX cuts the target of a speed run. */
bool app_registers_cuts_speed(const app_registers_t *r);

/** Position of the shaft, and of the active set-point [position units]. */
int32_t app_registers_position(const app_registers_t *r);
int32_t app_registers_target(const app_registers_t *r);

/** Position units in a turn of the motor. */
float app_registers_turn_units(const app_registers_t *r);

/** Value of APP_REGISTERS_SUPPORTED_MODES. */
uint32_t app_registers_modes(const app_registers_t *r);

/** Current limit over the rated current, and a write to it. */
float app_registers_current_share(const app_registers_t *r);
void  app_registers_set_current_share(const app_registers_t *r, app_registers_request_t *w,
                                      float share);

/** Value of APP_REGISTERS_STATUSWORD. */
uint16_t app_registers_statusword(const app_registers_t *r);

/** Values of the registers of scope and record; 0 where there are none. */
uint32_t app_registers_scope_state(const app_registers_t *r);
uint32_t app_registers_scope_ticks(const app_registers_t *r);
uint32_t app_registers_record_number(const app_registers_t *r);
uint32_t app_registers_record_count(const app_registers_t *r);

/** Values of the registers of the stored parameters. */
uint32_t app_registers_stored_state(const app_registers_t *r);
uint32_t app_registers_stored_done(const app_registers_t *r);
uint32_t app_registers_stored_number(const app_registers_t *r);
uint32_t app_registers_stored_writes(const app_registers_t *r);
uint32_t app_registers_stored_dropped(const app_registers_t *r);

/** Conditions that prevent a start: APP_REGISTERS_IMAGE_LOST, APP_REGISTERS_RECORD_LOST. */
uint16_t app_registers_lost(const app_registers_t *r);

/** Value of APP_REGISTERS_CONDITIONS. */
uint16_t app_registers_conditions(const app_registers_t *r);

/** Value of APP_REGISTERS_FIRST_SAMPLE. */
uint16_t app_registers_first_sample(const app_registers_t *r);

#endif /* APP_REGISTERS_H */
