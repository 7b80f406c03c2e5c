/* SPDX-License-Identifier: MIT */
/**
 * @file peripherals.h
 * @brief Internal interface between the files of this board.
 *
 * Context: init, unless a line says otherwise.
 */
#ifndef PERIPHERALS_H
#define PERIPHERALS_H

#include "board.h"
#include "core.h"

/* Levels of the interrupts: a lower number interrupts a higher one. SysTick has level 0. */
#define LEVEL_CONTROL 1U
#define LEVEL_LINES   2U /* serial line and CAN bus: they only fill buffers */

#define STACK_FILL 0xC0DEC0DEUL /* startup.c */

void clock_make_ready(void); /**< of pins, power and voltage; call it first */
bool clock_init(void);       /**< false: no crystal or no lock */
void clock_peripherals(void);
void clock_lost(void); /**< the crystal has failed. Context: NMI */
/** True if the crystal is there. Context: any. */
bool clock_is_good(void);

void gpio_make_safe(void); /**< bridge pins low */
void gpio_connect(void);   /**< pins to their peripherals; the bridge must be tripped */
/** True while the button is pressed. Context: any. */
bool gpio_button(void);
/** Lights the LED. Context: control ISR. */
void gpio_light(bool on);

/** Dead time of the generator; 0: it cannot be made of whole steps. */
uint32_t pwm_dead_time(uint16_t dead_time_cnt);
void     pwm_init(const board_setup_t *setup);
void     pwm_start(void);

void analog_init(void); /**< amplifiers, comparators and their thresholds */

void adc_init(void);
void adc_start(void); /**< waits for the triggers of the PWM */
/** True if a conversion is complete. Context: control ISR. */
bool adc_is_done(void);
/** Takes the results of the conversion. Context: control ISR. */
void adc_read(board_sample_t *sample);

void encoder_init(const board_setup_t *setup);
/** False: nothing was latched in this period. Context: control ISR. */
bool encoder_read(board_sample_t *sample);

void control_isr_init(void (*tick)(void), uint32_t period_cycles);
/** True from the start of the control periods on. Context: any. */
bool control_has_started(void);

void trip_init(void);
void trip_check(void);           /**< enables requested gates. Context: start of the control ISR */
void trip_latch(uint16_t fault); /**< latches it, opens the bridge. Context: init, control ISR */
void trip_overdue(void);         /**< the same for an overrun. Context: SysTick */

/** From here on nothing writes the code in the CCM SRAM, until the next reset. */
void memory_protect_code(void);

void cycles_init(void);
void cycles_wait(uint32_t cycles);

void tick_watch_start(uint32_t period_cycles); /**< before the first control interrupt */
void tick_watch_serve(void); /**< a control interrupt has come. Context: start of that ISR */

void serial_init(void);
void can_init(void); /**< off the bus until board_can_set() */

void watchdog_init(void); /**< reads the reset cause */
void watchdog_start(void);

/** Interrupts and exceptions of startup.c's table. */
void startup_reset(void);
void control_isr(void);
void tick_is_missing(void);
void serial_isr(void);
void can_isr(void);
void fault_nmi(void);
void fault_unexpected(void);

#endif /* PERIPHERALS_H */
