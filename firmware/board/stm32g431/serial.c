/* SPDX-License-Identifier: MIT */
/* USART2 at the debugger's virtual port. Its FIFO of eight octets is shorter than a pass of the
 * background, so an interrupt takes what comes. */
#include "clock_tree.h"
#include "peripherals.h"

#define RING   32U /* a power of two; 2.9 ms at the fastest rate */
#define OCTET  0xFFUL
#define TWO    2U /* STOP */
#define ERRORS (USART_ISR_PE | USART_ISR_FE | USART_ISR_NE | USART_ISR_ORE)

static const uint32_t rates[] = {9600UL, 19200UL, 38400UL, 57600UL, CLOCK_BAUD_Hz};

#define RATES ((uint32_t)(sizeof rates / sizeof rates[0]))

/* In the order of BOARD_LINE_. The parity bit is part of the word here: nine bits with parity,
 * eight without. */
typedef struct {
    uint32_t cr1;
    uint32_t cr2;
} format_t;

static const format_t formats[] = {{USART_CR1_M0 | USART_CR1_PCE, 0UL},
                                   {USART_CR1_M0 | USART_CR1_PCE | USART_CR1_PS, 0UL},
                                   {0UL, USART_CR2_STOP(TWO)}};

#define FORMATS ((uint16_t)(sizeof formats / sizeof formats[0]))

/* The interrupt advances `put`, the background `got`. */
static struct {
    volatile uint16_t octets[RING];
    volatile uint32_t put;
    volatile uint32_t got;
} ring;

/* An octet with an error is dropped, and so is one without room: its frame is lost then. */
void serial_isr(void)
{
    const uint32_t found = USART2->ISR;

    if ((found & ERRORS) != 0UL) {
        USART2->ICR = ERRORS; /* the same places */
    }
    if ((found & USART_ISR_RXNE) != 0UL) {
        const uint16_t octet = (uint16_t)(USART2->RDR & OCTET);

        if (((found & ERRORS) == 0UL) && ((ring.put - ring.got) < RING)) {
            ring.octets[ring.put % RING] = octet;
            ring.put                     = ring.put + 1UL;
        }
    }
}

static void set_up(uint32_t baud_Bd, const format_t *format)
{
    USART2->CR1 = 0UL;
    USART2->CR2 = format->cr2;
    USART2->CR3 = 0UL;
    USART2->BRR = CLOCK_BRR(baud_Bd);
    USART2->CR1 = format->cr1 | USART_CR1_FIFOEN | USART_CR1_RE | USART_CR1_TE | USART_CR1_RXNEIE |
                  USART_CR1_UE;
}

void serial_init(void)
{
    ring.put = 0UL;
    ring.got = 0UL;
    set_up(CLOCK_BAUD_Hz, &formats[BOARD_LINE_EVEN]);
    core_enable(IRQ_USART2, CORE_PRIORITY(LEVEL_LINES));
}

/* The board has no pin for the direction of a transceiver. */
bool board_line_fits(const board_line_t *wanted)
{
    bool known = false;

    for (uint32_t n = 0UL; n < RATES; n++) {
        known = known || (rates[n] == wanted->baud_Bd);
    }
    return known && (wanted->format < FORMATS) && (wanted->direction == 0U);
}

void board_line_set(const board_line_t *wanted)
{
    if (board_line_fits(wanted)) {
        set_up(wanted->baud_Bd, &formats[wanted->format]);
    }
}

bool board_serial_read(uint16_t *octet)
{
    const bool is_there = ring.put != ring.got;

    if (is_there) {
        *octet   = ring.octets[ring.got % RING];
        ring.got = ring.got + 1UL;
    }
    return is_there;
}

bool board_serial_write(uint16_t octet)
{
    const bool has_room = (USART2->ISR & USART_ISR_TXE) != 0UL;

    if (has_room) {
        USART2->TDR = (uint32_t)octet & OCTET;
    }
    return has_room;
}
