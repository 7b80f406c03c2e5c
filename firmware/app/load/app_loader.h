/* SPDX-License-Identifier: MIT */
/**
 * @file app_loader.h
 * @brief Writes an image of constants into the board's store, over Modbus or CAN
 * (docs/loading.md).
 *
 * Flash cannot be read while it is written, and an erasure takes seconds. Therefore the loader runs
 * alone, without control interrupt and watchdog. A reset with the bridge off starts it, and another
 * reset ends it.
 *
 * Its registers begin at APP_LOADER_FIRST. While the application runs, they identify its constants
 * and accept only the command that enters the loader. Function 43/14 gives the name of the
 * constants.
 */
#ifndef APP_LOADER_H
#define APP_LOADER_H

#include "app_image.h"

#define APP_LOADER_FIRST      8000U
#define APP_LOADER_NAME_WORDS 12   /**< of a field: 24 characters, the longest has as many */
#define APP_LOADER_DATA       100U /**< most content words in a request; Modbus allows 123 */

/** Holding registers, from APP_LOADER_FIRST on; values of 32 bits high word first. */
enum {
    APP_LOADER_COMMAND = 0,
    APP_LOADER_COUNT_HI, /**< words of the content that BEGIN announces */
    APP_LOADER_COUNT_LO,
    APP_LOADER_CRC_HI, /**< CRC-32 of the content (crc32.h), for COMMIT */
    APP_LOADER_CRC_LO,
    APP_LOADER_OFFSET_HI, /**< offset of the words in the same request */
    APP_LOADER_OFFSET_LO,
    APP_LOADER_WORDS,
    APP_LOADER_HOLDING_COUNT = APP_LOADER_WORDS + APP_LOADER_DATA
};

/** Values of APP_LOADER_COMMAND, which reads as 0. The loader answers first, then executes. The
 * state
 *  shows completion. During an erasure it does not answer for seconds. */
typedef enum {
    APP_LOADER_ENTER = 1, /**< from the application, bridge off: restart into the loader */
    APP_LOADER_BEGIN,     /**< erase the older slot */
    APP_LOADER_COMMIT,    /**< check everything, then make it the newest */
    APP_LOADER_FORGET,    /**< back to compiled-in constants */
    APP_LOADER_LEAVE      /**< restart into the application */
} app_loader_command_t;

/** Input registers, from APP_LOADER_FIRST on. */
enum {
    APP_LOADER_STATE = 0, /**< app_loader_state_t */
    APP_LOADER_REASON, /**< drive_image_result_t of a COMMIT, or of the stored image at the start */
    APP_LOADER_PUT_HI, /**< words written since BEGIN */
    APP_LOADER_PUT_LO,
    APP_LOADER_ROOM_HI, /**< largest image [words]; 0: the board has no store */
    APP_LOADER_ROOM_LO,
    APP_LOADER_LAW,       /**< number of the firmware's law */
    APP_LOADER_NUMBER_HI, /**< sequence number of the image in use; 0: compiled in */
    APP_LOADER_NUMBER_LO,
    APP_LOADER_FIELD, /**< of the board, with DRIVE_IMAGE_OTHER_BOARD (board_identity.h); else 0 */
    APP_LOADER_IMAGE_HI, /**< value of the image: bits of a float, as the next */
    APP_LOADER_IMAGE_LO,
    APP_LOADER_BOARD_HI, /**< value of the board */
    APP_LOADER_BOARD_LO,
    APP_LOADER_FIELD_NAME, /**< two characters a word, the first one high, zero padded */
    APP_LOADER_SUM_HI =
        APP_LOADER_FIELD_NAME + APP_LOADER_NAME_WORDS, /**< of the board's identity */
    APP_LOADER_SUM_LO,
    APP_LOADER_INPUT_COUNT
};

typedef enum {
    APP_LOADER_AWAY = 0, /**< the application runs */
    APP_LOADER_IDLE,
    APP_LOADER_BUSY,    /**< executes a command */
    APP_LOADER_WRITING, /**< after BEGIN */
    APP_LOADER_STORED,  /**< after COMMIT or FORGET; LEAVE activates the change */
    APP_LOADER_SUM,     /**< COMMIT refused: wrong CRC of the content */
    APP_LOADER_IMAGE,   /**< COMMIT refused, see APP_LOADER_REASON */
    APP_LOADER_FLASH    /**< the flash failed; the previous content stays valid */
} app_loader_state_t;

typedef struct {
    app_loader_state_t   state;
    app_loader_command_t task;  /**< in state BUSY */
    uint32_t             count; /**< argument of the command, as the next */
    uint32_t             crc;
    store_write_t        write;
    uint32_t             put_words;
    bool                 restart;  /**< after the answer has been sent */
    bool                 enter;    /**< the restart enters the loader */
    const app_image_t   *in_force; /**< the next three are copied: the loader overwrites them */
    bool                 fallback;
    uint32_t             number;
    uint16_t             law;
    app_image_t         *image; /**< buffer to check an image; NULL: the application runs */
} app_loader_t;

/** Sets up for the application, which uses this image. Context: init. */
void app_loader_init(app_loader_t *l, const app_image_t *in_force);

/** Reads input registers; `first` counts from APP_LOADER_FIRST. @return false: one does not
 * exist. */
bool app_loader_read(const app_loader_t *l, uint16_t first, uint16_t count, uint16_t *values);

/** Reads holding registers in the same way. They always read as 0. */
bool app_loader_read_holding(uint16_t first, uint16_t count, uint16_t *values);

typedef enum {
    APP_LOADER_OK = 0,
    APP_LOADER_BAD_ADDRESS,
    APP_LOADER_BAD_VALUE
} app_loader_result_t;

/**
 * @brief Takes a write request: one command with its arguments, or content words with their offset.
 *
 * @param gate_enable true: the bridge is on, and the request is refused.
 *
 * Context: background, or the loader. In the loader the call waits for the flash.
 */
app_loader_result_t app_loader_write(app_loader_t *l, bool gate_enable, uint16_t first,
                                     uint16_t count, const uint16_t *values);

/** Executes a pending command. Takes up to seconds. Context: loader. */
void app_loader_work(app_loader_t *l);

/** Starts the loader instead of the application. It overwrites `image`. Context: init. */
void app_loader_start(app_image_t *image);

/** Executes one pass of the loader; call it in an endless loop. Context: loader. */
void app_loader_pass(void);

#endif /* APP_LOADER_H */
