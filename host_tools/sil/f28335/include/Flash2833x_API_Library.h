/* SPDX-License-Identifier: MIT */
/* TI's flash API as far as this project uses it, on the virtual device (flash_unit.cpp). DSP28x_Project.h comes first. */
#ifndef FLASH2833X_API_LIBRARY_H
#define FLASH2833X_API_LIBRARY_H

#ifdef __cplusplus
extern "C" {
#endif

#define SECTORH 0x0080U
#define SECTORG 0x0040U
#define SECTORF 0x0020U
#define SECTORE 0x0010U

#define STATUS_SUCCESS                 0U
#define STATUS_FAIL_NO_SECTOR_SPECIFIED 20U
#define STATUS_FAIL_ZERO_BIT_ERROR     31U

typedef struct {
    Uint32 FirstFailAddr;
    Uint16 ExpectedData;
    Uint16 ActualData;
} FLASH_ST;

extern Uint32 Flash_CPUScaleFactor;
extern void (*Flash_CallbackPtr)(void);

Uint16 Flash_Erase(Uint16 SectorMask, FLASH_ST *FEraseStat);
Uint16 Flash_Program(Uint16 *FlashAddr, Uint16 *BufAddr, Uint32 Length, FLASH_ST *FProgStatus);

#ifdef __cplusplus
}
#endif

#endif /* FLASH2833X_API_LIBRARY_H */
