/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_ECan.h
 * @brief Registers, mailboxes and masks of the CAN controllers. Checked by tests/f28335/test_layout.cpp.
 *
 * Registers in which a written one sets or clears have 64 bits here. The model presents a marker in the upper
 * word, so that it sees every write of 32 bits, and a read-modify-write. A driver reads them through a cast to 32 bits.
 */
#ifndef DSP2833x_ECAN_H
#define DSP2833x_ECAN_H

#include "c28_types.h"

union CANME_REG {
    Uint32 all;
};
union CANMD_REG {
    Uint32 all;
};
union CANTRS_REG {
    Uint64 all;
};
union CANTRR_REG {
    Uint64 all;
};
union CANTA_REG {
    Uint64 all;
};
union CANAA_REG {
    Uint64 all;
};
union CANRMP_REG {
    Uint64 all;
};
union CANRML_REG {
    Uint64 all;
};
union CANRFP_REG {
    Uint64 all;
};

union CANGAM_REG {
    Uint32 all;
};

struct CANMC_BITS {
    Uint16 MBNR : 5;
    Uint16 SRES : 1;
    Uint16 STM : 1;
    Uint16 ABO : 1;
    Uint16 CDR : 1;
    Uint16 WUBA : 1;
    Uint16 DBO : 1;
    Uint16 PDR : 1;
    Uint16 CCR : 1;
    Uint16 SCB : 1;
    Uint16 TCC : 1;
    Uint16 MBCC : 1;
    Uint16 SUSP : 1;
    Uint16 : 15;
};
union CANMC_REG {
    Uint32            all;
    struct CANMC_BITS bit;
};

struct CANBTC_BITS {
    Uint16 TSEG2REG : 3;
    Uint16 TSEG1REG : 4;
    Uint16 SAM : 1;
    Uint16 SJWREG : 2;
    Uint16 : 6;
    Uint16 BRPREG : 8;
    Uint16 : 8;
};
union CANBTC_REG {
    Uint32             all;
    struct CANBTC_BITS bit;
};

struct CANES_BITS {
    Uint16 TM : 1;
    Uint16 RM : 1;
    Uint16 : 1;
    Uint16 PDA : 1;
    Uint16 CCE : 1;
    Uint16 SMA : 1;
    Uint16 : 10;
    Uint16 EW : 1;
    Uint16 EP : 1;
    Uint16 BO : 1;
    Uint16 ACKE : 1;
    Uint16 SE : 1;
    Uint16 CRCE : 1;
    Uint16 SA1 : 1;
    Uint16 BE : 1;
    Uint16 FE : 1;
    Uint16 : 7;
};
union CANES_REG {
    Uint32            all;
    struct CANES_BITS bit;
};

struct CANTEC_BITS {
    Uint16 TEC : 8;
    Uint16 : 8;
    Uint16 : 16;
};
union CANTEC_REG {
    Uint32             all;
    struct CANTEC_BITS bit;
};

struct CANREC_BITS {
    Uint16 REC : 8;
    Uint16 : 8;
    Uint16 : 16;
};
union CANREC_REG {
    Uint32             all;
    struct CANREC_BITS bit;
};

union CANGIF0_REG {
    Uint32 all;
};

struct CANGIM_BITS {
    Uint16 I0EN : 1;
    Uint16 I1EN : 1;
    Uint16 GIL : 1;
    Uint16 : 13;
    Uint16 : 16;
};
union CANGIM_REG {
    Uint32             all;
    struct CANGIM_BITS bit;
};

union CANGIF1_REG {
    Uint32 all;
};
union CANMIM_REG {
    Uint32 all;
};
union CANMIL_REG {
    Uint32 all;
};
union CANOPC_REG {
    Uint32 all;
};

struct CANTIOC_BITS {
    Uint16 : 3;
    Uint16 TXFUNC : 1;
    Uint16 : 12;
    Uint16 : 16;
};
union CANTIOC_REG {
    Uint32              all;
    struct CANTIOC_BITS bit;
};

struct CANRIOC_BITS {
    Uint16 : 3;
    Uint16 RXFUNC : 1;
    Uint16 : 12;
    Uint16 : 16;
};
union CANRIOC_REG {
    Uint32              all;
    struct CANRIOC_BITS bit;
};

union CANTOC_REG {
    Uint32 all;
};
union CANTOS_REG {
    Uint32 all;
};

struct ECAN_REGS {
    union CANME_REG   CANME_word[1];
    union CANMD_REG   CANMD;
    union CANTRS_REG  CANTRS_word[1];
    union CANTRR_REG  CANTRR_word[1];
    union CANTA_REG   CANTA_word[1];
    union CANAA_REG   CANAA_word[1];
    union CANRMP_REG  CANRMP_word[1];
    union CANRML_REG  CANRML_word[1];
    union CANRFP_REG  CANRFP_word[1];
    union CANGAM_REG  CANGAM;
    union CANMC_REG   CANMC;
    union CANBTC_REG  CANBTC;
    union CANES_REG   CANES;
    union CANTEC_REG  CANTEC;
    union CANREC_REG  CANREC;
    union CANGIF0_REG CANGIF0;
    union CANGIM_REG  CANGIM;
    union CANGIF1_REG CANGIF1;
    union CANMIM_REG  CANMIM;
    union CANMIL_REG  CANMIL;
    union CANOPC_REG  CANOPC;
    union CANTIOC_REG CANTIOC;
    union CANRIOC_REG CANRIOC;
    Uint32            CANTSC;
    union CANTOC_REG  CANTOC;
    union CANTOS_REG  CANTOS;
};

struct CANMSGID_BITS {
    Uint16 EXTMSGID_L : 16;
    Uint16 EXTMSGID_H : 2;
    Uint16 STDMSGID : 11;
    Uint16 AAM : 1;
    Uint16 AME : 1;
    Uint16 IDE : 1;
};
union CANMSGID_REG {
    Uint32               all;
    struct CANMSGID_BITS bit;
};

struct CANMSGCTRL_BITS {
    Uint16 DLC : 4;
    Uint16 RTR : 1;
    Uint16 : 3;
    Uint16 TPL : 5;
    Uint16 : 3;
    Uint16 : 16;
};
union CANMSGCTRL_REG {
    Uint32                 all;
    struct CANMSGCTRL_BITS bit;
};

struct CANMDL_WORDS {
    Uint16 LOW_WORD : 16;
    Uint16 HI_WORD : 16;
};
struct CANMDL_BYTES {
    Uint16 BYTE3 : 8;
    Uint16 BYTE2 : 8;
    Uint16 BYTE1 : 8;
    Uint16 BYTE0 : 8;
};
union CANMDL_REG {
    Uint32              all;
    struct CANMDL_WORDS word;
    struct CANMDL_BYTES byte;
};

struct CANMDH_WORDS {
    Uint16 LOW_WORD : 16;
    Uint16 HI_WORD : 16;
};
struct CANMDH_BYTES {
    Uint16 BYTE7 : 8;
    Uint16 BYTE6 : 8;
    Uint16 BYTE5 : 8;
    Uint16 BYTE4 : 8;
};
union CANMDH_REG {
    Uint32              all;
    struct CANMDH_WORDS word;
    struct CANMDH_BYTES byte;
};

struct MBOX {
    union CANMSGID_REG   MSGID;
    union CANMSGCTRL_REG MSGCTRL;
    union CANMDL_REG     MDL;
    union CANMDH_REG     MDH;
};

struct ECAN_MBOXES {
    struct MBOX MBOX0, MBOX1, MBOX2, MBOX3, MBOX4, MBOX5, MBOX6, MBOX7;
    struct MBOX MBOX8, MBOX9, MBOX10, MBOX11, MBOX12, MBOX13, MBOX14, MBOX15;
    struct MBOX MBOX16, MBOX17, MBOX18, MBOX19, MBOX20, MBOX21, MBOX22, MBOX23;
    struct MBOX MBOX24, MBOX25, MBOX26, MBOX27, MBOX28, MBOX29, MBOX30, MBOX31;
};

struct CANLAM_BITS {
    Uint16 LAM_L : 16;
    Uint16 LAM_H : 13;
    Uint16 : 2;
    Uint16 LAMI : 1;
};
union CANLAM_REG {
    Uint32             all;
    struct CANLAM_BITS bit;
};

struct LAM_REGS {
    union CANLAM_REG LAM0, LAM1, LAM2, LAM3, LAM4, LAM5, LAM6, LAM7;
    union CANLAM_REG LAM8, LAM9, LAM10, LAM11, LAM12, LAM13, LAM14, LAM15;
    union CANLAM_REG LAM16, LAM17, LAM18, LAM19, LAM20, LAM21, LAM22, LAM23;
    union CANLAM_REG LAM24, LAM25, LAM26, LAM27, LAM28, LAM29, LAM30, LAM31;
};

struct MOTS_REGS {
    Uint32 MOTS0, MOTS1, MOTS2, MOTS3, MOTS4, MOTS5, MOTS6, MOTS7;
    Uint32 MOTS8, MOTS9, MOTS10, MOTS11, MOTS12, MOTS13, MOTS14, MOTS15;
    Uint32 MOTS16, MOTS17, MOTS18, MOTS19, MOTS20, MOTS21, MOTS22, MOTS23;
    Uint32 MOTS24, MOTS25, MOTS26, MOTS27, MOTS28, MOTS29, MOTS30, MOTS31;
};

struct MOTO_REGS {
    Uint32 MOTO0, MOTO1, MOTO2, MOTO3, MOTO4, MOTO5, MOTO6, MOTO7;
    Uint32 MOTO8, MOTO9, MOTO10, MOTO11, MOTO12, MOTO13, MOTO14, MOTO15;
    Uint32 MOTO16, MOTO17, MOTO18, MOTO19, MOTO20, MOTO21, MOTO22, MOTO23;
    Uint32 MOTO24, MOTO25, MOTO26, MOTO27, MOTO28, MOTO29, MOTO30, MOTO31;
};

#ifdef __cplusplus
extern "C" {
#else
/* Each access counts: a write acts at once, and CANME says which mailboxes may be written. */
#define CANME  CANME_word[f28335_ecan_access()]
#define CANTRS CANTRS_word[f28335_ecan_access()]
#define CANTRR CANTRR_word[f28335_ecan_access()]
#define CANTA  CANTA_word[f28335_ecan_access()]
#define CANAA  CANAA_word[f28335_ecan_access()]
#define CANRMP CANRMP_word[f28335_ecan_access()]
#define CANRML CANRML_word[f28335_ecan_access()]
#define CANRFP CANRFP_word[f28335_ecan_access()]
#endif
/** Takes what was written before; 0. Only eCAN-A is modelled. */
Uint16 f28335_ecan_access(void);

extern volatile struct ECAN_REGS   ECanaRegs;
extern volatile struct ECAN_MBOXES ECanaMboxes;
extern volatile struct LAM_REGS    ECanaLAMRegs;
extern volatile struct MOTS_REGS   ECanaMOTSRegs;
extern volatile struct MOTO_REGS   ECanaMOTORegs;
#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_ECAN_H */
