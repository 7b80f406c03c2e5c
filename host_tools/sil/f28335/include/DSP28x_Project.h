/* SPDX-License-Identifier: MIT */
/**
 * @file DSP28x_Project.h
 * @brief Stand-in, under the SDK's name, for the header that the drivers include.
 */
#ifndef DSP28x_PROJECT_H
#define DSP28x_PROJECT_H

#include "DSP2833x_Device.h"
#include "DSP2833x_Examples.h"

#endif /* DSP28x_PROJECT_H */
