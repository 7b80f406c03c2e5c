// SPDX-License-Identifier: MIT
#include "sil/plant/inverter.hpp"

#include <algorithm>

#include "sil/plant/bridge.hpp"

namespace sdre {
namespace {

double diode_share(double current_A)
{
    return -0.5 * std::clamp(current_A / diode_fade_A, -1.0, 1.0);
}

} // namespace

StatorVector inverter_voltage(const bridge_t &output, double dc_link_V, StatorVector i)
{
    StatorVector share;
    if (output.gate_enable) { // EQ-INVERTER-1
        share = clarke({static_cast<double>(output.duty.a), static_cast<double>(output.duty.b),
                        static_cast<double>(output.duty.c)});
    } else {
        const PhaseVector x = phases_of(i);
        share               = clarke({diode_share(x.a), diode_share(x.b), diode_share(x.c)});
    }
    return {dc_link_V * share.alpha, dc_link_V * share.beta};
}

} // namespace sdre
