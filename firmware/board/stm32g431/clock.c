/* SPDX-License-Identifier: MIT */
#include "clock_tree.h"
#include "peripherals.h"
#include "yield.h"

#define SYSCLK_PLL   3U
#define PLLSRC_HSE   3U
#define PLLR_HALF    0U /* divides by two */
#define HPRE_HALF    8U
#define WAIT_STATES  4U /* 170 MHz, range 1 boost */
#define CAN_OF_PCLK1 2U
/* Chosen: the crystal starts within 2 ms (data sheet), the PLL within 40 us. A poll takes five or
 * more cycles of the 16 MHz before. */
#define POLLS        40000U
#define BOOST_CYCLES 170U /* 1 us at half speed at the least, before full speed */

static volatile bool lost;

static bool wait_for(uint32_t bits)
{
    bool ready = false;

    for (uint32_t poll = 0UL; (poll < POLLS) && !ready; poll++) {
        ready = (RCC->CR & bits) == bits;
        BOARD_YIELD();
    }
    return ready;
}

void clock_make_ready(void)
{
    RCC->APB1ENR1 |= RCC_APB1ENR1_PWREN;
    RCC->APB2ENR |= RCC_APB2ENR_SYSCFGEN;
    RCC->AHB2ENR |= RCC_AHB2ENR_GPIOAEN | RCC_AHB2ENR_GPIOBEN | RCC_AHB2ENR_GPIOCEN;
    (void)RCC->AHB2ENR;              /* two cycles pass before the first access */
    PWR->CR3 |= PWR_CR3_UCPD1_DBDIS; /* no pull-downs at PB4 and PB6 */
    /* A locked-up processor, a wrong parity of the RAM and a flash word that is beyond correction
     * open the bridge by hardware. */
    SYSCFG->CFGR2 = SYSCFG_CFGR2_CLL | SYSCFG_CFGR2_SPL | SYSCFG_CFGR2_ECCL;
}

static void set_flash(void)
{
    FLASH->ACR =
        FLASH_ACR_LATENCY(WAIT_STATES) | FLASH_ACR_PRFTEN | FLASH_ACR_ICEN | FLASH_ACR_DCEN;
    while (FLASH_ACR_LATENCY_OF(FLASH->ACR) != WAIT_STATES) {
        BOARD_YIELD();
    }
}

static void choose_pll(void)
{
    RCC->CFGR = RCC_CFGR_SW(SYSCLK_PLL) | RCC_CFGR_HPRE(HPRE_HALF);
    while (RCC_CFGR_SWS_OF(RCC->CFGR) != SYSCLK_PLL) {
        BOARD_YIELD();
    }
    for (uint32_t n = 0UL; n < BOOST_CYCLES; n++) {
        BOARD_YIELD();
    }
    RCC->CFGR = RCC_CFGR_SW(SYSCLK_PLL); /* all buses at 170 MHz */
}

bool clock_init(void)
{
    lost = false;
    RCC->CR |= RCC_CR_HSEON;
    if (!wait_for(RCC_CR_HSERDY)) {
        lost = true;
        return false; /* 16 MHz of the internal oscillator */
    }
    PWR->CR5 &= ~PWR_CR5_R1MODE; /* boost, for more than 150 MHz */
    while ((PWR->SR2 & PWR_SR2_VOSF) != 0UL) {
        BOARD_YIELD();
    }
    RCC->PLLCFGR = RCC_PLLCFGR_PLLSRC(PLLSRC_HSE) | RCC_PLLCFGR_PLLM(CLOCK_PLL_M - 1UL) |
                   RCC_PLLCFGR_PLLN(CLOCK_PLL_N) | RCC_PLLCFGR_PLLR(PLLR_HALF) | RCC_PLLCFGR_PLLREN;
    RCC->CR |= RCC_CR_PLLON;
    if (!wait_for(RCC_CR_PLLRDY)) {
        lost = true;
        return false;
    }
    set_flash();
    choose_pll();
    RCC->CR |= RCC_CR_CSSON; /* from here on a lost crystal is an NMI, and opens the bridge */
    return clock_is_good();
}

void clock_peripherals(void)
{
    RCC->AHB2ENR |= RCC_AHB2ENR_ADC12EN | RCC_AHB2ENR_DAC3EN;
    RCC->APB1ENR1 |=
        RCC_APB1ENR1_TIM2EN | RCC_APB1ENR1_TIM4EN | RCC_APB1ENR1_USART2EN | RCC_APB1ENR1_FDCANEN;
    RCC->APB2ENR |= RCC_APB2ENR_TIM1EN;
    RCC->CCIPR = RCC_CCIPR_FDCANSEL(CAN_OF_PCLK1);
    (void)RCC->APB2ENR;
}

void clock_lost(void)
{
    lost      = true;
    RCC->CICR = RCC_CICR_CSSC;
}

bool clock_is_good(void)
{
    return !lost;
}
