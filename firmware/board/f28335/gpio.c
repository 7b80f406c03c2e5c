/* SPDX-License-Identifier: MIT */
#include "DSP28x_Project.h"
#include "peripherals.h"

#define BRIDGE_PINS     0x3FUL      /* GPIO0 .. GPIO5 */
#define GATE_ENABLE_PIN 0x40UL      /* GPIO6 */
#define BRAKE_PIN       (1UL << 10) /* GPIO10 */
#define OFF_PINS        (BRIDGE_PINS | GATE_ENABLE_PIN | BRAKE_PIN)
#define DIRECTION_PIN   (1UL << 27) /* GPIO27: chosen, free; the board pulls it down, 2.2 kOhm */
#define PLAIN_PINS      (Uint32)0x303FFF /* two multiplexer bits each: GPIO0 .. GPIO6, GPIO10 */
#define QUALIFY_ASYNC   3U               /* straight through, no clock needed */
#define QUALIFY_6       2U               /* six equal samples */
/* A sample every 4 cycles: glitches below 130 ns vanish. At the trip speed, 785 rad/s of the shaft,
 * a level of a track lasts 1.6 us. */
#define ENCODER_QUALPRD 2U

void gpio_make_safe(void)
{
    EALLOW;
    GpioDataRegs.GPACLEAR.all = OFF_PINS;    /* low before they are outputs */
    GpioCtrlRegs.GPAMUX1.all &= ~PLAIN_PINS; /* no peripheral */
    GpioCtrlRegs.GPADIR.all |= OFF_PINS;     /* switches, driver and brake off */
    GpioCtrlRegs.GPAPUD.all |=
        DIRECTION_PIN; /* pulled up since the reset: the line must not be driven */
    EDIS;
}

void gpio_connect(void)
{
    EALLOW;
    GpioCtrlRegs.GPAPUD.all |= OFF_PINS; /* driven: no pull-up wanted */

    GpioCtrlRegs.GPAPUD.bit.GPIO12   = 1U; /* the board pulls down: a broken wire trips */
    GpioCtrlRegs.GPAQSEL1.bit.GPIO12 = QUALIFY_ASYNC;
    GpioCtrlRegs.GPAMUX1.bit.GPIO12  = 1U; /* TZ1 */

    GpioCtrlRegs.GPACTRL.bit.QUALPRD2 = ENCODER_QUALPRD; /* GPIO16 .. GPIO23 */
    GpioCtrlRegs.GPAPUD.bit.GPIO20    = 0U;
    GpioCtrlRegs.GPAPUD.bit.GPIO21    = 0U;
    GpioCtrlRegs.GPAPUD.bit.GPIO23    = 0U;
    GpioCtrlRegs.GPAQSEL2.bit.GPIO20  = QUALIFY_6;
    GpioCtrlRegs.GPAQSEL2.bit.GPIO21  = QUALIFY_6;
    GpioCtrlRegs.GPAQSEL2.bit.GPIO23  = QUALIFY_6;
    GpioCtrlRegs.GPAMUX2.bit.GPIO20   = 1U; /* EQEP1A */
    GpioCtrlRegs.GPAMUX2.bit.GPIO21   = 1U; /* EQEP1B */
    GpioCtrlRegs.GPAMUX2.bit.GPIO23   = 1U; /* EQEP1I */

    GpioCtrlRegs.GPAPUD.bit.GPIO28   = 0U; /* an open line idles */
    GpioCtrlRegs.GPAQSEL2.bit.GPIO28 = QUALIFY_ASYNC;
    GpioCtrlRegs.GPAMUX2.bit.GPIO28  = 1U; /* SCIRXDA */
    GpioCtrlRegs.GPAMUX2.bit.GPIO29  = 1U; /* SCITXDA */

    GpioCtrlRegs.GPAPUD.bit.GPIO30   = 0U; /* an open input reads recessive */
    GpioCtrlRegs.GPAQSEL2.bit.GPIO30 = QUALIFY_ASYNC;
    GpioCtrlRegs.GPAMUX2.bit.GPIO30  = 1U; /* CANRXA */
    GpioCtrlRegs.GPAMUX2.bit.GPIO31  = 1U; /* CANTXA */

    GpioCtrlRegs.GPAMUX1.bit.GPIO0  = 1U; /* EPWM1A .. EPWM3B, held low by the trip */
    GpioCtrlRegs.GPAMUX1.bit.GPIO1  = 1U;
    GpioCtrlRegs.GPAMUX1.bit.GPIO2  = 1U;
    GpioCtrlRegs.GPAMUX1.bit.GPIO3  = 1U;
    GpioCtrlRegs.GPAMUX1.bit.GPIO4  = 1U;
    GpioCtrlRegs.GPAMUX1.bit.GPIO5  = 1U;
    GpioCtrlRegs.GPAMUX1.bit.GPIO10 = 1U; /* EPWM6A, likewise */
    EDIS;
}

#if BOARD_CHOPPER
void gpio_use_chopper(void)
{
    EALLOW;
    GpioCtrlRegs.GPAPUD.bit.GPIO8  = 1U; /* the board pulls down */
    GpioCtrlRegs.GPAMUX1.bit.GPIO8 = 1U; /* EPWM5A */
    EDIS;
}
#endif

void gpio_use_direction(void)
{
    GpioDataRegs.GPACLEAR.all = DIRECTION_PIN; /* listening, before it is an output */
    EALLOW;
    GpioCtrlRegs.GPAMUX2.bit.GPIO27 = 0U; /* no peripheral */
    GpioCtrlRegs.GPADIR.all |= DIRECTION_PIN;
    EDIS;
}
