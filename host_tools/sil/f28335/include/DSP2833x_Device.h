/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_Device.h
 * @brief Core, registers and vectors of the device.
 */
#ifndef DSP2833x_DEVICE_H
#define DSP2833x_DEVICE_H

#include "c28_cpu.h"

#include "DSP2833x_Adc.h"
#include "DSP2833x_CpuTimers.h"
#include "DSP2833x_ECan.h"
#include "DSP2833x_EPwm.h"
#include "DSP2833x_EQep.h"
#include "DSP2833x_Gpio.h"
#include "DSP2833x_PieCtrl.h"
#include "DSP2833x_PieVect.h"
#include "DSP2833x_Sci.h"
#include "DSP2833x_SysCtrl.h"

#endif /* DSP2833x_DEVICE_H */
