/* SPDX-License-Identifier: MIT */
/**
 * @file peripherals.h
 * @brief What the files of this board offer each other; no one else includes it.
 *
 * Context: init, unless a line says otherwise.
 */
#ifndef PERIPHERALS_H
#define PERIPHERALS_H

#include "DSP28x_Project.h"
#include "board.h"

#define BOARD_STACK_WORDS 0x700U  /**< --stack_size of CMakeLists.txt */
#define BOARD_STACK_FILL  0xC0DEU /**< STACK_FILL of codestart.asm */

void gpio_make_safe(void);     /**< gate driver off and bridge pins low; first of all */
void gpio_connect(void);       /**< pins to their peripherals; the bridge has to be tripped */
void gpio_use_direction(void); /**< the line's direction pin becomes an output, low */

bool clock_init(void);        /**< false: no crystal or no lock */
void clock_peripherals(void); /**< dividers and module clocks; PWM time bases stand still */
bool clock_is_good(void);     /**< the crystal is there. Context: any */

void flash_init(void); /**< wait states and pipeline; runs from RAM */

void pie_init(void);  /**< every vector stops the drive, but that of the control ISR */
void pie_start(void); /**< control interrupt on */

void trip_init(void);  /**< armed and tripped; before the PWM runs */
void trip_check(void); /**< enables wanted gates. Context: start of the control ISR */
void trip_latch(
    uint16_t fault);     /**< remembers and opens the bridge. Context: init, control ISR masked */
void trip_overdue(void); /**< the same, of an overrun. Context: INT13 */

void pwm_init(const board_setup_t *setup);
void pwm_start(uint16_t updates_per_period); /**< all three legs at once */

void adc_init(void);                   /**< about 5 ms */
bool adc_is_done(void);                /**< a conversion is complete. Context: control ISR */
void adc_rewind(void);                 /**< ready for the next one. Context: control ISR */
void adc_read(board_sample_t *sample); /**< context: control ISR */

void encoder_init(const board_setup_t *setup);
void encoder_start(uint16_t updates_per_period); /**< next to pwm_start() */
/** False: nothing was latched in this period. Context: control ISR. */
bool encoder_read(board_sample_t *sample);

void cycles_init(void);
void cycles_wait(uint32_t cycles);

void tick_watch_start(uint32_t period_cycles); /**< before the first control interrupt */
void tick_watch_serve(void); /**< an interrupt has come. Context: start of the control ISR */

/** "Loader wanted" and its complement; outlasts board_restart(), after power-on it is anything. */
extern volatile uint32_t watchdog_after_reset[2];

void watchdog_stop(void); /**< first reads what has reset the device */
void watchdog_start(void);

void serial_init(void);

void line_init(bool     uses_direction,
               uint32_t cycles_per_bit); /**< listens. Context: init or loader */
bool line_is_sending(void);              /**< an octet is on its way. Context: any */
void line_send(uint16_t octet);          /**< there has to be room. Context: background */
void line_release(
    void); /**< listens again after the last octet. Context: control ISR, background */

void             control_isr_init(void (*tick)(void), uint32_t period_cycles);
__interrupt void control_isr(void);

#endif /* PERIPHERALS_H */
