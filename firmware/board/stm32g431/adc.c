/* SPDX-License-Identifier: MIT */
#include "clock_tree.h"
#include "peripherals.h"
#include "yield.h"

#define HCLK_BY_4        3U                          /* CKMODE */
#define TIM1_UPDATE      0U                          /* JEXTSEL: TIM1_TRGO */
#define RISING           1U                          /* JEXTEN */
#define SAMPLE_6_5       1U                          /* SMP: 0.15 us, of an amplifier's output */
#define SAMPLE_47_5      4U                          /* 1.1 us, of a divider */
#define REGULATOR_CYCLES (CLOCK_SYSCLK_Hz / 25000UL) /* 40 us; the data sheet asks for 20 */
#define TOP_cnt          4095UL

static void power_up(adc_t *adc)
{
    adc->CR = 0UL; /* leaves deep power down */
    adc->CR = ADC_CR_ADVREGEN;
    cycles_wait(REGULATOR_CYCLES);
    adc->CR = ADC_CR_ADVREGEN | ADC_CR_ADCAL;
    while ((adc->CR & ADC_CR_ADCAL) != 0UL) {
        BOARD_YIELD();
    }
    cycles_wait(16UL); /* four clocks of the converter */
    adc->ISR = ADC_ISR_ADRDY;
    adc->CR  = ADC_CR_ADVREGEN | ADC_CR_ADEN;
    while ((adc->ISR & ADC_ISR_ADRDY) == 0UL) {
        BOARD_YIELD();
    }
    adc->CFGR = ADC_CFGR_JQDIS; /* one sequence for good; right-aligned 12 bits */
}

/* Both converters hold a and b at the same instant. ADC1 goes on with c and the heat sink, ADC2
 * with the dc link. ADC1 is the last to end. */
void adc_init(void)
{
    const uint32_t trigger = ADC_JSQR_JEXTSEL(TIM1_UPDATE) | ADC_JSQR_JEXTEN(RISING);

    ADC12_COMMON->CCR = ADC_CCR_CKMODE(HCLK_BY_4);
    power_up(ADC1);
    power_up(ADC2);
    ADC1->SMPR1 = ADC_SMPR1_SMP3(SAMPLE_6_5) | ADC_SMPR1_SMP5(SAMPLE_47_5);
    ADC1->SMPR2 = ADC_SMPR2_SMP12(SAMPLE_6_5);
    ADC2->SMPR1 = ADC_SMPR1_SMP3(SAMPLE_6_5) | ADC_SMPR1_SMP1(SAMPLE_47_5);
    ADC1->JSQR =
        trigger | ADC_JSQR_JL(2U) | ADC_JSQR_JSQ1(3U) | ADC_JSQR_JSQ2(12U) | ADC_JSQR_JSQ3(5U);
    ADC2->JSQR = trigger | ADC_JSQR_JL(1U) | ADC_JSQR_JSQ1(3U) | ADC_JSQR_JSQ2(1U);
}

void adc_start(void)
{
    ADC1->IER = ADC_IER_JEOSIE;
    ADC2->CR  = ADC_CR_ADVREGEN | ADC_CR_JADSTART;
    ADC1->CR  = ADC_CR_ADVREGEN | ADC_CR_JADSTART;
}

bool adc_is_done(void)
{
    return (ADC1->ISR & ADC_ISR_JEOS) != 0UL;
}

/* Currents into the motor lower the voltage at a shunt, and heat raises that of the divider. The
 * application expects both the other way. */
void adc_read(board_sample_t *sample)
{
    ADC1->ISR               = ADC_ISR_JEOS;
    sample->ia_cnt          = (uint16_t)(TOP_cnt - ADC1->JDR1);
    sample->ib_cnt          = (uint16_t)(TOP_cnt - ADC2->JDR1);
    sample->ic_cnt          = (uint16_t)(TOP_cnt - ADC1->JDR2);
    sample->temperature_cnt = (uint16_t)(TOP_cnt - ADC1->JDR3);
    sample->dc_link_cnt     = (uint16_t)ADC2->JDR2;
}
