/* SPDX-License-Identifier: MIT */
/**
 * @file c28_cpu.h
 * @brief Stand-ins for C28x compiler and core: keywords, inline assembly, IER, IFR, delays.
 *
 * At each of them the model reads and updates the registers (host_tools/sil/f28335/hooks.cpp). The
 * model's own C++ sources use the functions, not the keywords.
 */
#ifndef C28_CPU_H
#define C28_CPU_H

#include "c28_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One instruction by its mnemonic, with the leading blank that the assembler wants. */
void f28335_asm(const char *text);
/** Waits while the rest of the device goes on. */
void f28335_delay_us(double delay_us);

extern volatile Uint16 IER;
extern volatile Uint16 IFR;

#ifdef __cplusplus
}
#else
#define asm(text) f28335_asm(text)
#define cregister
#define interrupt
#define __interrupt
#endif

#define EALLOW f28335_asm(" EALLOW")
#define EDIS   f28335_asm(" EDIS")
#define EINT   f28335_asm(" clrc INTM")
#define DINT   f28335_asm(" setc INTM")
#define ERTM   f28335_asm(" clrc DBGM")
#define DRTM   f28335_asm(" setc DBGM")
#define ESTOP0 f28335_asm(" ESTOP0")

#define DELAY_US(A) f28335_delay_us(A)

#define M_INT1  0x0001
#define M_INT2  0x0002
#define M_INT3  0x0004
#define M_INT4  0x0008
#define M_INT5  0x0010
#define M_INT6  0x0020
#define M_INT7  0x0040
#define M_INT8  0x0080
#define M_INT9  0x0100
#define M_INT10 0x0200
#define M_INT11 0x0400
#define M_INT12 0x0800
#define M_INT13 0x1000
#define M_INT14 0x2000

#endif /* C28_CPU_H */
