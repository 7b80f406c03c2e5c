/* SPDX-License-Identifier: MIT */
/**
 * @file DSP2833x_Examples.h
 * @brief Names of values, and the routines that the model provides.
 */
#ifndef DSP2833x_EXAMPLES_H
#define DSP2833x_EXAMPLES_H

#include "DSP2833x_EPwm_defines.h"
#include "c28_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Factory code in the OTP: writes the converter's trim. Its clock must be on. */
void ADC_cal(void);

#ifdef __cplusplus
}
#endif

#endif /* DSP2833x_EXAMPLES_H */
