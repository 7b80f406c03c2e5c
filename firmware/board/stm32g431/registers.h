/* SPDX-License-Identifier: MIT */
/**
 * @file registers.h
 * @brief Registers of the STM32G431 that this board uses, and none beside them.
 *
 * Names are those of ST's reference manual RM0440. docs/hardware_stm32g431.md has the chapter of
 * each. A structure ends with the last register that is used. A field with a shift is a macro of
 * its value; `X_OF` reads it.
 */
#ifndef REGISTERS_H
#define REGISTERS_H

#include <stdint.h>

typedef volatile uint32_t reg_t;

typedef struct {
    reg_t CR;
    reg_t ICSCR;
    reg_t CFGR;
    reg_t PLLCFGR;
    reg_t reserved_0x10[2];
    reg_t CIER;
    reg_t CIFR;
    reg_t CICR;
    reg_t reserved_0x24[9];
    reg_t AHB1ENR;
    reg_t AHB2ENR;
    reg_t reserved_0x50[2];
    reg_t APB1ENR1;
    reg_t reserved_0x5C[1];
    reg_t APB2ENR;
    reg_t reserved_0x64[9];
    reg_t CCIPR;
    reg_t reserved_0x8C[2];
    reg_t CSR;
} rcc_t;

#define RCC_CR_HSEON           (1UL << 16U)
#define RCC_CR_HSERDY          (1UL << 17U)
#define RCC_CR_CSSON           (1UL << 19U)
#define RCC_CR_PLLON           (1UL << 24U)
#define RCC_CR_PLLRDY          (1UL << 25U)
#define RCC_CFGR_SW(x)         ((uint32_t)(x) << 0U)
#define RCC_CFGR_SWS_OF(value) (((value) >> 2U) & 3UL)
#define RCC_CFGR_HPRE(x)       ((uint32_t)(x) << 4U)
#define RCC_PLLCFGR_PLLSRC(x)  ((uint32_t)(x) << 0U)
#define RCC_PLLCFGR_PLLM(x)    ((uint32_t)(x) << 4U)
#define RCC_PLLCFGR_PLLN(x)    ((uint32_t)(x) << 8U)
#define RCC_PLLCFGR_PLLREN     (1UL << 24U)
#define RCC_PLLCFGR_PLLR(x)    ((uint32_t)(x) << 25U)
#define RCC_CIFR_CSSF          (1UL << 8U)
#define RCC_CICR_CSSC          (1UL << 8U)
#define RCC_AHB2ENR_GPIOAEN    (1UL << 0U)
#define RCC_AHB2ENR_GPIOBEN    (1UL << 1U)
#define RCC_AHB2ENR_GPIOCEN    (1UL << 2U)
#define RCC_AHB2ENR_ADC12EN    (1UL << 13U)
#define RCC_AHB2ENR_DAC3EN     (1UL << 18U)
#define RCC_APB1ENR1_TIM2EN    (1UL << 0U)
#define RCC_APB1ENR1_TIM4EN    (1UL << 2U)
#define RCC_APB1ENR1_USART2EN  (1UL << 17U)
#define RCC_APB1ENR1_FDCANEN   (1UL << 25U)
#define RCC_APB1ENR1_PWREN     (1UL << 28U)
#define RCC_APB2ENR_SYSCFGEN   (1UL << 0U)
#define RCC_APB2ENR_TIM1EN     (1UL << 11U)
#define RCC_CCIPR_FDCANSEL(x)  ((uint32_t)(x) << 24U)
#define RCC_CSR_RMVF           (1UL << 23U)
#define RCC_CSR_SFTRSTF        (1UL << 28U)
#define RCC_CSR_IWDGRSTF       (1UL << 29U)

typedef struct {
    reg_t CR1;
    reg_t reserved_0x04[1];
    reg_t CR3;
    reg_t reserved_0x0C[2];
    reg_t SR2;
    reg_t reserved_0x18[26];
    reg_t CR5;
} pwr_t;

#define PWR_CR3_UCPD1_DBDIS (1UL << 14U)
#define PWR_SR2_VOSF        (1UL << 10U)
#define PWR_CR5_R1MODE      (1UL << 8U)

typedef struct {
    reg_t ACR;
    reg_t PDKEYR;
    reg_t KEYR;
    reg_t OPTKEYR;
    reg_t SR;
    reg_t CR;
    reg_t ECCR;
} flash_t;

#define FLASH_ACR_LATENCY(x)        ((uint32_t)(x) << 0U)
#define FLASH_ACR_LATENCY_OF(value) ((value)&15UL)
#define FLASH_ACR_PRFTEN            (1UL << 8U)
#define FLASH_ACR_ICEN              (1UL << 9U)
#define FLASH_ACR_DCEN              (1UL << 10U)
#define FLASH_ACR_DCRST             (1UL << 12U)
#define FLASH_SR_EOP                (1UL << 0U)
#define FLASH_SR_OPERR              (1UL << 1U)
#define FLASH_SR_PROGERR            (1UL << 3U)
#define FLASH_SR_WRPERR             (1UL << 4U)
#define FLASH_SR_PGAERR             (1UL << 5U)
#define FLASH_SR_SIZERR             (1UL << 6U)
#define FLASH_SR_PGSERR             (1UL << 7U)
#define FLASH_SR_MISERR             (1UL << 8U)
#define FLASH_SR_FASTERR            (1UL << 9U)
#define FLASH_SR_BSY                (1UL << 16U)
#define FLASH_CR_PG                 (1UL << 0U)
#define FLASH_CR_PER                (1UL << 1U)
#define FLASH_CR_PNB(x)             ((uint32_t)(x) << 3U)
#define FLASH_CR_STRT               (1UL << 16U)
#define FLASH_CR_LOCK               (1UL << 31U)
#define FLASH_ECCR_ECCD             (1UL << 31U)

typedef struct {
    reg_t MODER;
    reg_t OTYPER;
    reg_t OSPEEDR;
    reg_t PUPDR;
    reg_t IDR;
    reg_t ODR;
    reg_t BSRR;
    reg_t LCKR;
    reg_t AFRL;
    reg_t AFRH;
} gpio_t;

typedef struct {
    reg_t reserved_0x00[7];
    reg_t CFGR2;
    reg_t SWPR;
} syscfg_t;

#define SYSCFG_CFGR2_CLL  (1UL << 0U)
#define SYSCFG_CFGR2_SPL  (1UL << 1U)
#define SYSCFG_CFGR2_ECCL (1UL << 3U)
#define SYSCFG_SWPR_PAGES 0x3FFUL /**< 1 KB of the CCM SRAM each */

/** TIM1, TIM2 and TIM4: the same places, of which each timer has a part. */
typedef struct {
    reg_t CR1;
    reg_t CR2;
    reg_t SMCR;
    reg_t DIER;
    reg_t SR;
    reg_t EGR;
    reg_t CCMR1;
    reg_t CCMR2;
    reg_t CCER;
    reg_t CNT;
    reg_t PSC;
    reg_t ARR;
    reg_t RCR;
    reg_t CCR1;
    reg_t CCR2;
    reg_t CCR3;
    reg_t CCR4;
    reg_t BDTR;
    reg_t reserved_0x48[6];
    reg_t AF1;
} tim_t;

#define TIM_CR1_CEN       (1UL << 0U)
#define TIM_CR1_DIR       (1UL << 4U)
#define TIM_CR1_CMS(x)    ((uint32_t)(x) << 5U)
#define TIM_CR2_MMS(x)    ((uint32_t)(x) << 4U)
#define TIM_CR2_MMS_3     (1UL << 25U)
#define TIM_SMCR_SMS(x)   ((uint32_t)(x) << 0U)
#define TIM_SMCR_TS(x)    ((uint32_t)(x) << 4U)
#define TIM_SR_CC3IF      (1UL << 3U)
#define TIM_SR_CC4IF      (1UL << 4U)
#define TIM_SR_BIF        (1UL << 7U)
#define TIM_SR_SBIF       (1UL << 13U)
#define TIM_SR_DIRF       (1UL << 21U)
#define TIM_SR_TERRF      (1UL << 23U)
#define TIM_EGR_UG        (1UL << 0U)
#define TIM_CCMR1_OC1PE   (1UL << 3U)
#define TIM_CCMR1_OC1M(x) ((uint32_t)(x) << 4U)
#define TIM_CCMR1_OC2PE   (1UL << 11U)
#define TIM_CCMR1_OC2M(x) ((uint32_t)(x) << 12U)
#define TIM_CCMR2_OC3PE   (1UL << 3U)
#define TIM_CCMR2_OC3M(x) ((uint32_t)(x) << 4U)
#define TIM_CCMR1_CC1S(x) ((uint32_t)(x) << 0U)
#define TIM_CCMR1_IC1F(x) ((uint32_t)(x) << 4U)
#define TIM_CCMR1_CC2S(x) ((uint32_t)(x) << 8U)
#define TIM_CCMR1_IC2F(x) ((uint32_t)(x) << 12U)
#define TIM_CCMR2_CC3S(x) ((uint32_t)(x) << 0U)
#define TIM_CCMR2_IC3F(x) ((uint32_t)(x) << 4U)
#define TIM_CCMR2_CC4S(x) ((uint32_t)(x) << 8U)
#define TIM_CCER_CC1E     (1UL << 0U)
#define TIM_CCER_CC1NE    (1UL << 2U)
#define TIM_CCER_CC2E     (1UL << 4U)
#define TIM_CCER_CC2NE    (1UL << 6U)
#define TIM_CCER_CC3E     (1UL << 8U)
#define TIM_CCER_CC3NE    (1UL << 10U)
#define TIM_CCER_CC4E     (1UL << 12U)
#define TIM_BDTR_DTG(x)   ((uint32_t)(x) << 0U)
#define TIM_BDTR_LOCK(x)  ((uint32_t)(x) << 8U)
#define TIM_BDTR_OSSI     (1UL << 10U)
#define TIM_BDTR_OSSR     (1UL << 11U)
#define TIM_BDTR_BKE      (1UL << 12U)
#define TIM_BDTR_BKP      (1UL << 13U)
#define TIM_BDTR_MOE      (1UL << 15U)
#define TIM_BDTR_BKF(x)   ((uint32_t)(x) << 16U)
#define TIM_AF1_BKCMP1E   (1UL << 1U)
#define TIM_AF1_BKCMP2E   (1UL << 2U)
#define TIM_AF1_BKCMP4E   (1UL << 4U)

typedef struct {
    reg_t ISR;
    reg_t IER;
    reg_t CR;
    reg_t CFGR;
    reg_t CFGR2;
    reg_t SMPR1;
    reg_t SMPR2;
    reg_t reserved_0x1C[12];
    reg_t JSQR;
    reg_t reserved_0x50[12];
    reg_t JDR1;
    reg_t JDR2;
    reg_t JDR3;
} adc_t;

#define ADC_ISR_ADRDY       (1UL << 0U)
#define ADC_ISR_JEOS        (1UL << 6U)
#define ADC_IER_JEOSIE      (1UL << 6U)
#define ADC_CR_ADEN         (1UL << 0U)
#define ADC_CR_JADSTART     (1UL << 3U)
#define ADC_CR_ADVREGEN     (1UL << 28U)
#define ADC_CR_ADCAL        (1UL << 31U)
#define ADC_CFGR_JQDIS      (1UL << 31U)
#define ADC_SMPR1_SMP1(x)   ((uint32_t)(x) << 3U)
#define ADC_SMPR1_SMP3(x)   ((uint32_t)(x) << 9U)
#define ADC_SMPR1_SMP5(x)   ((uint32_t)(x) << 15U)
#define ADC_SMPR2_SMP12(x)  ((uint32_t)(x) << 6U)
#define ADC_JSQR_JL(x)      ((uint32_t)(x) << 0U)
#define ADC_JSQR_JEXTSEL(x) ((uint32_t)(x) << 2U)
#define ADC_JSQR_JEXTEN(x)  ((uint32_t)(x) << 7U)
#define ADC_JSQR_JSQ1(x)    ((uint32_t)(x) << 9U)
#define ADC_JSQR_JSQ2(x)    ((uint32_t)(x) << 15U)
#define ADC_JSQR_JSQ3(x)    ((uint32_t)(x) << 21U)

/** Common to ADC1 and ADC2. */
typedef struct {
    reg_t CSR;
    reg_t reserved_0x04[1];
    reg_t CCR;
} adc_common_t;

#define ADC_CCR_CKMODE(x) ((uint32_t)(x) << 16U)

typedef struct {
    reg_t CR;
    reg_t SWTRGR;
    reg_t DHR12R1;
    reg_t reserved_0x0C[2];
    reg_t DHR12R2;
    reg_t reserved_0x18[9];
    reg_t MCR;
} dac_t;

#define DAC_CR_EN1       (1UL << 0U)
#define DAC_CR_EN2       (1UL << 16U)
#define DAC_MCR_MODE1(x) ((uint32_t)(x) << 0U)
#define DAC_MCR_HFSEL(x) ((uint32_t)(x) << 14U)
#define DAC_MCR_MODE2(x) ((uint32_t)(x) << 16U)

typedef struct {
    reg_t C1CSR;
    reg_t C2CSR;
    reg_t C3CSR;
    reg_t C4CSR;
} comp_t;

#define COMP_CCSR_EN        (1UL << 0U)
#define COMP_CCSR_INMSEL(x) ((uint32_t)(x) << 4U)
#define COMP_CCSR_HYST(x)   ((uint32_t)(x) << 16U)
#define COMP_CCSR_VALUE     (1UL << 30U)

typedef struct {
    reg_t OPAMP1_CSR;
    reg_t OPAMP2_CSR;
    reg_t OPAMP3_CSR;
} opamp_t;

#define OPAMP_CSR_OPAMPxEN    (1UL << 0U)
#define OPAMP_CSR_VM_SEL(x)   ((uint32_t)(x) << 5U)
#define OPAMP_CSR_OPAHSM      (1UL << 7U)
#define OPAMP_CSR_PGA_GAIN(x) ((uint32_t)(x) << 14U)

typedef struct {
    reg_t CR1;
    reg_t CR2;
    reg_t CR3;
    reg_t BRR;
    reg_t reserved_0x10[3];
    reg_t ISR;
    reg_t ICR;
    reg_t RDR;
    reg_t TDR;
} usart_t;

#define USART_CR1_UE      (1UL << 0U)
#define USART_CR1_RE      (1UL << 2U)
#define USART_CR1_TE      (1UL << 3U)
#define USART_CR1_RXNEIE  (1UL << 5U)
#define USART_CR1_PS      (1UL << 9U)
#define USART_CR1_PCE     (1UL << 10U)
#define USART_CR1_M0      (1UL << 12U)
#define USART_CR1_FIFOEN  (1UL << 29U)
#define USART_CR2_STOP(x) ((uint32_t)(x) << 12U)
#define USART_ISR_PE      (1UL << 0U)
#define USART_ISR_FE      (1UL << 1U)
#define USART_ISR_NE      (1UL << 2U)
#define USART_ISR_ORE     (1UL << 3U)
#define USART_ISR_RXNE    (1UL << 5U)
#define USART_ISR_TXE     (1UL << 7U)

typedef struct {
    reg_t reserved_0x00[6];
    reg_t CCCR;
    reg_t NBTP;
    reg_t reserved_0x20[9];
    reg_t PSR;
    reg_t reserved_0x48[2];
    reg_t IR;
    reg_t IE;
    reg_t ILS;
    reg_t ILE;
    reg_t reserved_0x60[8];
    reg_t RXGFC;
    reg_t reserved_0x84[3];
    reg_t RXF0S;
    reg_t RXF0A;
    reg_t reserved_0x98[10];
    reg_t TXBC;
    reg_t TXFQS;
    reg_t TXBRP;
    reg_t TXBAR;
} fdcan_t;

#define FDCAN_CCCR_INIT             (1UL << 0U)
#define FDCAN_CCCR_CCE              (1UL << 1U)
#define FDCAN_NBTP_NTSEG2(x)        ((uint32_t)(x) << 0U)
#define FDCAN_NBTP_NTSEG1(x)        ((uint32_t)(x) << 8U)
#define FDCAN_NBTP_NBRP(x)          ((uint32_t)(x) << 16U)
#define FDCAN_NBTP_NSJW(x)          ((uint32_t)(x) << 25U)
#define FDCAN_PSR_EP                (1UL << 5U)
#define FDCAN_PSR_BO                (1UL << 7U)
#define FDCAN_IR_RF0N               (1UL << 0U)
#define FDCAN_IR_RF0L               (1UL << 2U)
#define FDCAN_IE_RF0NE              (1UL << 0U)
#define FDCAN_ILE_EINT0             (1UL << 0U)
#define FDCAN_RXGFC_RRFE            (1UL << 0U)
#define FDCAN_RXGFC_RRFS            (1UL << 1U)
#define FDCAN_RXGFC_ANFE(x)         ((uint32_t)(x) << 2U)
#define FDCAN_RXGFC_ANFS(x)         ((uint32_t)(x) << 4U)
#define FDCAN_RXGFC_LSS(x)          ((uint32_t)(x) << 16U)
#define FDCAN_RXF0S_F0FL_OF(value)  ((value)&15UL)
#define FDCAN_RXF0S_F0GI_OF(value)  (((value) >> 8U) & 3UL)
#define FDCAN_TXBC_TFQM             (1UL << 24U)
#define FDCAN_TXFQS_TFQPI_OF(value) (((value) >> 16U) & 3UL)
#define FDCAN_TXFQS_TFQF            (1UL << 21U)

/** A frame in the memory of the CAN module. */
typedef struct {
    reg_t head;
    reg_t format;
    reg_t data[16];
} fdcan_element_t;

/** Memory of FDCAN1; its layout is fixed. */
typedef struct {
    reg_t           standard_filter[28];
    reg_t           extended_filter[16];
    fdcan_element_t receive_0[3];
    fdcan_element_t receive_1[3];
    reg_t           sent_event[6];
    fdcan_element_t send[3];
} fdcan_memory_t;

typedef struct {
    reg_t KR;
    reg_t PR;
    reg_t RLR;
    reg_t SR;
} iwdg_t;

#define TIM2         ((tim_t *)0x40000000UL)
#define TIM4         ((tim_t *)0x40000800UL)
#define IWDG         ((iwdg_t *)0x40003000UL)
#define USART2       ((usart_t *)0x40004400UL)
#define FDCAN1       ((fdcan_t *)0x40006400UL)
#define PWR          ((pwr_t *)0x40007000UL)
#define FDCAN_MEMORY ((fdcan_memory_t *)0x4000A400UL)
#define SYSCFG       ((syscfg_t *)0x40010000UL)
#define COMP         ((comp_t *)0x40010200UL)
#define OPAMP        ((opamp_t *)0x40010300UL)
#define TIM1         ((tim_t *)0x40012C00UL)
#define RCC          ((rcc_t *)0x40021000UL)
#define FLASH        ((flash_t *)0x40022000UL)
#define GPIOA        ((gpio_t *)0x48000000UL)
#define GPIOB        ((gpio_t *)0x48000400UL)
#define GPIOC        ((gpio_t *)0x48000800UL)
#define ADC1         ((adc_t *)0x50000000UL)
#define ADC2         ((adc_t *)0x50000100UL)
#define ADC12_COMMON ((adc_common_t *)0x50000300UL)
#define DAC3         ((dac_t *)0x50001000UL)

/** Numbers of the interrupts that are used. */
enum { IRQ_ADC1_2 = 18, IRQ_FDCAN1_IT0 = 21, IRQ_USART2 = 38 };

#endif /* REGISTERS_H */
