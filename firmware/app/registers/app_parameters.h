/* SPDX-License-Identifier: MIT */
/**
 * @file app_parameters.h
 * @brief Non-volatile parameters: the registers that survive a power cut (docs/parameters.md).
 *
 * All of them are one record of the store, written as a whole:
 *
 *     0, 1     version of the format, high word first
 *     2 ..     three words each: a digest of name, type and unit; then the value as a master reads
 *              it, with a high word of 0 where it has one word
 *
 * Another firmware finds the parameters that it has too by their digests. It leaves out the others
 * and tells how many they are.
 *
 * Flash cannot be read while it is written, and the watchdog of a running application cannot be
 * stopped. Therefore the command copies the record into words that survive a reset, and restarts
 * the drive. main() then writes the record before anything else runs.
 */
#ifndef APP_PARAMETERS_H
#define APP_PARAMETERS_H

#include "app_image.h"

/** Commands of the objects 1010h and 1011h. */
typedef enum {
    APP_PARAMETERS_NO_COMMAND = 0,
    APP_PARAMETERS_STORE,
    APP_PARAMETERS_RESTORE,
    APP_PARAMETERS_ACCEPT /**< of parameters and image: what is in use instead of what is lost */
} app_parameters_command_t;

typedef enum {
    APP_PARAMETERS_DEFAULT = 0,   /**< nothing is stored */
    APP_PARAMETERS_STORED,        /**< the stored parameters are in use */
    APP_PARAMETERS_OTHER_VERSION, /**< stored in another format: defaults */
    APP_PARAMETERS_OUT_OF_RANGE,  /**< a stored value is out of range: defaults */
    APP_PARAMETERS_LOST,          /**< the last record is lost: the one before it, or defaults */
    APP_PARAMETERS_PARTLY         /**< some are not of this firmware; the others are in use */
} app_parameters_state_t;

/** Result of a command. */
typedef enum {
    APP_PARAMETERS_NOT_ASKED = 0,
    APP_PARAMETERS_DONE,
    APP_PARAMETERS_FLASH /**< the flash failed; the previous record stays valid */
} app_parameters_done_t;

typedef struct {
    app_parameters_state_t state;
    app_parameters_done_t  done;
    uint32_t               number;  /**< sequence number of the record in use; 0: defaults */
    uint32_t               writes;  /**< of the parameters' two sectors, in turn */
    uint16_t               dropped; /**< stored parameters that this firmware does not have */
    bool                   rested;  /**< a further write is allowed */
} app_parameters_t;

/** Chosen: writes that are allowed after power-on without a rest. */
#define APP_PARAMETERS_BURST 8U

/** Chosen: time from a start to a further write. A master that never stops then erases each of the
 * two sectors twelve times a day. */
#define APP_PARAMETERS_REST_s 3600.0f

struct app_registers;

/** Loads the newest record into freshly initialised registers. Context: init. */
void app_parameters_take(app_parameters_t *p, struct app_registers *r, app_parameters_done_t done);

/** Allows a further write when the drive has run for long enough. Context: background. */
void app_parameters_rest(app_parameters_t *p, float since_start_s);

/** Saves a command and the present parameters for app_parameters_work(). Context: background. */
void app_parameters_ask(const struct app_registers *r, app_parameters_command_t command);

/** Executes a saved command once. Takes seconds. Context: init, before board_start(). */
app_parameters_done_t app_parameters_work(app_image_t *in_force);

#endif /* APP_PARAMETERS_H */
