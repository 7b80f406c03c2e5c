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

/* ADCTRL2: trigger from ePWM, interrupt at the end of each sequence; and the same with a rewind. */
#define ADC_RUN        0x0900U
#define ADC_REWIND     0x4900U
#define ADC_CLEAR_DONE 0x0010U /* ADCST: INT_SEQ1_CLR */

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
void inputs_init(void);        /**< pins of limit and home switches */
void gpio_use_chopper(void);   /**< EPWM5A, which must be low */
void gpio_use_direction(void); /**< the line's direction pin becomes an output, low */

bool clock_init(void);        /**< false: no crystal or no lock */
void clock_peripherals(void); /**< dividers and module clocks; PWM time bases stand still */

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

void brake_init(void); /**< off; the trip must be armed */

void chopper_init(const board_setup_t *setup); /**< off; its counter starts with the legs */

void adc_init(const board_setup_t *setup); /**< about 5 ms */

void encoder_init(const board_setup_t *setup);
void encoder_start(uint16_t updates_per_period); /**< call it next to pwm_start() */
/** False: nothing was latched in this period. Context: control ISR. */
bool encoder_read(board_sample_t *sample);

void cycles_init(void);
void cycles_wait(uint32_t cycles);

void tick_watch_start(uint32_t period_cycles); /**< before the first control interrupt */

/** "Loader wanted" and its complement. board_restart() preserves it; undefined after power-on. */
extern volatile uint32_t watchdog_after_reset[2];

void watchdog_stop(void); /**< reads the reset cause first */
void watchdog_start(void);

void serial_init(void);

void can_init(void); /**< off the bus until board_can_set() */

void line_init(bool     uses_direction,
               uint32_t cycles_per_bit); /**< listens. Context: init or loader */
bool line_is_sending(void);              /**< an octet is on its way. Context: any */
void line_send(uint16_t octet);          /**< the FIFO must have room. Context: background */
void line_release(
    void); /**< listens again after the last octet. Context: control ISR, background */

/* Inline, because a call costs more than these accesses, and each period makes them. */

/** True if the crystal is there. Context: any. */
static inline bool clock_is_good(void)
{
    return SysCtrlRegs.PLLSTS.bit.MCLKSTS == 0U;
}

/** Processor cycles, counted down. Context: any. */
static inline uint32_t cycles_left(void)
{
    return CpuTimer0Regs.TIM.all;
}

/** A control interrupt has come: reloads the timer of tick_watch.c. Context: start of the ISR. */
static inline void tick_watch_serve(void)
{
    CpuTimer1Regs.TCR.bit.TRB = 1U;
}

/** True if a conversion is complete. Context: control ISR. */
static inline bool adc_is_done(void)
{
    return AdcRegs.ADCST.bit.INT_SEQ1 != 0U;
}

/** Makes the converter ready for the next trigger. Context: control ISR. */
static inline void adc_rewind(void)
{
    AdcRegs.ADCTRL2.all = ADC_REWIND;
    AdcRegs.ADCST.all   = ADC_CLEAR_DONE;
}

/** Takes the results of the conversion. Context: control ISR. */
static inline void adc_read(board_sample_t *sample)
{
    sample->ia_cnt          = AdcMirror.ADCRESULT2;
    sample->ib_cnt          = AdcMirror.ADCRESULT3;
    sample->dc_link_cnt     = AdcMirror.ADCRESULT4;
    sample->temperature_cnt = AdcMirror.ADCRESULT5;
#if BOARD_CURRENT_SENSORS == 3
    sample->ic_cnt = AdcMirror.ADCRESULT7; /* of a drive with two sensors: what it read last */
#endif
}

void             control_isr_init(void (*tick)(void), uint32_t period_cycles);
__interrupt void control_isr(void);

#endif /* PERIPHERALS_H */
