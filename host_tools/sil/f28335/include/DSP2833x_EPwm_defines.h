/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_EPwm_defines.h
 * @brief Names of the PWM units' field values.
 */
#ifndef DSP2833x_EPWM_DEFINES_H
#define DSP2833x_EPWM_DEFINES_H

#define TB_COUNT_UP     0x0
#define TB_COUNT_DOWN   0x1
#define TB_COUNT_UPDOWN 0x2
#define TB_FREEZE       0x3
#define TB_DISABLE      0x0
#define TB_ENABLE       0x1
#define TB_SHADOW       0x0
#define TB_IMMEDIATE    0x1
#define TB_SYNC_IN      0x0
#define TB_CTR_ZERO     0x1
#define TB_CTR_CMPB     0x2
#define TB_SYNC_DISABLE 0x3
#define TB_DIV1         0x0
#define TB_DIV2         0x1
#define TB_DIV4         0x2
#define TB_DOWN         0x0
#define TB_UP           0x1

#define CC_CTR_ZERO     0x0
#define CC_CTR_PRD      0x1
#define CC_CTR_ZERO_PRD 0x2
#define CC_LD_DISABLE   0x3
#define CC_SHADOW       0x0
#define CC_IMMEDIATE    0x1

#define AQ_NO_ACTION 0x0
#define AQ_CLEAR     0x1
#define AQ_SET       0x2
#define AQ_TOGGLE    0x3

#define DB_DISABLE     0x0
#define DBB_ENABLE     0x1
#define DBA_ENABLE     0x2
#define DB_FULL_ENABLE 0x3
#define DB_ACTV_HI     0x0
#define DB_ACTV_LOC    0x1
#define DB_ACTV_HIC    0x2
#define DB_ACTV_LO     0x3
#define DBA_ALL        0x0

#define CHP_DISABLE 0x0
#define CHP_ENABLE  0x1

#define TZ_DISABLE   0x0
#define TZ_ENABLE    0x1
#define TZ_HIZ       0x0
#define TZ_FORCE_HI  0x1
#define TZ_FORCE_LO  0x2
#define TZ_NO_CHANGE 0x3

#define ET_CTR_ZERO  0x1
#define ET_CTR_PRD   0x2
#define ET_CTRU_CMPA 0x4
#define ET_CTRD_CMPA 0x5
#define ET_CTRU_CMPB 0x6
#define ET_CTRD_CMPB 0x7
#define ET_DISABLE   0x0
#define ET_1ST       0x1
#define ET_2ND       0x2
#define ET_3RD       0x3

#endif /* DSP2833x_EPWM_DEFINES_H */
