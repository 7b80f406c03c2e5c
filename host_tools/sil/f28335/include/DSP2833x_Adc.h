/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_Adc.h
 * @brief Registers of the analog converter and the mirror of its results. Checked by tests/f28335/test_layout.cpp.
 */
#ifndef DSP2833x_ADC_H
#define DSP2833x_ADC_H

#include "c28_types.h"

struct ADCTRL1_BITS {
    Uint16 : 4;
    Uint16 SEQ_CASC : 1;
    Uint16 SEQ_OVRD : 1;
    Uint16 CONT_RUN : 1;
    Uint16 CPS : 1;
    Uint16 ACQ_PS : 4;
    Uint16 SUSMOD : 2;
    Uint16 RESET : 1;
    Uint16 : 1;
};
union ADCTRL1_REG {
    Uint16              all;
    struct ADCTRL1_BITS bit;
};

struct ADCTRL2_BITS {
    Uint16 EPWM_SOCB_SEQ2 : 1;
    Uint16 : 1;
    Uint16 INT_MOD_SEQ2 : 1;
    Uint16 INT_ENA_SEQ2 : 1;
    Uint16 : 1;
    Uint16 SOC_SEQ2 : 1;
    Uint16 RST_SEQ2 : 1;
    Uint16 EXT_SOC_SEQ1 : 1;
    Uint16 EPWM_SOCA_SEQ1 : 1;
    Uint16 : 1;
    Uint16 INT_MOD_SEQ1 : 1;
    Uint16 INT_ENA_SEQ1 : 1;
    Uint16 : 1;
    Uint16 SOC_SEQ1 : 1;
    Uint16 RST_SEQ1 : 1;
    Uint16 EPWM_SOCB_SEQ : 1;
};
union ADCTRL2_REG {
    Uint16              all;
    struct ADCTRL2_BITS bit;
};

struct ADCMAXCONV_BITS {
    Uint16 MAX_CONV1 : 4;
    Uint16 MAX_CONV2 : 3;
    Uint16 : 9;
};
union ADCMAXCONV_REG {
    Uint16                 all;
    struct ADCMAXCONV_BITS bit;
};

struct ADCCHSELSEQ1_BITS {
    Uint16 CONV00 : 4;
    Uint16 CONV01 : 4;
    Uint16 CONV02 : 4;
    Uint16 CONV03 : 4;
};
union ADCCHSELSEQ1_REG {
    Uint16                   all;
    struct ADCCHSELSEQ1_BITS bit;
};

struct ADCCHSELSEQ2_BITS {
    Uint16 CONV04 : 4;
    Uint16 CONV05 : 4;
    Uint16 CONV06 : 4;
    Uint16 CONV07 : 4;
};
union ADCCHSELSEQ2_REG {
    Uint16                   all;
    struct ADCCHSELSEQ2_BITS bit;
};

struct ADCCHSELSEQ3_BITS {
    Uint16 CONV08 : 4;
    Uint16 CONV09 : 4;
    Uint16 CONV10 : 4;
    Uint16 CONV11 : 4;
};
union ADCCHSELSEQ3_REG {
    Uint16                   all;
    struct ADCCHSELSEQ3_BITS bit;
};

struct ADCCHSELSEQ4_BITS {
    Uint16 CONV12 : 4;
    Uint16 CONV13 : 4;
    Uint16 CONV14 : 4;
    Uint16 CONV15 : 4;
};
union ADCCHSELSEQ4_REG {
    Uint16                   all;
    struct ADCCHSELSEQ4_BITS bit;
};

struct ADCASEQSR_BITS {
    Uint16 SEQ1_STATE : 4;
    Uint16 SEQ2_STATE : 3;
    Uint16 : 1;
    Uint16 SEQ_CNTR : 4;
    Uint16 : 4;
};
union ADCASEQSR_REG {
    Uint16                all;
    struct ADCASEQSR_BITS bit;
};

struct ADCTRL3_BITS {
    Uint16 SMODE_SEL : 1;
    Uint16 ADCCLKPS : 4;
    Uint16 ADCPWDN : 1;
    Uint16 ADCBGRFDN : 2;
    Uint16 : 8;
};
union ADCTRL3_REG {
    Uint16              all;
    struct ADCTRL3_BITS bit;
};

struct ADCST_BITS {
    Uint16 INT_SEQ1 : 1;
    Uint16 INT_SEQ2 : 1;
    Uint16 SEQ1_BSY : 1;
    Uint16 SEQ2_BSY : 1;
    Uint16 INT_SEQ1_CLR : 1;
    Uint16 INT_SEQ2_CLR : 1;
    Uint16 EOS_BUF1 : 1;
    Uint16 EOS_BUF2 : 1;
    Uint16 : 8;
};
union ADCST_REG {
    Uint16            all;
    struct ADCST_BITS bit;
};

struct ADCREFSEL_BITS {
    Uint16 : 14;
    Uint16 REF_SEL : 2;
};
union ADCREFSEL_REG {
    Uint16                all;
    struct ADCREFSEL_BITS bit;
};

struct ADCOFFTRIM_BITS {
    Uint16 OFFSET_TRIM : 9;
    Uint16 : 7;
};
union ADCOFFTRIM_REG {
    Uint16                 all;
    struct ADCOFFTRIM_BITS bit;
};

struct ADC_REGS {
    union ADCTRL1_REG      ADCTRL1;
    union ADCTRL2_REG      ADCTRL2;
    union ADCMAXCONV_REG   ADCMAXCONV;
    union ADCCHSELSEQ1_REG ADCCHSELSEQ1;
    union ADCCHSELSEQ2_REG ADCCHSELSEQ2;
    union ADCCHSELSEQ3_REG ADCCHSELSEQ3;
    union ADCCHSELSEQ4_REG ADCCHSELSEQ4;
    union ADCASEQSR_REG    ADCASEQSR;
    Uint16                 ADCRESULT0;
    Uint16                 ADCRESULT1;
    Uint16                 ADCRESULT2;
    Uint16                 ADCRESULT3;
    Uint16                 ADCRESULT4;
    Uint16                 ADCRESULT5;
    Uint16                 ADCRESULT6;
    Uint16                 ADCRESULT7;
    Uint16                 ADCRESULT8;
    Uint16                 ADCRESULT9;
    Uint16                 ADCRESULT10;
    Uint16                 ADCRESULT11;
    Uint16                 ADCRESULT12;
    Uint16                 ADCRESULT13;
    Uint16                 ADCRESULT14;
    Uint16                 ADCRESULT15;
    union ADCTRL3_REG      ADCTRL3;
    union ADCST_REG        ADCST;
    Uint16                 rsvd1[2];
    union ADCREFSEL_REG    ADCREFSEL;
    union ADCOFFTRIM_REG   ADCOFFTRIM;
    Uint16                 rsvd2[2];
};

/** The same results, right-justified. */
struct ADC_RESULT_MIRROR_REGS {
    Uint16 ADCRESULT0;
    Uint16 ADCRESULT1;
    Uint16 ADCRESULT2;
    Uint16 ADCRESULT3;
    Uint16 ADCRESULT4;
    Uint16 ADCRESULT5;
    Uint16 ADCRESULT6;
    Uint16 ADCRESULT7;
    Uint16 ADCRESULT8;
    Uint16 ADCRESULT9;
    Uint16 ADCRESULT10;
    Uint16 ADCRESULT11;
    Uint16 ADCRESULT12;
    Uint16 ADCRESULT13;
    Uint16 ADCRESULT14;
    Uint16 ADCRESULT15;
};

#ifdef __cplusplus
extern "C" {
#endif
extern volatile struct ADC_REGS               AdcRegs;
extern volatile struct ADC_RESULT_MIRROR_REGS AdcMirror;
#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_ADC_H */
