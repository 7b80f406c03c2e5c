/* SPDX-License-Identifier: MIT */
/* Vectors, reset and faults. */
#include "peripherals.h"
#include "yield.h"

/* The linker defines these. */
extern uint32_t       image_guard[];
extern uint32_t       image_stack[];
extern uint32_t       image_stack_top[];
extern uint32_t       image_ccm[];
extern uint32_t       image_ccm_end[];
extern const uint32_t image_ccm_load[];
extern uint32_t       image_data[];
extern uint32_t       image_data_end[];
extern const uint32_t image_data_load[];
extern uint32_t       image_bss[];
extern uint32_t       image_bss_end[];

int main(void);

static void guard_stack(void)
{
    CORE_MPU->RNR  = 0UL;
    CORE_MPU->RBAR = (uint32_t)image_guard;
    CORE_MPU->RASR = CORE_MPU_NO_ACCESS;
    CORE_MPU->CTRL = CORE_MPU_ON;
    core_barrier();
}

/* The words below the present stack pointer; those above are in use. */
static void fill_stack(void)
{
    uint32_t *end;

    __asm__ volatile("mov %0, sp" : "=r"(end));
    for (uint32_t *word = image_stack; word < end; word++) {
        *word = STACK_FILL;
    }
}

static void copy(const uint32_t *from, uint32_t *to, const uint32_t *end)
{
    while (to < end) {
        *to = *from;
        from++;
        to++;
    }
}

static void fill_memory(void)
{
    copy(image_ccm_load, image_ccm, image_ccm_end);
    memory_protect_code();
    copy(image_data_load, image_data, image_data_end);
    for (uint32_t *to = image_bss; to < image_bss_end; to++) {
        *to = 0UL;
    }
}

void startup_reset(void)
{
    CORE_SCB->CPACR |= CORE_CPACR_FPU;
    core_barrier();
    clock_make_ready();
    gpio_make_safe(); /* before anything that takes time */
    fill_stack();
    fill_memory();
    guard_stack();
    (void)main();
    fault_unexpected();
}

/* The bridge opens, and the watchdog resets what stays here. */
__attribute__((used)) void fault_unexpected(void)
{
    TIM1->BDTR &= ~TIM_BDTR_MOE;
    for (;;) {
        BOARD_YIELD();
    }
}

/* A fault with the stack pointer in the guard: nothing can be pushed there. */
__attribute__((naked)) static void fault(void)
{
    __asm__ volatile("movw r0, #:lower16:image_stack_top\n\t"
                     "movt r0, #:upper16:image_stack_top\n\t"
                     "msr msp, r0\n\t"
                     "b fault_unexpected");
}

/* The crystal, or a word of the flash beyond correction. A power cut during a write leaves such
 * words in the store. Before the start they are read, and their check sum refuses them. */
void fault_nmi(void)
{
    const bool in_clock = (RCC->CIFR & RCC_CIFR_CSSF) != 0UL;
    const bool in_flash = (FLASH->ECCR & FLASH_ECCR_ECCD) != 0UL;

    if (in_clock) {
        clock_lost();
    }
    if (in_flash) {
        FLASH->ECCR = FLASH_ECCR_ECCD; /* cleared by a one */
    }
    if ((!in_clock && !in_flash) || (in_flash && control_has_started())) {
        fault_unexpected();
    }
}

typedef union {
    void (*handler)(void);
    const uint32_t *address;
} vector_t;

#define FAULT                                                                                      \
    {                                                                                              \
        .handler = fault                                                                           \
    }
#define FAULT_2  FAULT, FAULT
#define FAULT_4  FAULT_2, FAULT_2
#define FAULT_16 FAULT_4, FAULT_4, FAULT_4, FAULT_4

/* Those behind the last one are never enabled. tests/stm32g431 compares the places. */
__attribute__((section(".vectors"), used)) static const vector_t vectors[] = {
    {.address = image_stack_top},
    {.handler = startup_reset},
    {.handler = fault_nmi},
    FAULT_4,
    FAULT_4,
    FAULT_4,
    {.handler = tick_is_missing}, /* SysTick */
    FAULT_16,
    FAULT_2,
    {.handler = control_isr}, /* IRQ_ADC1_2 */
    FAULT_2,
    {.handler = can_isr}, /* IRQ_FDCAN1_IT0 */
    FAULT_16,
    {.handler = serial_isr}, /* IRQ_USART2 */
};
