/* SPDX-License-Identifier: MIT */
#include "can_firmware.h"

#include "DSP28x_Project.h"

#define MC_SCB 0x2000U
#define MC_CCR 0x1000U

can_firmware_mistake_t can_firmware_mistake;
uint32_t               can_firmware_mc;
uint32_t               can_firmware_btc;
volatile int           can_firmware_echo;
volatile uint32_t      can_firmware_heard;
volatile int           can_firmware_joined;

static void start_clock(void)
{
    EALLOW;
    SysCtrlRegs.PLLSTS.bit.MCLKOFF = 1U;
    SysCtrlRegs.PLLCR.bit.DIV      = 10U;
    EDIS;
    while (SysCtrlRegs.PLLSTS.bit.PLLLOCKS == 0U) {
        asm(" NOP");
    }
    EALLOW;
    SysCtrlRegs.PLLSTS.bit.MCLKOFF = 0U;
    SysCtrlRegs.PLLSTS.bit.DIVSEL  = 2U;
    if (can_firmware_mistake != CAN_MISTAKE_NO_CLOCK) {
        SysCtrlRegs.PCLKCR0.bit.ECANAENCLK = 1U;
    }
    if (can_firmware_mistake != CAN_MISTAKE_NO_PINS) {
        GpioCtrlRegs.GPAMUX2.bit.GPIO30 = 1U;
    }
    GpioCtrlRegs.GPAMUX2.bit.GPIO31 = 1U;
    EDIS;
}

static void start_unit(void)
{
    if (can_firmware_mistake != CAN_MISTAKE_NO_EALLOW) {
        EALLOW;
    }
    ECanaRegs.CANTIOC.all = (can_firmware_mistake == CAN_MISTAKE_NO_FUNCTION) ? 0UL : 8UL;
    ECanaRegs.CANRIOC.all = 8UL;
    ECanaRegs.CANMC.all =
        ((can_firmware_mistake == CAN_MISTAKE_SCC) ? 0U : MC_SCB) | MC_CCR | can_firmware_mc;
    EDIS;
    while (ECanaRegs.CANES.bit.CCE == 0U) {
        asm(" NOP");
    }
    EALLOW;
    ECanaRegs.CANBTC.all = (can_firmware_mistake == CAN_MISTAKE_NO_TIMING) ? 0UL : can_firmware_btc;
    ECanaRegs.CANMC.all  = ECanaRegs.CANMC.all & ~(uint32_t)MC_CCR;
    EDIS;
}

static void start_mailbox(volatile struct MBOX *box, uint32_t id, uint32_t control)
{
    box->MSGID.all   = id;
    box->MSGCTRL.all = control;
    box->MDL.all     = 0UL;
    box->MDH.all     = 0UL;
}

static void start_mailboxes(void)
{
    start_mailbox(&ECanaMboxes.MBOX31, 0x123UL << 18, 0UL);
    start_mailbox(&ECanaMboxes.MBOX30, 0x40000000UL, 0UL);
    start_mailbox(&ECanaMboxes.MBOX29, 0x40000000UL, 0UL);
    start_mailbox(&ECanaMboxes.MBOX28, 0x81234567UL, 0UL);
    start_mailbox(&ECanaMboxes.MBOX1, 0x181UL << 18, 8UL);
    start_mailbox(&ECanaMboxes.MBOX2, 0x182UL << 18, 3UL);
    start_mailbox(&ECanaMboxes.MBOX3, 0x90000003UL, 0UL);
    start_mailbox(&ECanaMboxes.MBOX4, 0x20000000UL | (0x184UL << 18), 2UL);
    start_mailbox(&ECanaMboxes.MBOX5, 0x185UL << 18, 0x10UL);
    ECanaLAMRegs.LAM30.all = 0x1FFFFFFFUL;
    ECanaLAMRegs.LAM29.all = 0x1FFFFFFFUL;
    ECanaRegs.CANMD.all    = 0xF0000020UL;
    ECanaRegs.CANOPC.all   = 0x40000000UL;
    ECanaRegs.CANME.all    = 0xF000003EUL;
}

static void make_mistake(void)
{
    if (can_firmware_mistake == CAN_MISTAKE_NO_CCR) {
        EALLOW;
        ECanaRegs.CANBTC.bit.BRPREG = 19U;
        EDIS;
    } else if (can_firmware_mistake == CAN_MISTAKE_ID_ENABLED) {
        ECanaMboxes.MBOX1.MSGID.all = 0x281UL << 18;
    } else if (can_firmware_mistake == CAN_MISTAKE_RMW) {
        ECanaRegs.CANRMP.all |= 0x80000000UL;
    } else if (can_firmware_mistake == CAN_MISTAKE_LOST_FLAG) {
        ECanaRegs.CANRML.all = 0x80000000UL;
    } else if (can_firmware_mistake == CAN_MISTAKE_DATA_LATE) {
        ECanaRegs.CANTRS.all      = 2UL;
        ECanaMboxes.MBOX1.MDL.all = 1UL;
    } else if (can_firmware_mistake == CAN_MISTAKE_INTERRUPT) {
        EALLOW;
        ECanaRegs.CANMIM.all = 2UL;
        EDIS;
    }
}

static void echo(void)
{
    if (can_firmware_echo == 0) {
        return;
    }
    if (((uint32_t)ECanaRegs.CANTRS.all & 6UL) == 0UL) {
        ECanaRegs.CANTRS.all = 2UL;
        ECanaRegs.CANTRS.all = 4UL;
    }
    if (((uint32_t)ECanaRegs.CANRMP.all & 0x80000000UL) != 0UL) {
        can_firmware_heard   = ECanaMboxes.MBOX31.MDL.all;
        ECanaRegs.CANRMP.all = 0x80000000UL;
    }
}

int can_firmware_main(void)
{
    start_clock();
    start_unit();
    start_mailboxes();
    while (ECanaRegs.CANES.bit.CCE != 0U) {
        asm(" NOP");
    }
    can_firmware_joined = 1;
    EINT; /* from now on a pass takes 25 us */
    make_mistake();
    for (;;) {
        echo();
        asm(" NOP");
    }
}
