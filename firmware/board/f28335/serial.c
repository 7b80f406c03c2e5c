/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"
#include "yield.h"

#define ENABLE       0x0003U /* SCICTL1: receiver and transmitter, held in reset */
#define ENABLE_RUN   0x0023U
#define FIFO_TX_HOLD 0xC000U /* FIFOs on, this one in reset, no interrupt */
#define FIFO_TX_RUN  0xE000U
#define FIFO_RX_HOLD 0x4000U /* in reset, overflow cleared */
#define FIFO_RX_RUN  0x2000U
#define FIFO_DEPTH   16U
#define OCTET        0x00FFU

typedef struct {
    uint32_t baud_Bd;
    uint16_t brr;
} rate_t;

/* The fastest rate is last: its FIFO time must exceed a background pass (clock_tree.h). */
static const rate_t rates[] = {{9600UL, (uint16_t)CLOCK_BRR(9600UL)},
                               {19200UL, (uint16_t)CLOCK_BRR(19200UL)},
                               {38400UL, (uint16_t)CLOCK_BRR(38400UL)},
                               {57600UL, (uint16_t)CLOCK_BRR(57600UL)},
                               {CLOCK_BAUD_Hz, (uint16_t)CLOCK_BRR(CLOCK_BAUD_Hz)}};

/* SCICCR by BOARD_LINE_: eight bits; even and odd with one stop bit, none with two. */
static const uint16_t formats[] = {0x0067U, 0x0027U, 0x0087U};

#define RATES   ((uint16_t)(sizeof rates / sizeof rates[0]))
#define FORMATS ((uint16_t)(sizeof formats / sizeof formats[0]))

/* Restarts the receiver, which stops at an error. The restart also stops the transmitter. */
static void restart_receiver(void)
{
    SciaRegs.SCICTL1.all = ENABLE;
    SciaRegs.SCIFFRX.all = FIFO_RX_HOLD;
    BOARD_YIELD();
    SciaRegs.SCIFFRX.all = FIFO_RX_RUN;
    SciaRegs.SCICTL1.all = ENABLE_RUN;
}

static void set_up(uint16_t brr, uint16_t format)
{
    SciaRegs.SCICTL1.all = ENABLE;
    SciaRegs.SCICCR.all  = format;
    SciaRegs.SCICTL2.all = 0U; /* polled */
    SciaRegs.SCIHBAUD    = (uint16_t)(brr >> 8U);
    SciaRegs.SCILBAUD    = (uint16_t)(brr & OCTET);
    SciaRegs.SCIFFCT.all = 0U;
    SciaRegs.SCIPRI.all  = 0U;
    SciaRegs.SCIFFTX.all = FIFO_TX_HOLD;
    BOARD_YIELD();
    SciaRegs.SCIFFTX.all = FIFO_TX_RUN;
    restart_receiver();
}

void serial_init(void)
{
    line_init(false, 0UL);
    set_up((uint16_t)CLOCK_BRR(CLOCK_BAUD_Hz), formats[BOARD_LINE_EVEN]);
}

/* Index of a baud rate in the table, or RATES if it is not supported. */
static uint16_t rate_of(uint32_t baud_Bd)
{
    uint16_t n = 0U;

    while ((n < RATES) && (rates[n].baud_Bd != baud_Bd)) {
        n = (uint16_t)(n + 1U);
    }
    return n;
}

bool board_line_fits(const board_line_t *wanted)
{
    return (rate_of(wanted->baud_Bd) < RATES) && (wanted->format < FORMATS);
}

void board_line_set(const board_line_t *wanted)
{
    if (!board_line_fits(wanted)) {
        return;
    }
    set_up(rates[rate_of(wanted->baud_Bd)].brr, formats[wanted->format]);
    if (wanted->direction != 0U) {
        gpio_use_direction();
    }
    line_init(wanted->direction != 0U, CLOCK_SYSCLK_Hz / wanted->baud_Bd);
}

bool board_serial_read(uint16_t *octet)
{
    line_release(); /* here too: the loader has no control interrupt */
    if ((SciaRegs.SCIRXST.bit.RXERROR != 0U) || (SciaRegs.SCIFFRX.bit.RXFFOVF != 0U)) {
        if (!line_is_sending()) { /* do not cut a response that is being sent */
            restart_receiver();
        }
        return false; /* the frame is lost */
    }
    if (SciaRegs.SCIFFRX.bit.RXFFST == 0U) {
        return false;
    }
    *octet = (uint16_t)(SciaRegs.SCIRXBUF.all & OCTET);
    return true;
}

bool board_serial_write(uint16_t octet)
{
    if (SciaRegs.SCIFFTX.bit.TXFFST >= FIFO_DEPTH) {
        return false;
    }
    line_send((uint16_t)(octet & OCTET));
    return true;
}
