// SPDX-License-Identifier: MIT
/// The capacitor between supply and bridge.
///
///     C v' = i_source - i_bridge,   i_source = (v_source - v) / R              EQ-DC-LINK-1
///
/// A rectifier (Regeneration::blocks) gives no negative i_source. Solved exactly for a constant i_bridge,
/// so that no time step is too long for a small R C.
#pragma once

#include "sil/setup/board_settings.hpp"

namespace sdre {

class DcLink {
public:
    /// Starts charged to the source.
    DcLink(const InverterSettings &settings, double source_V);

    /// Changes in flight; the capacitor keeps its voltage, unless it hangs on a stiff source.
    void configure(const InverterSettings &settings, double source_V);
    void advance(double bridge_A, double dt_s);

    double voltage_V() const
    {
        return v_V_;
    }
    bool stiff() const
    {
        return stiff_;
    }

private:
    void settle(); ///< a source without resistance holds the voltage at or above its own

    double source_V_       = 0.0;
    double resistance_Ohm_ = 0.0;
    double capacitance_F_  = 0.0;
    bool   blocks_         = false;
    bool   stiff_          = true;
    double v_V_            = 0.0;
};

} // namespace sdre
