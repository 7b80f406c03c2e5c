/* SPDX-License-Identifier: MIT */
/**
 * @file board.h
 * @brief The whole hardware interface of the drive.
 *
 * It handles integers only: converter codes in, compare counts out. Each program links exactly one
 * implementation.
 *
 * Call board_init() first, then board_start(). After that, only the tick and the background loop
 * call it. All six switches stay off until board_gate_enable().
 */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stdint.h>

#include "board_limits.h"

/** Current sensors that the firmware reads at most, 2 or 3. CMake finds them in board_config.c. */
#ifndef BOARD_CURRENT_SENSORS
#define BOARD_CURRENT_SENSORS 2
#endif

/** 1: the firmware may switch a brake chopper. CMake finds it in board_config.c. */
#ifndef BOARD_CHOPPER
#define BOARD_CHOPPER 0
#endif

/** Measurements at the start of the present control period. */
typedef struct {
    uint16_t ia_cnt;          /**< phase current a, 0 .. BOARD_ADC_CODES - 1 */
    uint16_t ib_cnt;          /**< phase current b, taken at the same instant */
    uint16_t dc_link_cnt;     /**< dc-link voltage */
    uint16_t temperature_cnt; /**< heat sink */
    uint16_t position_cnt;    /**< 0 .. positions - 1, latched with the currents */
    uint16_t edge_age_cnt;    /**< from the last edge to the latch, ticks of BOARD_CAPTURE_Hz */
    uint16_t index_cnt;       /**< position latched at the last index pulse */
    uint16_t ic_cnt;          /**< phase current c, of a board with three sensors; soon after the
                                   others */
    uint16_t phase_errors;    /**< of the encoder since the start; wraps */
    bool     index_seen;      /**< an index pulse came since the previous sample */
    bool     edge_seen; /**< the position changed since the previous sample, in one direction only;
                             edge_age_cnt is then valid for the last edge */
    bool     valid;     /**< measured in this period */
} board_sample_t;

/** Board settings of a drive, in register units. sdre-gains computes them (EQ-BOARD-1). */
typedef struct {
    uint32_t pwm_cycles;      /**< processor cycles per PWM period */
    uint16_t duty_full_cnt;   /**< compare counts of duty one */
    uint16_t dead_time_cnt;   /**< of the gates, in the same counts */
    uint16_t positions;       /**< of the encoder per turn: four for each line */
    uint16_t current_sensors; /**< 2: phases a and b; 3: c too */
    uint16_t chopper;         /**< 1: a brake chopper at its pin */
} board_setup_t;

/** On-time of the upper switches, 0 .. duty_full_cnt. A larger value acts as duty_full_cnt. */
typedef struct {
    uint16_t a_cnt;
    uint16_t b_cnt;
    uint16_t c_cnt;
} board_duty_t;

/** Bits of board_fault_read(). */
enum {
    BOARD_FAULT_NONE = 0,
    BOARD_FAULT_TRIP = 1, /**< the hardware opened the bridge, or its trip input is active */
    BOARD_FAULT_OVERRUN =
        2, /**< a tick outlasted its control period or has not ended, or a period got no tick */
    BOARD_FAULT_CLOCK   = 4, /**< the crystal is missing, or the PLL did not lock */
    BOARD_FAULT_ENCODER = 8, /**< repeatedly, both encoder tracks changed at once */
    BOARD_FAULT_INPUT   = 16 /**< the trip input is active; the only one that is not latched */
};

/** Bits of board_inputs(). */
enum { BOARD_INPUT_NEGATIVE = 1, BOARD_INPUT_POSITIVE = 2, BOARD_INPUT_HOME = 4 };

/** Non-volatile memory: slots of BOARD_STORE_WORDS words (board_limits.h), erased as a whole. */
enum { BOARD_STORE_SLOTS = 4 };

/** Number of words that survive board_restart() but not a power cut. */
#define BOARD_KEPT_WORDS 143U

/** Formats of the serial line. As Modbus requires, each has 11 bits an octet. */
enum {
    BOARD_LINE_EVEN = 0, /**< parity, one stop bit */
    BOARD_LINE_ODD,
    BOARD_LINE_NONE /**< no parity, two stop bits */
};

typedef struct {
    uint32_t baud_Bd;
    uint16_t format;    /**< BOARD_LINE_ */
    uint16_t direction; /**< 1: a pin is high while the board sends, for a transceiver */
} board_line_t;

/** A data frame of the CAN bus with an identifier of 11 bits. */
typedef struct {
    uint16_t id;
    uint16_t length;    /**< octets, 0 .. 8 */
    uint16_t octets[8]; /**< the low eight bits of each count */
} board_can_frame_t;

/** Place of the trigger among the identifiers of board_can_listen(). */
#define BOARD_CAN_TRIGGER 1U

/** Identifiers that board_can_listen() takes at most. */
#define BOARD_CAN_IDS 8U

/** Bits of board_can_state(). */
enum {
    BOARD_CAN_PASSIVE = 1, /**< the error counters show a disturbed bus, or one without others */
    BOARD_CAN_OFF     = 2, /**< too many errors: off the bus until 128 pauses of 11 bits */
    BOARD_CAN_LOST    = 4  /**< since the last call a frame came that had no room */
};

/** Cause of the last reset, as far as the processor can tell. It is information only. */
typedef enum {
    BOARD_RESET_PIN = 0, /**< power, or the reset pin */
    BOARD_RESET_WATCHDOG /**< the program hung, or called board_restart() */
} board_reset_t;

/** True if the registers can hold this setup. Context: init, or the loader. */
bool board_fits(const board_setup_t *setup);

/**
 * @brief Sets up the peripherals. All six switches stay off.
 *
 * @param setup Must stay valid and unchanged: the board keeps the pointer.
 * @return false: the clock failed (BOARD_FAULT_CLOCK), or a register cannot hold the setup. Then
 *         board_start() must not be called.
 *
 * Context: init, once, interrupts off. About 5 ms.
 */
bool board_init(const board_setup_t *setup);

/**
 * @brief Starts the control periods and the watchdog.
 *
 * @param tick               Called once per control period, in the control ISR.
 * @param updates_per_period 1: a control period is a PWM period. 2: it is half a PWM period. Any
 *                           other value acts as 1.
 *
 * Context: init, once, after board_init().
 */
void board_start(void (*tick)(void), uint16_t updates_per_period);

/** The sample of this period. It does not change during the tick. Context: control ISR. */
const board_sample_t *board_sample(void);

/** Duty ratios that act from the start of the next period. Context: control ISR. */
void board_duty_write(const board_duty_t *duty);

/**
 * @brief Switches the resistor of the brake chopper.
 *
 * On lasts for one and a half PWM periods: call it in every period. A program that stops, a
 * debugger or a reset therefore end it. board_gate_trip() does not, as an open bridge may charge
 * the dc link. Call it only if the setup has a chopper.
 *
 * Context: control ISR.
 */
void board_chopper_write(bool on);

/**
 * @brief Releases the holding brake, or lets its spring close it.
 *
 * A release lasts for 10 ms: call it again before. A program that stops, a debugger or a reset
 * therefore end it. It has no effect while the gates are off, and board_gate_trip() or the trip
 * input end it at once.
 *
 * Context: control ISR.
 */
void board_brake_write(bool release);

/**
 * @brief Enables the gates from the start of the next period on.
 *
 * The duty ratios of this period's board_duty_write() act from the same instant. Call it last when
 * a run starts. It clears latched faults whose cause is gone. If a cause persists, its fault is
 * latched and the bridge stays off: check board_fault_read() in the next tick. With enabled gates
 * the call has no effect.
 *
 * Context: control ISR.
 */
void board_gate_enable(void);

/** Turns all six switches off at once, until board_gate_enable(). Context: any. */
void board_gate_trip(void);

/**
 * @brief Returns the latched BOARD_FAULT_ bits, and the present BOARD_FAULT_INPUT.
 *
 * board_gate_enable() clears the latches. Each of these faults has already opened the bridge.
 *
 * Context: any.
 */
uint16_t board_fault_read(void);

/** Levels of limit and home switches: a bit is set while its input is high. An open wire is high.
 * Context: any. */
uint16_t board_inputs(void);

/** Cause of the last reset. Context: any, after board_init(). */
board_reset_t board_reset_cause(void);

/** True once after board_restart() requested the loader. Context: init, after board_init(). */
bool board_loader_is_wanted(void);

/**
 * @brief Restarts the program by a reset of the device. All six switches go off first.
 *
 * @param loader Result of board_loader_is_wanted() after the restart.
 *
 * Context: background or loader. Does not return.
 */
void board_restart(bool loader);

/** BOARD_KEPT_WORDS words that a restart preserves; undefined after power-on. Context: any. */
uint16_t *board_kept(void);

/** Address of the words of a slot; NULL: the board has no store. Context: any. */
const uint16_t *board_store(uint16_t slot);

/** Erases a slot: all words become 0xFFFF. Takes seconds. @return false: failed. Context:
 * loader. */
bool board_store_erase(uint16_t slot);

/**
 * @brief Writes erased words, each only once.
 *
 * @param offset A multiple of BOARD_STORE_GRAIN. The board writes whole grains: words behind the
 *               last one of a grain are written too, as 0xFFFF.
 * @return false: failed.
 *
 * Context: loader.
 */
bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count);

/** Free-running count of processor cycles; wraps at 2^32. Context: any. */
uint32_t board_cycles(void);

/**
 * @brief False: the stack has used its last words, or code in the RAM differs from the flash.
 *
 * Each call compares the next 32 words of that code. Context: background.
 */
bool board_memory_is_whole(void);

/** Serves the watchdog, which resets the processor after 4 ms without it. Context: background. */
void board_watchdog_serve(void);

/** True if the board supports these line settings. Context: any. */
bool board_line_fits(const board_line_t *line);

/** Sets up a supported line. Default: 115200 Bd, even parity, no direction pin. Context: init. */
void board_line_set(const board_line_t *line);

/**
 * @brief Takes one received octet.
 *
 * @return false: no octet is available, or it had a receive error and is discarded.
 *
 * Context: background.
 */
bool board_serial_read(uint16_t *octet);

/** Sends the low eight bits. @return false: the transmit FIFO is full. Context: background. */
bool board_serial_write(uint16_t octet);

/** True if the board supports this bit rate of the CAN bus. Context: any. */
bool board_can_fits(uint16_t rate_kbps);

/**
 * @brief Leaves the CAN bus and returns to it with a supported bit rate.
 *
 * Frames that wait are dropped. It takes until a later board_can_state(), which never waits.
 *
 * Context: background or init.
 */
void board_can_set(uint16_t rate_kbps);

/** Receives frames with these identifiers, and no others. At most BOARD_CAN_IDS. Context:
 * background or init. */
void board_can_listen(const uint16_t *ids, uint16_t count);

/** Takes the oldest frame that was received. @return false: there is none. Context: background. */
bool board_can_read(board_can_frame_t *frame);

/** Forgets the frames with the identifier of the trigger that were read. Context: background. */
void board_can_arm(void);

/** True if a frame with this identifier waits, or was read since board_can_arm(). Context: any. */
bool board_can_triggered(void);

/**
 * @brief Sends a frame when the bus is free. The lowest identifier goes first.
 *
 * @return false: no room, or one with the same identifier still waits. Nothing was taken.
 *
 * Context: background.
 */
bool board_can_write(const board_can_frame_t *frame);

/** BOARD_CAN_ bits. Context: background, in every pass. */
uint16_t board_can_state(void);

#endif /* BOARD_H */
