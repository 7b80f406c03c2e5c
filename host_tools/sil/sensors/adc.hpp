// SPDX-License-Identifier: MIT
/// One current channel: sensor, amplifier, converter.
///
///     code = round((gain i + offset + noise) / lsb), held within its bits      EQ-ADC-1
///     lsb = 2 full_scale / 2^bits,   current = lsb code
#pragma once

#include "common/random.hpp"
#include "sil/setup/board_settings.hpp"

namespace sdre {

struct AdcChannel {
    int    bits         = 12;
    double full_scale_A = 10.0;
    double noise_rms_A  = 0.0;
    double offset_A     = 0.0;
    double gain         = 1.0;
};

AdcChannel channel_a(const SensorSettings &settings);
AdcChannel channel_b(const SensorSettings &settings);
AdcChannel channel_c(const SensorSettings &settings);

/// The converter's code, two's complement.
int adc_code(const AdcChannel &channel, double current_A, Noise &noise);

/// The current that a code stands for.
double adc_current_A(const AdcChannel &channel, int code);

} // namespace sdre
