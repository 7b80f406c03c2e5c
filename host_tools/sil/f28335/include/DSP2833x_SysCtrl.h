/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_SysCtrl.h
 * @brief Registers of clock, watchdog and flash wait states. Checked by tests/f28335/test_layout.cpp.
 */
#ifndef DSP2833x_SYS_CTRL_H
#define DSP2833x_SYS_CTRL_H

#include "c28_types.h"

struct PLLSTS_BITS {
    Uint16 PLLLOCKS : 1;
    Uint16 : 1;
    Uint16 PLLOFF : 1;
    Uint16 MCLKSTS : 1;
    Uint16 MCLKCLR : 1;
    Uint16 OSCOFF : 1;
    Uint16 MCLKOFF : 1;
    Uint16 DIVSEL : 2;
    Uint16 : 7;
};
union PLLSTS_REG {
    Uint16             all;
    struct PLLSTS_BITS bit;
};

struct HISPCP_BITS {
    Uint16 HSPCLK : 3;
    Uint16 : 13;
};
union HISPCP_REG {
    Uint16             all;
    struct HISPCP_BITS bit;
};

struct LOSPCP_BITS {
    Uint16 LSPCLK : 3;
    Uint16 : 13;
};
union LOSPCP_REG {
    Uint16             all;
    struct LOSPCP_BITS bit;
};

struct PCLKCR0_BITS {
    Uint16 : 2;
    Uint16 TBCLKSYNC : 1;
    Uint16 ADCENCLK : 1;
    Uint16 I2CAENCLK : 1;
    Uint16 SCICENCLK : 1;
    Uint16 : 2;
    Uint16 SPIAENCLK : 1;
    Uint16 : 1;
    Uint16 SCIAENCLK : 1;
    Uint16 SCIBENCLK : 1;
    Uint16 MCBSPAENCLK : 1;
    Uint16 MCBSPBENCLK : 1;
    Uint16 ECANAENCLK : 1;
    Uint16 ECANBENCLK : 1;
};
union PCLKCR0_REG {
    Uint16              all;
    struct PCLKCR0_BITS bit;
};

struct PCLKCR1_BITS {
    Uint16 EPWM1ENCLK : 1;
    Uint16 EPWM2ENCLK : 1;
    Uint16 EPWM3ENCLK : 1;
    Uint16 EPWM4ENCLK : 1;
    Uint16 EPWM5ENCLK : 1;
    Uint16 EPWM6ENCLK : 1;
    Uint16 : 2;
    Uint16 ECAP1ENCLK : 1;
    Uint16 ECAP2ENCLK : 1;
    Uint16 ECAP3ENCLK : 1;
    Uint16 ECAP4ENCLK : 1;
    Uint16 ECAP5ENCLK : 1;
    Uint16 ECAP6ENCLK : 1;
    Uint16 EQEP1ENCLK : 1;
    Uint16 EQEP2ENCLK : 1;
};
union PCLKCR1_REG {
    Uint16              all;
    struct PCLKCR1_BITS bit;
};

struct PCLKCR3_BITS {
    Uint16 : 8;
    Uint16 CPUTIMER0ENCLK : 1;
    Uint16 CPUTIMER1ENCLK : 1;
    Uint16 CPUTIMER2ENCLK : 1;
    Uint16 DMAENCLK : 1;
    Uint16 XINTFENCLK : 1;
    Uint16 GPIOINENCLK : 1;
    Uint16 : 2;
};
union PCLKCR3_REG {
    Uint16              all;
    struct PCLKCR3_BITS bit;
};

struct PLLCR_BITS {
    Uint16 DIV : 4;
    Uint16 : 12;
};
union PLLCR_REG {
    Uint16            all;
    struct PLLCR_BITS bit;
};

struct MAPCNF_BITS {
    Uint16 MAPEPWM : 1;
    Uint16 : 15;
};
union MAPCNF_REG {
    Uint16             all;
    struct MAPCNF_BITS bit;
};

struct SYS_CTRL_REGS {
    Uint16            rsvd1;
    union PLLSTS_REG  PLLSTS;
    Uint16            rsvd2[8];
    union HISPCP_REG  HISPCP;
    union LOSPCP_REG  LOSPCP;
    union PCLKCR0_REG PCLKCR0;
    union PCLKCR1_REG PCLKCR1;
    Uint16            LPMCR0;
    Uint16            rsvd3;
    union PCLKCR3_REG PCLKCR3;
    union PLLCR_REG   PLLCR;
    Uint16            SCSR;
    Uint16            WDCNTR;
    Uint16            rsvd4;
    Uint16            WDKEY_word[1];
    Uint16            rsvd5[3];
    Uint16            WDCR;
    Uint16            rsvd6[4];
    union MAPCNF_REG  MAPCNF;
    Uint16            rsvd7;
};

struct FOPT_BITS {
    Uint16 ENPIPE : 1;
    Uint16 : 15;
};
union FOPT_REG {
    Uint16           all;
    struct FOPT_BITS bit;
};

struct FSTDBYWAIT_BITS {
    Uint16 STDBYWAIT : 9;
    Uint16 : 7;
};
union FSTDBYWAIT_REG {
    Uint16                 all;
    struct FSTDBYWAIT_BITS bit;
};

struct FACTIVEWAIT_BITS {
    Uint16 ACTIVEWAIT : 9;
    Uint16 : 7;
};
union FACTIVEWAIT_REG {
    Uint16                  all;
    struct FACTIVEWAIT_BITS bit;
};

struct FBANKWAIT_BITS {
    Uint16 RANDWAIT : 4;
    Uint16 : 4;
    Uint16 PAGEWAIT : 4;
    Uint16 : 4;
};
union FBANKWAIT_REG {
    Uint16                all;
    struct FBANKWAIT_BITS bit;
};

struct FOTPWAIT_BITS {
    Uint16 OTPWAIT : 5;
    Uint16 : 11;
};
union FOTPWAIT_REG {
    Uint16               all;
    struct FOTPWAIT_BITS bit;
};

struct FLASH_REGS {
    union FOPT_REG        FOPT;
    Uint16                rsvd1[3];
    union FSTDBYWAIT_REG  FSTDBYWAIT;
    union FACTIVEWAIT_REG FACTIVEWAIT;
    union FBANKWAIT_REG   FBANKWAIT;
    union FOTPWAIT_REG    FOTPWAIT;
};

#ifdef __cplusplus
extern "C" {
#else
/* Each access counts: the watchdog wants a sequence of two values. */
#define WDKEY WDKEY_word[f28335_wdkey_access()]
#endif
/** Takes the value written before; 0. */
Uint16 f28335_wdkey_access(void);

extern volatile struct SYS_CTRL_REGS SysCtrlRegs;
extern volatile struct FLASH_REGS    FlashRegs;
#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_SYS_CTRL_H */
