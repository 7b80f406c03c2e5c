// SPDX-License-Identifier: MIT
/// The capacitor between supply and bridge.
///
///     C v' = i_source - i_bridge,   i_source = (v_source - v) / R              EQ-DC-LINK-1
///
/// A brake chopper puts a resistor across the link while it is on,
///
///     i_bridge + v / R_chopper in place of i_bridge: on at chopper_on_V, off chopper_hysteresis_V lower   EQ-DC-LINK-2
///
/// The firmware of a board with a chopper switches it instead of these levels.
///
/// The source may ripple, by the sine that a rectified mains leaves,
///
///     v_source + ripple_V sin(2 pi ripple_Hz t), t from the start                                EQ-DC-LINK-3
///
/// It is held during advance(), for half a control period at most. A rectifier (Regeneration::blocks) gives no negative i_source. Solved exactly for a constant i_bridge,
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

    /// From here on the board's firmware switches the chopper, if it is the board's. Until then it switches by its levels.
    void command_chopper(bool on);

    double voltage_V() const
    {
        return v_V_;
    }
    /// Constant whatever the bridge takes.
    bool stiff() const
    {
        return stiff_ && ripple_V_ <= 0.0;
    }
    bool chopping() const
    {
        return chopping_;
    }
    /// Energy that the chopper's resistor has turned into heat.
    double chopper_J() const
    {
        return chopper_J_;
    }

private:
    void charge(double current_A, double dt_s); ///< without chopper
    void settle(); ///< a source without resistance holds the voltage at or above its own
    void chop(double bridge_A, double dt_s);
    void ripple(double dt_s);

    double mean_V_         = 0.0; ///< of the source
    double ripple_V_       = 0.0;
    double ripple_radps_   = 0.0;
    double ripple_rad_     = 0.0;
    double source_V_       = 0.0; ///< now
    double resistance_Ohm_ = 0.0;
    double capacitance_F_  = 0.0;
    bool   blocks_         = false;
    bool   stiff_          = true;
    double chopper_Ohm_    = 0.0; ///< 0: none
    double chopper_on_V_   = 0.0;
    double chopper_off_V_  = 0.0;
    bool   chopping_       = false;
    bool   of_board_       = false; ///< the chopper
    bool   commanded_      = false; ///< and its firmware switches it
    double chopper_J_      = 0.0;
    double v_V_            = 0.0;
};

} // namespace sdre
