/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_EPwm.h
 * @brief Registers of the PWM units: offsets, fields. Checked by tests/f28335/test_layout.cpp.
 */
#ifndef DSP2833x_EPWM_H
#define DSP2833x_EPWM_H

#include "c28_types.h"

struct TBCTL_BITS {
    Uint16 CTRMODE : 2;
    Uint16 PHSEN : 1;
    Uint16 PRDLD : 1;
    Uint16 SYNCOSEL : 2;
    Uint16 SWFSYNC : 1;
    Uint16 HSPCLKDIV : 3;
    Uint16 CLKDIV : 3;
    Uint16 PHSDIR : 1;
    Uint16 FREE_SOFT : 2;
};
union TBCTL_REG {
    Uint16            all;
    struct TBCTL_BITS bit;
};

struct TBSTS_BITS {
    Uint16 CTRDIR : 1;
    Uint16 SYNCI : 1;
    Uint16 CTRMAX : 1;
    Uint16 : 13;
};
union TBSTS_REG {
    Uint16            all;
    struct TBSTS_BITS bit;
};

struct TBPHS_HRPWM_REG {
    Uint16 TBPHSHR;
    Uint16 TBPHS;
};
union TBPHS_HRPWM_GROUP {
    Uint32                 all;
    struct TBPHS_HRPWM_REG half;
};

struct CMPCTL_BITS {
    Uint16 LOADAMODE : 2;
    Uint16 LOADBMODE : 2;
    Uint16 SHDWAMODE : 1;
    Uint16 : 1;
    Uint16 SHDWBMODE : 1;
    Uint16 : 1;
    Uint16 SHDWAFULL : 1;
    Uint16 SHDWBFULL : 1;
    Uint16 : 6;
};
union CMPCTL_REG {
    Uint16             all;
    struct CMPCTL_BITS bit;
};

struct CMPA_HRPWM_REG {
    Uint16 CMPAHR;
    Uint16 CMPA;
};
union CMPA_HRPWM_GROUP {
    Uint32                all;
    struct CMPA_HRPWM_REG half;
};

struct AQCTL_BITS {
    Uint16 ZRO : 2;
    Uint16 PRD : 2;
    Uint16 CAU : 2;
    Uint16 CAD : 2;
    Uint16 CBU : 2;
    Uint16 CBD : 2;
    Uint16 : 4;
};
union AQCTL_REG {
    Uint16            all;
    struct AQCTL_BITS bit;
};

struct AQSFRC_BITS {
    Uint16 ACTSFA : 2;
    Uint16 OTSFA : 1;
    Uint16 ACTSFB : 2;
    Uint16 OTSFB : 1;
    Uint16 RLDCSF : 2;
    Uint16 : 8;
};
union AQSFRC_REG {
    Uint16             all;
    struct AQSFRC_BITS bit;
};

struct AQCSFRC_BITS {
    Uint16 CSFA : 2;
    Uint16 CSFB : 2;
    Uint16 : 12;
};
union AQCSFRC_REG {
    Uint16              all;
    struct AQCSFRC_BITS bit;
};

struct DBCTL_BITS {
    Uint16 OUT_MODE : 2;
    Uint16 POLSEL : 2;
    Uint16 IN_MODE : 2;
    Uint16 : 10;
};
union DBCTL_REG {
    Uint16            all;
    struct DBCTL_BITS bit;
};

struct TZSEL_BITS {
    Uint16 CBC1 : 1;
    Uint16 CBC2 : 1;
    Uint16 CBC3 : 1;
    Uint16 CBC4 : 1;
    Uint16 CBC5 : 1;
    Uint16 CBC6 : 1;
    Uint16 : 2;
    Uint16 OSHT1 : 1;
    Uint16 OSHT2 : 1;
    Uint16 OSHT3 : 1;
    Uint16 OSHT4 : 1;
    Uint16 OSHT5 : 1;
    Uint16 OSHT6 : 1;
    Uint16 : 2;
};
union TZSEL_REG {
    Uint16            all;
    struct TZSEL_BITS bit;
};

struct TZCTL_BITS {
    Uint16 TZA : 2;
    Uint16 TZB : 2;
    Uint16 : 12;
};
union TZCTL_REG {
    Uint16            all;
    struct TZCTL_BITS bit;
};

struct TZEINT_BITS {
    Uint16 : 1;
    Uint16 CBC : 1;
    Uint16 OST : 1;
    Uint16 : 13;
};
union TZEINT_REG {
    Uint16             all;
    struct TZEINT_BITS bit;
};

struct TZFLG_BITS {
    Uint16 INT : 1;
    Uint16 CBC : 1;
    Uint16 OST : 1;
    Uint16 : 13;
};
union TZFLG_REG {
    Uint16            all;
    struct TZFLG_BITS bit;
};

struct TZCLR_BITS {
    Uint16 INT : 1;
    Uint16 CBC : 1;
    Uint16 OST : 1;
    Uint16 : 13;
};
union TZCLR_REG {
    Uint16            all;
    struct TZCLR_BITS bit;
};

struct TZFRC_BITS {
    Uint16 : 1;
    Uint16 CBC : 1;
    Uint16 OST : 1;
    Uint16 : 13;
};
union TZFRC_REG {
    Uint16            all;
    struct TZFRC_BITS bit;
};

struct ETSEL_BITS {
    Uint16 INTSEL : 3;
    Uint16 INTEN : 1;
    Uint16 : 4;
    Uint16 SOCASEL : 3;
    Uint16 SOCAEN : 1;
    Uint16 SOCBSEL : 3;
    Uint16 SOCBEN : 1;
};
union ETSEL_REG {
    Uint16            all;
    struct ETSEL_BITS bit;
};

struct ETPS_BITS {
    Uint16 INTPRD : 2;
    Uint16 INTCNT : 2;
    Uint16 : 4;
    Uint16 SOCAPRD : 2;
    Uint16 SOCACNT : 2;
    Uint16 SOCBPRD : 2;
    Uint16 SOCBCNT : 2;
};
union ETPS_REG {
    Uint16           all;
    struct ETPS_BITS bit;
};

struct ETFLG_BITS {
    Uint16 INT : 1;
    Uint16 : 1;
    Uint16 SOCA : 1;
    Uint16 SOCB : 1;
    Uint16 : 12;
};
union ETFLG_REG {
    Uint16            all;
    struct ETFLG_BITS bit;
};
union ETCLR_REG {
    Uint16            all;
    struct ETFLG_BITS bit;
};
union ETFRC_REG {
    Uint16            all;
    struct ETFLG_BITS bit;
};

struct PCCTL_BITS {
    Uint16 CHPEN : 1;
    Uint16 OSHTWTH : 4;
    Uint16 CHPFREQ : 3;
    Uint16 CHPDUTY : 3;
    Uint16 : 5;
};
union PCCTL_REG {
    Uint16            all;
    struct PCCTL_BITS bit;
};

struct HRCNFG_BITS {
    Uint16 EDGMODE : 2;
    Uint16 CTLMODE : 1;
    Uint16 HRLOAD : 1;
    Uint16 : 12;
};
union HRCNFG_REG {
    Uint16             all;
    struct HRCNFG_BITS bit;
};

struct EPWM_REGS {
    union TBCTL_REG         TBCTL;
    union TBSTS_REG         TBSTS;
    union TBPHS_HRPWM_GROUP TBPHS;
    Uint16                  TBCTR;
    Uint16                  TBPRD;
    Uint16                  rsvd1;
    union CMPCTL_REG        CMPCTL;
    union CMPA_HRPWM_GROUP  CMPA;
    Uint16                  CMPB;
    union AQCTL_REG         AQCTLA;
    union AQCTL_REG         AQCTLB;
    union AQSFRC_REG        AQSFRC;
    union AQCSFRC_REG       AQCSFRC;
    union DBCTL_REG         DBCTL;
    Uint16                  DBRED;
    Uint16                  DBFED;
    union TZSEL_REG         TZSEL;
    Uint16                  rsvd2;
    union TZCTL_REG         TZCTL;
    union TZEINT_REG        TZEINT;
    union TZFLG_REG         TZFLG;
    union TZCLR_REG         TZCLR;
    union TZFRC_REG         TZFRC;
    union ETSEL_REG         ETSEL;
    union ETPS_REG          ETPS;
    union ETFLG_REG         ETFLG;
    union ETCLR_REG         ETCLR;
    union ETFRC_REG         ETFRC;
    union PCCTL_REG         PCCTL;
    Uint16                  rsvd3;
    union HRCNFG_REG        HRCNFG;
    Uint16                  rsvd4;
};

#ifdef __cplusplus
extern "C" {
#endif
extern volatile struct EPWM_REGS EPwm1Regs;
extern volatile struct EPWM_REGS EPwm2Regs;
extern volatile struct EPWM_REGS EPwm3Regs;
extern volatile struct EPWM_REGS EPwm4Regs;
extern volatile struct EPWM_REGS EPwm5Regs;
extern volatile struct EPWM_REGS EPwm6Regs;
#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_EPWM_H */
