/* SPDX-License-Identifier: MIT */
#include "peripherals.h"

enum { MODE_INPUT = 0, MODE_OUTPUT, MODE_PERIPHERAL, MODE_ANALOG };
enum { PULL_NONE = 0, PULL_UP };

#define SPEED_HIGH 2UL

typedef struct {
    gpio_t  *port;
    uint16_t pin;
    uint16_t mode;
    uint16_t pull;
    uint16_t function; /* of MODE_PERIPHERAL */
} pin_t;

/* Low before they are outputs: all six switches are off. */
static const pin_t bridge_low[] = {
    {GPIOA, 8U, MODE_OUTPUT, PULL_NONE, 0U},  {GPIOA, 9U, MODE_OUTPUT, PULL_NONE, 0U},
    {GPIOA, 10U, MODE_OUTPUT, PULL_NONE, 0U}, {GPIOC, 13U, MODE_OUTPUT, PULL_NONE, 0U},
    {GPIOA, 12U, MODE_OUTPUT, PULL_NONE, 0U}, {GPIOB, 15U, MODE_OUTPUT, PULL_NONE, 0U},
    {GPIOC, 6U, MODE_OUTPUT, PULL_NONE, 0U}, /* LED */
};

static const pin_t connected[] = {
    {GPIOA, 8U, MODE_PERIPHERAL, PULL_NONE, 6U},  /* TIM1_CH1 */
    {GPIOA, 9U, MODE_PERIPHERAL, PULL_NONE, 6U},  /* TIM1_CH2 */
    {GPIOA, 10U, MODE_PERIPHERAL, PULL_NONE, 6U}, /* TIM1_CH3 */
    {GPIOC, 13U, MODE_PERIPHERAL, PULL_NONE, 4U}, /* TIM1_CH1N */
    {GPIOA, 12U, MODE_PERIPHERAL, PULL_NONE, 6U}, /* TIM1_CH2N */
    {GPIOB, 15U, MODE_PERIPHERAL, PULL_NONE, 4U}, /* TIM1_CH3N */
    {GPIOA, 1U, MODE_ANALOG, PULL_NONE, 0U},      /* shunts: amplifier and comparator of a */
    {GPIOA, 2U, MODE_ANALOG, PULL_NONE, 0U},      /* amplifier's output, ADC1_IN3 */
    {GPIOA, 3U, MODE_ANALOG, PULL_NONE, 0U},      /* amplifier's bias */
    {GPIOA, 7U, MODE_ANALOG, PULL_NONE, 0U},      /* of b */
    {GPIOA, 6U, MODE_ANALOG, PULL_NONE, 0U},      /* ADC2_IN3 */
    {GPIOA, 5U, MODE_ANALOG, PULL_NONE, 0U},
    {GPIOB, 0U, MODE_ANALOG, PULL_NONE, 0U}, /* of c */
    {GPIOB, 1U, MODE_ANALOG, PULL_NONE, 0U}, /* ADC1_IN12 */
    {GPIOB, 2U, MODE_ANALOG, PULL_NONE, 0U},
    {GPIOA, 0U, MODE_ANALOG, PULL_NONE, 0U},     /* dc link, ADC2_IN1 */
    {GPIOB, 14U, MODE_ANALOG, PULL_NONE, 0U},    /* heat sink, ADC1_IN5 */
    {GPIOB, 6U, MODE_PERIPHERAL, PULL_UP, 2U},   /* encoder: TIM4_CH1 */
    {GPIOB, 7U, MODE_PERIPHERAL, PULL_UP, 2U},   /* TIM4_CH2 */
    {GPIOB, 8U, MODE_PERIPHERAL, PULL_UP, 2U},   /* index: TIM4_CH3 */
    {GPIOB, 3U, MODE_PERIPHERAL, PULL_NONE, 7U}, /* USART2_TX */
    {GPIOB, 4U, MODE_PERIPHERAL, PULL_UP, 7U},   /* USART2_RX: an open line idles */
    {GPIOA, 11U, MODE_PERIPHERAL, PULL_UP, 9U},  /* FDCAN1_RX: an open input is recessive */
    {GPIOB, 9U, MODE_PERIPHERAL, PULL_NONE, 9U}, /* FDCAN1_TX */
    {GPIOC, 11U, MODE_OUTPUT, PULL_NONE, 0U},    /* low: the CAN transceiver is on */
    {GPIOC, 10U, MODE_INPUT, PULL_UP, 0U},       /* button */
    {GPIOA, 15U, MODE_INPUT, PULL_UP, 0U},       /* home switch */
};

#define LED_BIT    (1UL << 6U)
#define BUTTON_BIT (1UL << 10U)
#define HOME_BIT   (1UL << 15U)

static void set_field(reg_t *word, uint32_t at, uint32_t width, uint32_t value)
{
    const uint32_t mask = ((1UL << width) - 1UL) << at;

    *word = (*word & ~mask) | (value << at);
}

static void set_up(const pin_t *pins, uint32_t count)
{
    for (uint32_t n = 0UL; n < count; n++) {
        const pin_t   *p        = &pins[n];
        const uint32_t two_bits = 2UL * p->pin;

        if (p->mode == MODE_PERIPHERAL) {
            set_field((p->pin < 8U) ? &p->port->AFRL : &p->port->AFRH, 4UL * (p->pin % 8UL), 4UL,
                      p->function);
            set_field(&p->port->OSPEEDR, two_bits, 2UL, SPEED_HIGH);
        }
        if (p->mode == MODE_OUTPUT) {
            p->port->BSRR = 1UL << (p->pin + 16UL);
        }
        set_field(&p->port->PUPDR, two_bits, 2UL, p->pull);
        set_field(&p->port->MODER, two_bits, 2UL, p->mode);
    }
}

void gpio_make_safe(void)
{
    set_up(bridge_low, (uint32_t)(sizeof bridge_low / sizeof bridge_low[0]));
}

void gpio_connect(void)
{
    set_up(connected, (uint32_t)(sizeof connected / sizeof connected[0]));
}

bool gpio_button(void)
{
    return (GPIOC->IDR & BUTTON_BIT) == 0UL;
}

void gpio_light(bool on)
{
    GPIOC->BSRR = on ? LED_BIT : (LED_BIT << 16U);
}

/* The board has no limit switches: they are never active. */
uint16_t board_inputs(void)
{
    return ((GPIOA->IDR & HOME_BIT) != 0UL) ? (uint16_t)BOARD_INPUT_HOME : 0U;
}
