// SPDX-License-Identifier: MIT
// The functions behind the keywords of include/c28_cpu.h and behind the registers whose accesses count.
#include "sil/f28335/device.hpp"

using sdre::f28335::Device;

extern "C" {

volatile Uint16 codestart_stack[0x700];

void f28335_asm(const char *text)
{
    Device::current().instruction(text);
}

void f28335_delay_us(double delay_us)
{
    Device::current().wait_s(1e-6 * delay_us);
}

Uint16 f28335_scirxbuf_access(void)
{
    Device::current().serial_read_access();
    return 0;
}

Uint16 f28335_scitxbuf_access(void)
{
    Device::current().serial_write_access();
    return 0;
}

Uint16 f28335_ecan_access(void)
{
    Device::current().can_access();
    return 0;
}

Uint16 f28335_wdkey_access(void)
{
    Device::current().watchdog_key_access();
    return 0;
}

void ADC_cal(void)
{
    Device::current().calibrate_adc();
}
}
