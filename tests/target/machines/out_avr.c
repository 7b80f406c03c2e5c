/* SPDX-License-Identifier: MIT */
/* By the serial line of an ATmega2560, which the simulator prints; asleep without interrupts it ends. */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

#include "out.h"

void out_init(void)
{
    UBRR0  = 0;
    UCSR0B = 1 << TXEN0;
}

void out_char(int c)
{
    while ((UCSR0A & (1 << UDRE0)) == 0) {
    }
    UDR0 = (unsigned char)c;
}

void out_end(int code)
{
    out_char('=');
    out_char('0' + code);
    out_char('\n');
    cli();
    sleep_enable();
    sleep_cpu();
    for (;;) {
    }
}
