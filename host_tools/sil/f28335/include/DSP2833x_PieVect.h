/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_PieVect.h
 * @brief The vector table: 128 entries, number = 32 + 8 (group - 1) + channel - 1. Checked by tests/f28335/test_layout.cpp.
 */
#ifndef DSP2833x_PIE_VECT_H
#define DSP2833x_PIE_VECT_H

#include "c28_types.h"

typedef void (*PINT)(void);

struct PIE_VECT_TABLE {
    PINT rsvd1[13];
    PINT XINT13;
    PINT TINT2;
    PINT DATALOG;
    PINT RTOSINT;
    PINT EMUINT;
    PINT XNMI;
    PINT ILLEGAL;
    PINT USER1;
    PINT USER2;
    PINT USER3;
    PINT USER4;
    PINT USER5;
    PINT USER6;
    PINT USER7;
    PINT USER8;
    PINT USER9;
    PINT USER10;
    PINT USER11;
    PINT USER12;
    PINT SEQ1INT;
    PINT SEQ2INT;
    PINT rsvd2[1];
    PINT XINT1;
    PINT XINT2;
    PINT ADCINT;
    PINT TINT0;
    PINT WAKEINT;
    PINT EPWM1_TZINT;
    PINT EPWM2_TZINT;
    PINT EPWM3_TZINT;
    PINT EPWM4_TZINT;
    PINT EPWM5_TZINT;
    PINT EPWM6_TZINT;
    PINT rsvd3[2];
    PINT EPWM1_INT;
    PINT EPWM2_INT;
    PINT EPWM3_INT;
    PINT EPWM4_INT;
    PINT EPWM5_INT;
    PINT EPWM6_INT;
    PINT rsvd4[2];
    PINT ECAP1_INT;
    PINT ECAP2_INT;
    PINT ECAP3_INT;
    PINT ECAP4_INT;
    PINT ECAP5_INT;
    PINT ECAP6_INT;
    PINT rsvd5[2];
    PINT EQEP1_INT;
    PINT EQEP2_INT;
    PINT rsvd6[30];
    PINT SCIRXINTA;
    PINT SCITXINTA;
    PINT SCIRXINTB;
    PINT SCITXINTB;
    PINT ECAN0INTA;
    PINT ECAN1INTA;
    PINT ECAN0INTB;
    PINT ECAN1INTB;
    PINT rsvd7[16];
    PINT XINT3;
    PINT XINT4;
    PINT XINT5;
    PINT XINT6;
    PINT XINT7;
    PINT rsvd8[1];
    PINT LVF;
    PINT LUF;
};

#ifdef __cplusplus
extern "C" {
#endif
extern struct PIE_VECT_TABLE PieVectTable;
#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_PIE_VECT_H */
