/* SPDX-License-Identifier: MIT */
/* msp430: double-promotion */
float promotion(float x);
float promotion(float x)
{
    return (float)(0.3 * x);
}
