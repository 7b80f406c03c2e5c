/* SPDX-License-Identifier: MIT */
/**
 * @file board.h
 * @brief The whole hardware interface of the drive.
 *
 * Integers only: converter codes in, compare counts out. Exactly one implementation per program.
 *
 * Order of use: board_init(), board_start(); then everything else happens in the tick and in the
 * background loop. All six switches stay off until board_gate_enable().
 */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stdint.h>

#include "board_limits.h"

/** What was measured at the start of the present control period. */
typedef struct {
    uint16_t ia_cnt;          /**< phase current a, 0 .. BOARD_ADC_CODES - 1 */
    uint16_t ib_cnt;          /**< phase current b, taken at the same instant */
    uint16_t dc_link_cnt;     /**< dc-link voltage */
    uint16_t temperature_cnt; /**< heat sink */
    uint16_t position_cnt;    /**< below the positions of a turn, latched with the currents */
    uint16_t edge_age_cnt;    /**< from the last edge to the latch, ticks of BOARD_CAPTURE_Hz */
    uint16_t index_cnt;       /**< position latched at the last index pulse */
    uint16_t phase_errors;    /**< of the encoder since the start; wraps */
    bool     index_seen;      /**< an index pulse came since the sample before */
    bool edge_seen; /**< the position differs from the sample before, all the way in one direction:
                             edge_age_cnt holds, and the edge is the one passed last */
    bool valid;     /**< measured in this period */
} board_sample_t;

/** What a drive makes of the board, in the units of its registers; sdre-gains writes it (EQ-BOARD-1). */
typedef struct {
    uint32_t pwm_cycles;    /**< processor cycles per PWM period */
    uint16_t duty_full_cnt; /**< compare counts of duty one */
    uint16_t dead_time_cnt; /**< of the gates, in the same counts */
    uint16_t positions;     /**< of the encoder per turn: four for each line */
} board_setup_t;

/** On-time of the upper switches, 0 .. duty_full_cnt; more counts as full. */
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
    BOARD_FAULT_ENCODER = 8, /**< both encoder tracks changed at once, again and again */
    BOARD_FAULT_INPUT   = 16 /**< the trip input is active; the only one that is not latched */
};

/** What a board remembers over a power cut: slots of BOARD_STORE_WORDS words, each erased as a whole (board_limits.h). */
enum { BOARD_STORE_SLOTS = 4 };

/** Words that outlast board_restart() and not a power cut. */
#define BOARD_KEPT_WORDS 48U

/** Formats of the serial line, as Modbus has them: 11 bits an octet. */
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

/** What started the program, as far as the processor can tell: for a reader, nothing depends on it. */
typedef enum {
    BOARD_RESET_PIN = 0, /**< power, or the reset pin */
    BOARD_RESET_WATCHDOG /**< the program before hung, or board_restart() */
} board_reset_t;

/** Whether the registers can hold what the setup asks for. Context: init, or the loader. */
bool board_fits(const board_setup_t *setup);

/**
 * @brief Sets the peripherals up; all six switches stay off.
 *
 * @param setup Kept: it has to stay as it is.
 * @return false: the clock cannot be trusted (BOARD_FAULT_CLOCK), or a register does not hold what the setup asks for; do
 *         not go on to board_start().
 *
 * Context: init, once, interrupts off. About 5 ms.
 */
bool board_init(const board_setup_t *setup);

/**
 * @brief Starts the control periods and the watchdog.
 *
 * @param tick               Called once per control period, in the control ISR.
 * @param updates_per_period 1: a control period is a PWM period; 2: half of one; anything else counts as 1.
 *
 * Context: init, once, after board_init().
 */
void board_start(void (*tick)(void), uint16_t updates_per_period);

/** The sample of this period; it stays as it is for the whole tick. Context: control ISR. */
const board_sample_t *board_sample(void);

/** Duty ratios that act from the start of the next period. Context: control ISR. */
void board_duty_write(const board_duty_t *duty);

/**
 * @brief Lets the switches follow the duty ratios from the start of the next period on, where those of this
 *        period's board_duty_write() begin; the last thing to do on the way to running.
 *
 * Forgets latched faults whose cause is gone. Where a cause is left, its fault is latched and the bridge
 * stays off: check board_fault_read() in the next tick. Nothing happens while the gates are enabled.
 *
 * Context: control ISR.
 */
void board_gate_enable(void);

/** All six switches off, now, until board_gate_enable(). Context: any. */
void board_gate_trip(void);

/**
 * @brief BOARD_FAULT_ bits latched since board_gate_enable() last reset them, and BOARD_FAULT_INPUT.
 *
 * Each of them has opened the bridge already.
 *
 * Context: any.
 */
uint16_t board_fault_read(void);

/** Context: any, after board_init(). */
board_reset_t board_reset_cause(void);

/** True when board_restart() asked for the loader, once: asked again it is false. Context: init, after board_init(). */
bool board_loader_is_wanted(void);

/**
 * @brief Starts the program anew, by a reset of the device; all six switches are off from now on.
 *
 * @param loader What board_loader_is_wanted() shall tell then.
 *
 * Context: background or loader. Does not return.
 */
void board_restart(bool loader);

/** BOARD_KEPT_WORDS words that a restart leaves as they are; after power-on they are anything. Context: any. */
uint16_t *board_kept(void);

/** The words of a slot, in memory; NULL: the board has no store. Context: any. */
const uint16_t *board_store(uint16_t slot);

/** Makes all words of a slot 0xFFFF; lasts seconds. @return false: it failed. Context: loader: nothing else runs. */
bool board_store_erase(uint16_t slot);

/** Writes words that are erased; not a second time. @return false: it failed. Context: loader. */
bool board_store_program(uint16_t slot, uint32_t offset, const uint16_t *words, uint16_t count);

/** Processor cycles, free running, wraps; pwm_cycles of the setup per PWM period. Context: any. */
uint32_t board_cycles(void);

/** False: a call has gone down to the last words of the stack. Context: background. */
bool board_stack_is_whole(void);

/** Without it the processor is reset after 4 ms. Context: background. */
void board_watchdog_serve(void);

/** Whether the board can do this. Context: any. */
bool board_line_fits(const board_line_t *line);

/** Sets a line that fits up; before the first call it is 115200 Bd, even, without direction pin. Context: init. */
void board_line_set(const board_line_t *line);

/**
 * @brief Takes one received octet.
 *
 * @return false: nothing there, or what was there was received with an error and is dropped.
 *
 * Context: background.
 */
bool board_serial_read(uint16_t *octet);

/** Sends the low eight bits. @return false: no room. Context: background. */
bool board_serial_write(uint16_t octet);

#endif /* BOARD_H */
