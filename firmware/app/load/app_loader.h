/* SPDX-License-Identifier: MIT */
/**
 * @file app_loader.h
 * @brief Writes an image of constants into the board's store, over Modbus: docs/loading.md.
 *
 * A flash that is being written cannot be read, and an erasure lasts seconds: so nothing else runs meanwhile, no control
 * interrupt, no watchdog. The application enters the loader by a reset, with the bridge off, and the loader leaves by
 * another. Registers from APP_LOADER_FIRST on; while the application runs they tell what it runs with (its name: function
 * 43/14), and take the one command that enters.
 */
#ifndef APP_LOADER_H
#define APP_LOADER_H

#include "app_image.h"

#define APP_LOADER_FIRST 8000U
#define APP_LOADER_DATA  100U /**< words of content in a request at most; Modbus has room for 123 */

/** Holding registers, from APP_LOADER_FIRST on; values of 32 bits high word first. */
enum {
    APP_LOADER_COMMAND = 0,
    APP_LOADER_COUNT_HI, /**< words of the content that BEGIN announces */
    APP_LOADER_COUNT_LO,
    APP_LOADER_CRC_HI, /**< CRC-32 of the content (crc32.h), for COMMIT */
    APP_LOADER_CRC_LO,
    APP_LOADER_OFFSET_HI, /**< where the words that follow in the same request belong */
    APP_LOADER_OFFSET_LO,
    APP_LOADER_WORDS,
    APP_LOADER_HOLDING_COUNT = APP_LOADER_WORDS + APP_LOADER_DATA
};

/** Values of APP_LOADER_COMMAND; reads as 0. The loader answers first and then sets to work: the state tells when it is
 * done, and an erasure leaves it deaf for seconds. */
typedef enum {
    APP_LOADER_ENTER = 1, /**< the application: restart into the loader; only with the bridge off */
    APP_LOADER_BEGIN,     /**< erase the older slot */
    APP_LOADER_COMMIT,    /**< check everything, then make it the newest */
    APP_LOADER_FORGET,    /**< erase both: back to what is compiled in */
    APP_LOADER_LEAVE      /**< restart into the application */
} app_loader_command_t;

/** Input registers, from APP_LOADER_FIRST on. */
enum {
    APP_LOADER_STATE = 0, /**< app_loader_state_t */
    APP_LOADER_REASON,    /**< drive_image_result_t of a COMMIT that was refused */
    APP_LOADER_PUT_HI,    /**< words written since BEGIN */
    APP_LOADER_PUT_LO,
    APP_LOADER_ROOM_HI, /**< words that an image may have; 0: the board has no store */
    APP_LOADER_ROOM_LO,
    APP_LOADER_LAW,       /**< number of the firmware's law */
    APP_LOADER_NUMBER_HI, /**< of the image in force; 0: compiled in */
    APP_LOADER_NUMBER_LO,
    APP_LOADER_INPUT_COUNT
};

typedef enum {
    APP_LOADER_AWAY = 0, /**< the application runs */
    APP_LOADER_IDLE,
    APP_LOADER_BUSY,    /**< with a command */
    APP_LOADER_WRITING, /**< after BEGIN */
    APP_LOADER_STORED,  /**< after COMMIT or FORGET: LEAVE makes it act */
    APP_LOADER_SUM,     /**< COMMIT refused: the CRC is not that of the content */
    APP_LOADER_IMAGE,   /**< COMMIT refused, see APP_LOADER_REASON */
    APP_LOADER_FLASH    /**< the flash failed; what was stored before stays in force */
} app_loader_state_t;

typedef struct {
    app_loader_state_t   state;
    drive_image_result_t reason;
    app_loader_command_t task;  /**< in state BUSY */
    uint32_t             count; /**< what came with it */
    uint32_t             crc;
    store_write_t        write;
    uint32_t             put_words;
    bool                 restart; /**< after the answer has been sent */
    bool                 enter;   /**< that restart is into the loader */
    uint32_t             number;  /**< in force; as the next */
    uint16_t             law;
    app_image_t         *image; /**< room to try an image in; NULL: the application runs */
} app_loader_t;

/** What the application runs with. Context: init. */
void app_loader_init(app_loader_t *l, const app_image_t *in_force);

/** `count` input registers, `first` counted from APP_LOADER_FIRST. @return false: not all of them exist. */
bool app_loader_read(const app_loader_t *l, uint16_t first, uint16_t count, uint16_t *values);

/** The same of the holding registers: what a write would have to repeat is not kept, they read as 0. */
bool app_loader_read_holding(uint16_t first, uint16_t count, uint16_t *values);

typedef enum {
    APP_LOADER_OK = 0,
    APP_LOADER_BAD_ADDRESS,
    APP_LOADER_BAD_VALUE
} app_loader_result_t;

/**
 * @brief Takes a request: one command with what belongs to it, or words of the content with their offset.
 *
 * @param gate_enable The bridge is on: nothing is taken.
 *
 * Context: background, or the loader, where words wait for the flash.
 */
app_loader_result_t app_loader_write(app_loader_t *l, bool gate_enable, uint16_t first,
                                     uint16_t count, const uint16_t *values);

/** Does the task at hand, if there is one. Context: loader; lasts seconds. */
void app_loader_work(app_loader_t *l);

/** The loader begins to run, instead of the application. `image` is overwritten. Context: init. */
void app_loader_start(app_image_t *image);

/** One pass of the loader; for ever. Context: loader. */
void app_loader_pass(void);

#endif /* APP_LOADER_H */
