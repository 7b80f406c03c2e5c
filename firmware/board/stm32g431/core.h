/* SPDX-License-Identifier: MIT */
/**
 * @file core.h
 * @brief Registers of the Cortex-M4 itself, and the instructions that C does not have.
 *
 * Names and places are those of Arm's Armv7-M architecture reference manual, part B3 and C1.
 */
#ifndef CORE_H
#define CORE_H

#include <stdint.h>

#include "registers.h"

/** SysTick. */
typedef struct {
    reg_t CSR;
    reg_t RVR;
    reg_t CVR;
} core_tick_t;

#define CORE_TICK_RUN 7UL /**< CSR: processor clock, exception, enabled */

/** Nested vectored interrupt controller. */
typedef struct {
    reg_t            ISER[8];
    reg_t            reserved_0x20[184];
    volatile uint8_t IPR[240];
} core_nvic_t;

/** System control block. */
typedef struct {
    reg_t CPUID;
    reg_t ICSR;
    reg_t VTOR;
    reg_t AIRCR;
    reg_t reserved_0x10[4];
    reg_t SHPR3;
    reg_t reserved_0x24[25];
    reg_t CPACR;
} core_scb_t;

#define CORE_AIRCR_RESET     0x05FA0004UL /**< key and SYSRESETREQ */
#define CORE_CPACR_FPU       0x00F00000UL /**< full access to coprocessors 10 and 11 */
#define CORE_SHPR3_SYSTICK_0 0x00FFFFFFUL /**< mask: priority 0, the highest */

/** Memory protection unit. */
typedef struct {
    reg_t TYPE;
    reg_t CTRL;
    reg_t RNR;
    reg_t RBAR;
    reg_t RASR;
} core_mpu_t;

#define CORE_MPU_ON        5UL          /**< CTRL: on, everything else as without it */
#define CORE_MPU_NO_ACCESS 0x10000009UL /**< RASR: 32 octets, never executed, no access, on */

/** Data watchpoint unit, of which the cycle counter is used. */
typedef struct {
    reg_t CTRL;
    reg_t CYCCNT;
} core_dwt_t;

#define CORE_DWT_COUNTS 1UL          /**< CTRL */
#define CORE_TRACE_ON   0x01000000UL /**< DEMCR: TRCENA, without which the counter stands */

#define CORE_TICK  ((core_tick_t *)0xE000E010UL)
#define CORE_NVIC  ((core_nvic_t *)0xE000E100UL)
#define CORE_SCB   ((core_scb_t *)0xE000ED00UL)
#define CORE_MPU   ((core_mpu_t *)0xE000ED90UL)
#define CORE_DEMCR (*(reg_t *)0xE000EDFCUL)
#define CORE_DWT   ((core_dwt_t *)0xE0001000UL)

/** Priorities: the device has four bits, the upper ones; 0 is the highest. */
#define CORE_PRIORITY(level) ((uint8_t)((uint32_t)(level) << 4U))

static inline void core_barrier(void)
{
    __asm__ volatile("dsb\n\tisb" ::: "memory");
}

static inline void core_mask(void)
{
    __asm__ volatile("cpsid i" ::: "memory");
}

static inline void core_unmask(void)
{
    __asm__ volatile("cpsie i" ::: "memory");
}

/** Enables an interrupt with this priority. Context: init. */
static inline void core_enable(uint32_t irq, uint8_t priority)
{
    CORE_NVIC->IPR[irq]        = priority;
    CORE_NVIC->ISER[irq / 32U] = 1UL << (irq % 32U);
}

#endif /* CORE_H */
