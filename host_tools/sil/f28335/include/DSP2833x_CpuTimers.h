/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_CpuTimers.h
 * @brief Registers of the CPU timers. Checked by tests/f28335/test_layout.cpp.
 */
#ifndef DSP2833x_CPU_TIMERS_H
#define DSP2833x_CPU_TIMERS_H

#include "c28_types.h"

struct TIM_REG {
    Uint16 LSW;
    Uint16 MSW;
};
union TIM_GROUP {
    Uint32         all;
    struct TIM_REG half;
};
struct PRD_REG {
    Uint16 LSW;
    Uint16 MSW;
};
union PRD_GROUP {
    Uint32         all;
    struct PRD_REG half;
};

struct TCR_BITS {
    Uint16 : 4;
    Uint16 TSS : 1;
    Uint16 TRB : 1;
    Uint16 : 4;
    Uint16 SOFT : 1;
    Uint16 FREE : 1;
    Uint16 : 2;
    Uint16 TIE : 1;
    Uint16 TIF : 1;
};
union TCR_REG {
    Uint16          all;
    struct TCR_BITS bit;
};

struct TPR_BITS {
    Uint16 TDDR : 8;
    Uint16 PSC : 8;
};
union TPR_REG {
    Uint16          all;
    struct TPR_BITS bit;
};

struct TPRH_BITS {
    Uint16 TDDRH : 8;
    Uint16 PSCH : 8;
};
union TPRH_REG {
    Uint16           all;
    struct TPRH_BITS bit;
};

struct CPUTIMER_REGS {
    union TIM_GROUP TIM;
    union PRD_GROUP PRD;
    union TCR_REG   TCR;
    Uint16          rsvd1;
    union TPR_REG   TPR;
    union TPRH_REG  TPRH;
};

#ifdef __cplusplus
extern "C" {
#endif
extern volatile struct CPUTIMER_REGS CpuTimer0Regs;
extern volatile struct CPUTIMER_REGS CpuTimer1Regs;
extern volatile struct CPUTIMER_REGS CpuTimer2Regs;
#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_CPU_TIMERS_H */
