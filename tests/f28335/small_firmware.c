/* SPDX-License-Identifier: MIT */
#include "small_firmware.h"

#include "DSP28x_Project.h"

small_firmware_mistake_t small_firmware_mistake;
uint16_t                 small_firmware_compare;
volatile uint32_t        small_firmware_ticks;
volatile uint16_t        small_firmware_codes[4];
volatile uint16_t        small_firmware_position;
volatile uint16_t        small_firmware_index;
volatile uint16_t        small_firmware_heard;

static uint16_t unless(small_firmware_mistake_t mistake, uint16_t right, uint16_t wrong)
{
    return (small_firmware_mistake == mistake) ? wrong : right;
}

static interrupt void isr(void)
{
    small_firmware_ticks    = small_firmware_ticks + 1U;
    small_firmware_codes[0] = AdcMirror.ADCRESULT0;
    small_firmware_codes[1] = AdcMirror.ADCRESULT1;
    small_firmware_codes[2] = (uint16_t)(AdcRegs.ADCRESULT2 >> 4);
    small_firmware_codes[3] = (uint16_t)(AdcRegs.ADCRESULT3 >> 4);
    small_firmware_position = (uint16_t)EQep1Regs.QPOSLAT;
    small_firmware_index    = (uint16_t)EQep1Regs.QPOSILAT;
    if (small_firmware_mistake != MISTAKE_NO_SEQ_RESET) {
        AdcRegs.ADCTRL2.bit.RST_SEQ1 = 1U;
    }
    if (small_firmware_mistake != MISTAKE_NO_INT_CLEAR) {
        AdcRegs.ADCST.bit.INT_SEQ1_CLR = 1U;
    }
    if (small_firmware_mistake == MISTAKE_ISR_NO_EALLOW) {
        GpioCtrlRegs.GPADIR.bit.GPIO7 = 1U;
    }
    EQep1Regs.QCLR.all = 0x0FFFU;
    if (small_firmware_mistake != MISTAKE_NO_PIEACK) {
        PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
    }
}

static void start_clock(void)
{
    EALLOW;
    SysCtrlRegs.PLLSTS.bit.DIVSEL  = 0U;
    SysCtrlRegs.PLLSTS.bit.MCLKOFF = 1U;
    SysCtrlRegs.PLLCR.bit.DIV      = 10U;
    EDIS;
    if (small_firmware_mistake == MISTAKE_DIVSEL_EARLY) {
        EALLOW;
        SysCtrlRegs.PLLSTS.bit.DIVSEL = 2U;
        EDIS;
    }
    while (SysCtrlRegs.PLLSTS.bit.PLLLOCKS == 0U) {
        asm(" NOP");
    }
    EALLOW;
    SysCtrlRegs.PLLSTS.bit.MCLKOFF = 0U;
    SysCtrlRegs.PLLSTS.bit.DIVSEL  = 2U;
    SysCtrlRegs.HISPCP.all         = unless(MISTAKE_ADC_TOO_FAST, 3U, 1U);
    SysCtrlRegs.PCLKCR0.all        = 0x0408U; /* ADC, SCI-A */
    SysCtrlRegs.PCLKCR1.all        = unless(MISTAKE_NO_CLOCK, 0x4007U, 0x4005U);
    EDIS;
}

static void start_pins(void)
{
    EALLOW;
    GpioCtrlRegs.GPADIR.all  = 0x7FUL;
    GpioCtrlRegs.GPAMUX1.all = 0x01000555UL; /* ePWM1..3, TZ1 */
    if (small_firmware_mistake == MISTAKE_TRIP_PIN_UNMUXED) {
        GpioCtrlRegs.GPAMUX1.bit.GPIO12 = 0U;
    }
    GpioCtrlRegs.GPAMUX2.all = 0x05004500UL; /* eQEP1 A B I, SCI-A */
    EDIS;
}

static void start_leg(volatile struct EPWM_REGS *leg)
{
    leg->TBCTL.all      = 0x0082U; /* up-down, SYSCLK / 2 */
    leg->TBPRD          = 7500U;
    leg->CMPCTL.all     = 0x0001U; /* shadow loads at PRD */
    leg->CMPA.half.CMPA = small_firmware_compare;
    leg->AQCTLA.all     = 0x0094U; /* PRD and CAU clear, CAD sets */
    leg->DBCTL.all      = unless(MISTAKE_POLARITY, 0x000BU, 0x0003U);
    leg->DBRED          = unless(MISTAKE_DEAD_BAND_WIDE, 225U, 1050U);
    leg->DBFED          = unless(MISTAKE_DEAD_BAND_WIDE, 225U, 1050U);
    if (small_firmware_mistake != MISTAKE_NO_EALLOW) {
        EALLOW;
    }
    leg->TZSEL.all = ((leg == &EPwm2Regs) ? unless(MISTAKE_TRIP_UNARMED, 0x0100U, 0U) : 0x0100U);
    leg->TZCTL.all = unless(MISTAKE_TRIP_FLOATS, 0x000AU, 0U);
    if (small_firmware_mistake == MISTAKE_EDIS_FIRST) {
        EDIS;
    }
    leg->TZCLR.all = 7U;
    leg->TZFRC.all = 0U;
    if (small_firmware_mistake == MISTAKE_EDIS_FIRST) {
        leg->TZEINT.all = 4U;
    }
    EDIS;
}

static void start_adc(void)
{
    if (small_firmware_mistake != MISTAKE_ADC_CAL_LOCKED) {
        EALLOW;
    }
    if (small_firmware_mistake != MISTAKE_NO_ADC_CAL) {
        ADC_cal();
    }
    EDIS;
    AdcRegs.ADCTRL3.all = 0xE1U; /* powered, simultaneous */
    DELAY_US(unless(MISTAKE_ADC_COLD, 5000U, 100U));
    AdcRegs.ADCTRL1.all      = unless(MISTAKE_SHORT_WINDOW, 0x0500U, 0x0300U);
    AdcRegs.ADCMAXCONV.all   = 1U;
    AdcRegs.ADCCHSELSEQ1.all = 0x0010U;
    AdcRegs.ADCTRL2.all      = 0x0900U;
}

static void start_encoder(void)
{
    EQep1Regs.QPOSMAX    = unless(MISTAKE_QPOSMAX, 9999U, 10000U);
    EQep1Regs.QUPRD      = 30000UL;
    EQep1Regs.QEPCTL.all = 0x901CU;
}

static void start_serial(void)
{
    SciaRegs.SCICCR.all  = 0x0007U;
    SciaRegs.SCICTL1.all = 0x0003U;
    SciaRegs.SCILBAUD    = 40U;
    SciaRegs.SCIFFTX.all = 0xE000U;
    SciaRegs.SCIFFRX.all = 0x2000U;
    SciaRegs.SCICTL1.all = 0x0023U;
}

static void start_interrupts(void)
{
    DINT;
    EALLOW;
    PieVectTable.SEQ1INT = &isr;
    EDIS;
    PieCtrlRegs.PIECTRL.bit.ENPIE = 1U;
    PieCtrlRegs.PIEIER1.bit.INTx1 = 1U;
    IER                           = M_INT1;
}

static void start_watchdog(void)
{
    EALLOW;
    SysCtrlRegs.WDCR = 0x2BU; /* 17.5 ms */
    EDIS;
}

static void serve_watchdog(void)
{
    if (small_firmware_mistake == MISTAKE_NO_WATCHDOG) {
        return;
    }
    EALLOW;
    if (small_firmware_mistake != MISTAKE_HALF_KEY) {
        SysCtrlRegs.WDKEY = 0x55U;
    }
    SysCtrlRegs.WDKEY = 0xAAU;
    EDIS;
}

static void echo(void)
{
    while (SciaRegs.SCIFFRX.bit.RXFFST != 0U) {
        small_firmware_heard = (uint16_t)(SciaRegs.SCIRXBUF.all & 0xFFU);
        SciaRegs.SCITXBUF    = (uint16_t)((small_firmware_heard + 1U) & 0xFFU);
    }
}

int small_firmware_main(void)
{
    small_firmware_ticks = 0U;
    start_clock();
    start_pins();
    start_leg(&EPwm1Regs);
    start_leg(&EPwm2Regs);
    start_leg(&EPwm3Regs);
    EPwm1Regs.ETPS.all  = 0x0100U;
    EPwm1Regs.ETSEL.all = 0x0A00U; /* SOCA at PRD */
    start_adc();
    start_encoder();
    start_serial();
    start_interrupts();
    start_watchdog();
    EQep1Regs.QUTMR          = 15000UL;
    EQep1Regs.QEPCTL.bit.UTE = 1U;
    EALLOW;
    SysCtrlRegs.PCLKCR0.bit.TBCLKSYNC = 1U;
    EDIS;
    GpioDataRegs.GPASET.all = 0x40UL;
    EINT;
    for (;;) {
        serve_watchdog();
        echo();
        if (small_firmware_mistake == MISTAKE_ISR_NO_EALLOW) {
            EALLOW;
        }
        asm(" NOP");
        EDIS;
    }
}
