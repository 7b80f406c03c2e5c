/* SPDX-License-Identifier: MIT */
/* Programs that each make one mistake with the chip. test_chip.cpp says by `task` which one, and expects that the model
 * finds it. Addresses are those of RM0440. */
#include <stdint.h>

#define WORD(address) (*(volatile uint32_t *)(address))

#define RCC_AHB2ENR  WORD(0x4002104CUL)
#define RCC_APB1ENR1 WORD(0x40021058UL)
#define RCC_APB2ENR  WORD(0x40021060UL)
#define RCC_CFGR     WORD(0x40021008UL)
#define TIM1(offset) WORD(0x40012C00UL + (offset))
#define ADC1(offset) WORD(0x50000000UL + (offset))
#define FLASH(at)    WORD(0x40022000UL + (at))
#define IWDG(at)     WORD(0x40003000UL + (at))
#define CAN(at)      WORD(0x40006400UL + (at))
#define CAN_BUFFER_1 WORD(0x4000A400UL + 0x2C0UL)
#define PLACE        0x0801F000UL /* erased */
#define GUARD        0x20004000UL

enum {
    NONE = 0,
    NO_CLOCK,
    NO_DEAD_TIME,
    NO_BREAK,
    NO_PINS,
    AFTER_LOCK,
    EARLY_READ,
    FLASH_LOCKED,
    FLASH_TWICE,
    FLASH_HALF,
    NO_PLL,
    NOWHERE,
    WATCHDOG_KEY,
    NOT_SERVED,
    CODE_WRITTEN,
    CAN_NOT_CONFIGURED,
    CAN_CHANGED,
    CAN_NOT_HELD,
    STACK_GUARD
};

extern uint32_t stack_top;

volatile uint32_t task;
volatile uint32_t done;

void start(void);
void fault(void);

__attribute__((section(".vectors"), used)) const void *const vectors[16] = {
    [0] = &stack_top, [1] = (const void *)start, [3] = (const void *)fault};

void fault(void)
{
    for (;;) {
    }
}

static void clocks(void)
{
    RCC_AHB2ENR  = 0x2007UL;
    RCC_APB1ENR1 = 0x12020005UL;
    RCC_APB2ENR  = 0x801UL;
}

/* A pin with a function of its own. */
static void connect(uint32_t port, uint32_t pin, uint32_t function)
{
    volatile uint32_t *const moder = (volatile uint32_t *)(0x48000000UL + (0x400UL * port));
    volatile uint32_t *const afr   = &moder[8U + (pin / 8U)];

    *afr   = (*afr & ~(15UL << (4U * (pin % 8U)))) | (function << (4U * (pin % 8U)));
    *moder = (*moder & ~(3UL << (2U * pin))) | (2UL << (2U * pin));
}

static void pins(void)
{
    connect(0U, 8U, 6U);
    connect(0U, 9U, 6U);
    connect(0U, 10U, 6U);
    connect(2U, 13U, 4U);
    connect(0U, 12U, 6U);
    connect(1U, 15U, 4U);
}

/* Centre-aligned, three legs; `breaks` is BDTR. */
static void pwm(uint32_t breaks)
{
    TIM1(0x00U) = 1UL << 5U;
    TIM1(0x2CU) = 4250UL;
    TIM1(0x20U) = 0x555UL;
    TIM1(0x44U) = breaks;
    TIM1(0x14U) = 1UL;
    TIM1(0x00U) = (1UL << 5U) | 1UL;
}

static void unlock(void)
{
    FLASH(0x08U) = 0x45670123UL;
    FLASH(0x08U) = 0xCDEF89ABUL;
    FLASH(0x14U) = 1UL; /* PG */
}

static void write_flash(uint32_t words)
{
    for (uint32_t n = 0U; n < words; n++) {
        WORD(PLACE + (4UL * n)) = n;
    }
}

#define DEAD_TIME 100UL
#define BREAK     (1UL << 12U)
#define LOCK      (1UL << 8U)
#define ENABLE    (1UL << 15U)

static void convert_and_read(void)
{
    ADC1(0x08U) = (1UL << 28U) | 1UL;
    ADC1(0x4CU) = (1UL << 7U) | (3UL << 9U); /* one input, by TIM1's update */
    ADC1(0x08U) = (1UL << 28U) | 1UL | (1UL << 3U);
    pwm(DEAD_TIME | BREAK);
    while ((TIM1(0x10U) & 1UL) != 0UL) {
        TIM1(0x10U) = 0UL; /* until the next update: just before the trigger */
    }
    while ((TIM1(0x10U) & 1UL) == 0UL) {
    }
    (void)ADC1(0x80U);
}

/* No access to 32 octets. */
static void guard_stack(void)
{
    WORD(0xE000ED98UL) = 0UL;
    WORD(0xE000ED9CUL) = GUARD;
    WORD(0xE000EDA0UL) = 0x10000009UL;
    WORD(0xE000ED94UL) = 5UL;
    __asm volatile("dsb\n\tisb");
    for (volatile uint32_t n = 0UL; n < 2UL; n++) {
    }
}

void start(void)
{
    if (task != NO_CLOCK) {
        clocks();
    }
    if (task != NO_PINS) {
        if (task != NO_CLOCK) {
            pins();
        }
    }
    switch (task) {
    case NONE:
        pwm(DEAD_TIME | BREAK | LOCK);
        TIM1(0x44U) = DEAD_TIME | BREAK | LOCK | ENABLE;
        unlock();
        write_flash(4U);
        break;
    case NO_CLOCK:
        TIM1(0x00U) = 1UL;
        break;
    case NO_DEAD_TIME:
        pwm(BREAK | ENABLE);
        break;
    case NO_BREAK:
        pwm(DEAD_TIME | ENABLE);
        break;
    case NO_PINS:
        pwm(DEAD_TIME | BREAK | ENABLE);
        break;
    case AFTER_LOCK:
        pwm(DEAD_TIME | BREAK | LOCK);
        TIM1(0x44U) = 1UL | BREAK | LOCK;
        break;
    case EARLY_READ:
        convert_and_read();
        break;
    case FLASH_LOCKED:
        write_flash(2U);
        break;
    case FLASH_TWICE:
        unlock();
        write_flash(2U);
        write_flash(2U);
        break;
    case FLASH_HALF:
        unlock();
        WORD(PLACE)        = 1UL;
        WORD(PLACE + 16UL) = 1UL;
        break;
    case NO_PLL:
        RCC_CFGR = 3UL;
        break;
    case NOWHERE:
        WORD(0x40018000UL) = 1UL;
        break;
    case WATCHDOG_KEY:
        IWDG(4U) = 1UL;
        break;
    case NOT_SERVED:
        IWDG(0U) = 0xCCCCUL;
        IWDG(0U) = 0x5555UL;
        IWDG(8U) = 34UL;
        break;
    case CODE_WRITTEN:
        WORD(0x10001000UL) = 1UL;
        WORD(0x40010020UL) = 1UL << 4U;
        WORD(0x10000FFCUL) = 1UL;
        WORD(0x10001400UL) = 1UL;
        WORD(0x100013FCUL) = 2UL;
        break;
    case CAN_NOT_CONFIGURED:
        CAN(0x1CU) = 0x06000A03UL; /* the bit timing, without CCE */
        break;
    case CAN_CHANGED:
        CAN(0xCCU)   = 2UL; /* the second buffer waits to be sent */
        CAN_BUFFER_1 = 0UL;
        break;
    case CAN_NOT_HELD:
        CAN(0x94U) = 0UL; /* there is no frame */
        break;
    case STACK_GUARD:
        guard_stack();
        WORD(GUARD + 32UL) = 1UL;
        WORD(GUARD - 4UL)  = 1UL;
        WORD(GUARD + 28UL) = 1UL;
        break;
    default:
        break;
    }
    done = 1U;
    for (;;) {
        __asm volatile("wfi");
    }
}
