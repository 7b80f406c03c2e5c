/* SPDX-License-Identifier: MIT */
/* Program of test_core.cpp: what a core must do right. The table of vectors is `vectors`, and the test says by `task` which
 * part runs. */
#include <stdint.h>
#include <string.h>

/* A device of the test: writing n raises the line of interrupt n, writing 100 + n lowers it. */
#define LINES    (*(volatile uint32_t *)0x40000000UL)
#define ENABLE   (*(volatile uint32_t *)0xE000E100UL)
#define PENDING  (*(volatile uint32_t *)0xE000E200UL)
#define PRIORITY ((volatile uint8_t *)0xE000E400UL)
#define CPACR    (*(volatile uint32_t *)0xE000ED88UL)

enum {
    ADDS = 0,
    NESTS,
    SLEEPS,
    MASKS,
    LEVELS,
    FAULTS,
    FAULTS_TWICE,
    NO_FPU,
    MISALIGNED_STACK,
    KEEPS
};

#define MOST 32U

extern uint32_t stack_top;

volatile uint32_t task;
volatile uint32_t trace[MOST]; /* what happened, in its order */
volatile uint32_t traced;
volatile uint32_t done;
volatile float    sum;
#define BAD_ADDRESS 0x50000000UL
volatile uint32_t handler_sp;
float             result;

void start(void);
void hard_fault(void);
void line_0(void);
void line_1(void);
void line_2(void);

__attribute__((section(".vectors"), used))
const void *const vectors[16 + 3] = {[0]  = &stack_top,
                                     [1]  = (const void *)start,
                                     [3]  = (const void *)hard_fault,
                                     [16] = (const void *)line_0,
                                     [17] = (const void *)line_1,
                                     [18] = (const void *)line_2};

static void note(uint32_t what)
{
    if (traced < MOST) {
        trace[traced] = what;
        traced        = traced + 1U;
    }
}

static uint32_t active(void)
{
    uint32_t ipsr;

    __asm volatile("mrs %0, ipsr" : "=r"(ipsr));
    return ipsr;
}

void hard_fault(void)
{
    note(3000U + active());
    if (task == FAULTS_TWICE) {
        (void)*(volatile uint32_t *)BAD_ADDRESS;
    }
    done = 1U;
    for (;;) {
    }
}

/* The lowest priority. It uses the FPU, and raises the others. */
void line_0(void)
{
    float own = (float)traced;

    note(100U + active());
    __asm volatile("mov %0, sp" : "=r"(handler_sp));
    /* It leaves other values in what it may change. */
    __asm volatile("mov r12, #0\n vmov.f32 s2, #1.0\n vcmp.f32 s2, s2" ::: "r12", "s2");
    if (task == NESTS) {
        LINES = 2U; /* more urgent: now */
        note(101U);
        LINES = 1U; /* as urgent: after this one */
        note(102U);
    }
    LINES = 100U;
    for (uint32_t n = 0U; n < 20U; n++) {
        own = own * 1.25f + 3.0f;
    }
    sum = sum + own;
}

void line_1(void)
{
    note(200U + active());
    if ((task != LEVELS) || (traced > 3U)) {
        LINES = 101U;
    }
}

void line_2(void)
{
    note(300U + active());
    LINES = 102U;
}

/* Long enough for many interrupts; all registers of the FPU are in use. */
static float work(uint32_t passes)
{
    float a = 0.5f;
    float b = 1.25f;
    float c = 2.0f;
    float d = -3.0f;

    for (uint32_t n = 0U; n < passes; n++) {
        a = a * 0.999f + b;
        b = b * 0.5f - c * 0.25f;
        c = c / 1.0001f + (float)(n & 15U);
        d = d * 0.75f + a * b;
    }
    return a + b + c + d;
}

static void masks(void)
{
    __asm volatile("cpsid i");
    LINES = 2U;
    note(1U);
    __asm volatile("cpsie i" ::: "memory");
    note(2U);
    __asm volatile("msr basepri, %0" ::"r"(0x40U) : "memory");
    LINES = 0U; /* priority 80h: masked */
    LINES = 2U; /* priority 20h: not */
    note(3U);
    __asm volatile("msr basepri, %0" ::"r"(0U) : "memory");
    note(4U);
}

static void sleeps(void)
{
    __asm volatile("wfi");
    note(1U);
    __asm volatile("cpsid i");
    __asm volatile("wfi"); /* wakes, and no handler runs */
    note(2U);
    __asm volatile("cpsie i" ::: "memory");
    note(3U);
}

/* An interrupt in between must not change a scratch register, flags of both units, or the use of the FPU. */
static void keeps(void)
{
    uint32_t r12;
    uint32_t flags;
    uint32_t fpu_flags;
    uint32_t control;

    __asm volatile("mov r12, #77\n"
                   "vmov.f32 s0, #1.0\n"
                   "vmov.f32 s1, #2.0\n"
                   "vcmp.f32 s0, s1\n"
                   "movs r3, #0\n"
                   "str %4, [%5]\n"
                   "b 1f\n 1: nop\n"
                   "mrs %1, apsr\n"
                   "vmrs %2, fpscr\n"
                   "mrs %3, control\n"
                   "mov %0, r12\n"
                   : "=&r"(r12), "=&r"(flags), "=&r"(fpu_flags), "=&r"(control)
                   : "r"(0U), "r"(&LINES)
                   : "r12", "r3", "s0", "s1", "cc", "memory");
    note(r12);
    note(flags >> 30U);     /* N, Z: zero */
    note(fpu_flags >> 28U); /* N: less */
    note(control & 4U);
}

void start(void)
{
    if (task != NO_FPU) {
        CPACR |= 0x00F00000UL;
    }
    __asm volatile("dsb\n isb");
    PRIORITY[0] = 0x80U;
    PRIORITY[1] = 0x80U;
    PRIORITY[2] = 0x20U;
    ENABLE      = 7U;
    if ((task == ADDS) || (task == NO_FPU)) {
        sum    = 0.0f;
        result = work(2000U);
        memcpy((void *)&trace[0], &result, sizeof result);
        traced = 1U;
    } else if (task == NESTS) {
        LINES = 0U;
        note(103U);
    } else if (task == SLEEPS) {
        sleeps();
    } else if (task == MASKS) {
        masks();
    } else if (task == LEVELS) {
        LINES = 1U;
        note(9U);
    } else if (task == MISALIGNED_STACK) {
        /* The simulator looks for interrupts where a block begins. */
        LINES = 0U;
        __asm volatile("b 1f\n 1:" ::: "memory");
        const uint32_t before = handler_sp & 7U;
        __asm volatile("sub sp, #4\n str %0, [%1]\n b 1f\n 1: nop\n add sp, #4" ::"r"(0U),
                       "r"(&LINES)
                       : "memory");
        note(((handler_sp & 7U) == before) ? 1U : 0U);
    } else if (task == KEEPS) {
        keeps();
    } else {
        (void)*(volatile uint32_t *)BAD_ADDRESS;
    }
    done = 1U;
    for (;;) {
        __asm volatile("wfi");
    }
}
