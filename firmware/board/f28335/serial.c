/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "clock_tree.h"
#include "peripherals.h"
#include "yield.h"

#define FORMAT_8E1   0x0067U /* eight bits, even parity, one stop bit: Modbus' default */
#define ENABLE       0x0003U /* SCICTL1: receiver and transmitter, held in reset */
#define ENABLE_RUN   0x0023U
#define FIFO_TX_HOLD 0xC000U /* FIFOs on, this one in reset, no interrupt */
#define FIFO_TX_RUN  0xE000U
#define FIFO_RX_HOLD 0x4000U /* in reset, overflow cleared */
#define FIFO_RX_RUN  0x2000U
#define FIFO_DEPTH   16U
#define OCTET        0x00FFU

/* An error stops the receiver until this, which stops the transmitter too. */
static void restart_receiver(void)
{
    SciaRegs.SCICTL1.all = ENABLE;
    SciaRegs.SCIFFRX.all = FIFO_RX_HOLD;
    BOARD_YIELD();
    SciaRegs.SCIFFRX.all = FIFO_RX_RUN;
    SciaRegs.SCICTL1.all = ENABLE_RUN;
}

void serial_init(void)
{
    SciaRegs.SCICTL1.all = ENABLE;
    SciaRegs.SCICCR.all  = FORMAT_8E1;
    SciaRegs.SCICTL2.all = 0U; /* polled */
    SciaRegs.SCIHBAUD    = (uint16_t)(CLOCK_BAUD_BRR >> 8U);
    SciaRegs.SCILBAUD    = (uint16_t)(CLOCK_BAUD_BRR & OCTET);
    SciaRegs.SCIFFCT.all = 0U;
    SciaRegs.SCIPRI.all  = 0U;
    SciaRegs.SCIFFTX.all = FIFO_TX_HOLD;
    BOARD_YIELD();
    SciaRegs.SCIFFTX.all = FIFO_TX_RUN;
    restart_receiver();
}

static bool is_sending(void)
{
    return (SciaRegs.SCIFFTX.bit.TXFFST != 0U) || (SciaRegs.SCICTL2.bit.TXEMPTY == 0U);
}

bool board_serial_read(uint16_t *octet)
{
    if ((SciaRegs.SCIRXST.bit.RXERROR != 0U) || (SciaRegs.SCIFFRX.bit.RXFFOVF != 0U)) {
        if (!is_sending()) { /* an answer on its way is not cut */
            restart_receiver();
        }
        return false; /* the rest of a broken frame is worth nothing */
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
    SciaRegs.SCITXBUF = (uint16_t)(octet & OCTET);
    return true;
}
