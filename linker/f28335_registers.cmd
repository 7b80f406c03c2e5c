/* SPDX-License-Identifier: MIT */
/* Where the peripherals are: the device headers declare these objects, and nothing else defines them. */
FlashRegs     = 0x000A80;
AdcMirror     = 0x000B00;
CpuTimer0Regs = 0x000C00;
CpuTimer1Regs = 0x000C08;
PieCtrlRegs   = 0x000CE0;
PieVectTable  = 0x000D00;
ECanaRegs     = 0x006000;
ECanaMOTSRegs = 0x006080;
ECanaMboxes   = 0x006100;
EPwm1Regs     = 0x006800;
EPwm2Regs     = 0x006840;
EPwm3Regs     = 0x006880;
EPwm5Regs     = 0x006900;
EPwm6Regs     = 0x006940;
EQep1Regs     = 0x006B00;
GpioCtrlRegs  = 0x006F80;
GpioDataRegs  = 0x006FC0;
SysCtrlRegs   = 0x007010;
SciaRegs      = 0x007050;
AdcRegs       = 0x007100;

/* Sectors H and G of the flash: flash_store.c. */
board_store_memory = 0x300000;

/* A routine that the factory put there: trims the converter. */
ADC_cal = 0x380080;
