// SPDX-License-Identifier: MIT
#include "sil/plant/inverter.hpp"

namespace sdre {

StatorVector inverter_voltage(const bridge_t &closed, double dc_link_V)
{
    const StatorVector share =
        clarke({static_cast<double>(closed.duty.a), static_cast<double>(closed.duty.b),
                static_cast<double>(closed.duty.c)}); // EQ-INVERTER-1
    return {dc_link_V * share.alpha, dc_link_V * share.beta};
}

} // namespace sdre
