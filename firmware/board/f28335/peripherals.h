/* SPDX-License-Identifier: MIT */
/**
 * @file peripherals.h
 * @brief Internal interface between the files of this board.
 *
 * Context: init, unless a line says otherwise.
 */
#ifndef PERIPHERALS_H
#define PERIPHERALS_H

#include "DSP28x_Project.h"
#include "board.h"

#define BOARD_STACK_WORDS 0x700U  /**< --stack_size of CMakeLists.txt */
#define BOARD_STACK_FILL  0xC0DEU /**< STACK_FILL of codestart.asm */
#define BOARD_COPIES      2U      /**< entries of board_copies */

/** Words that codestart.asm has copied from the flash to the RAM. */
typedef struct {
    const volatile uint16_t *load;
    const volatile uint16_t *run;
    uint32_t                 words;
} board_copy_t;

extern const board_copy_t board_copies[BOARD_COPIES]; /**< code and tables; codestart.asm */

void gpio_make_safe(void);     /**< gate driver off and bridge pins low; call it first */
void gpio_connect(void);       /**< pins to their peripherals; the bridge must be tripped */
void gpio_use_direction(void); /**< the line's direction pin becomes an output, low */

bool clock_init(void);        /**< false: no crystal or no lock */
void clock_peripherals(void); /**< dividers and module clocks; PWM time bases stand still */
bool clock_is_good(void);     /**< the crystal is there. Context: any */

void flash_init(void); /**< wait states and pipeline; runs from RAM */

void pie_init(void);  /**< all vectors but the control ISR stop the drive */
void pie_start(void); /**< control interrupt on */

void trip_init(void);  /**< armed and tripped; before the PWM runs */
void trip_check(void); /**< enables requested gates. Context: start of the control ISR */
void trip_latch(
    uint16_t fault);     /**< latches it, opens the bridge. Context: init, control ISR masked */
void trip_overdue(void); /**< the same for an overrun. Context: INT13 */

void pwm_init(const board_setup_t *setup);
void pwm_start(uint16_t updates_per_period); /**< all three legs at once */

void adc_init(void);                   /**< about 5 ms */
bool adc_is_done(void);                /**< a conversion is complete. Context: control ISR */
void adc_rewind(void);                 /**< ready for the next one. Context: control ISR */
void adc_read(board_sample_t *sample); /**< context: control ISR */

void encoder_init(const board_setup_t *setup);
void encoder_start(uint16_t updates_per_period); /**< call it next to pwm_start() */
/** False: nothing was latched in this period. Context: control ISR. */
bool encoder_read(board_sample_t *sample);

void cycles_init(void);
void cycles_wait(uint32_t cycles);

void tick_watch_start(uint32_t period_cycles); /**< before the first control interrupt */
void tick_watch_serve(void); /**< an interrupt has come. Context: start of the control ISR */

/** "Loader wanted" and its complement. board_restart() preserves it; undefined after power-on. */
extern volatile uint32_t watchdog_after_reset[2];

void watchdog_stop(void); /**< reads the reset cause first */
void watchdog_start(void);

void serial_init(void);

void line_init(bool     uses_direction,
               uint32_t cycles_per_bit); /**< listens. Context: init or loader */
bool line_is_sending(void);              /**< an octet is on its way. Context: any */
void line_send(uint16_t octet);          /**< the FIFO must have room. Context: background */
void line_release(
    void); /**< listens again after the last octet. Context: control ISR, background */

void             control_isr_init(void (*tick)(void), uint32_t period_cycles);
__interrupt void control_isr(void);

#endif /* PERIPHERALS_H */
