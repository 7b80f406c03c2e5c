// SPDX-License-Identifier: MIT
#include "design/trip_levels.hpp"

#include <algorithm>
#include <cmath>

#include "design/board/board_constants.hpp"
#include "drive/dc_link_levels.hpp"

namespace sdre {
namespace {

constexpr double trip_current_ratio = 2.0;
// Chosen: the limit takes over where the chopper is too weak or hot, and ends halfway to the trip.
constexpr double regen_share_above_chopper = 0.5;

/// The speed at which the line EMF alone reaches the dc link's trip level through the diodes of an open bridge.
double emf_limit_e_radps(const Drive &d) // EQ-OPEN-3
{
    return dc_link_max_ratio * d.inverter.dc_link_V / (std::sqrt(3.0) * d.motor.pm_flux_Wb);
}

} // namespace

double trip_current_A(const Drive &drive)
{
    return std::min(trip_current_ratio * drive.motor.max_current_A, largest_trip_current_A(drive));
}

double trip_dc_link_min_V(const Drive &drive)
{
    return dc_link_min_ratio * drive.inverter.dc_link_V;
}

double trip_dc_link_max_V(const Drive &drive)
{
    return std::min(dc_link_max_ratio * drive.inverter.dc_link_V, largest_trip_dc_link_V(drive));
}

RegenerationLimit regeneration_limit(const Drive &d)
{
    const double v_dc = d.inverter.dc_link_V;
    if (d.inverter.regeneration == DcLinkSink::brake_chopper && has_chopper(d)) {
        const double on_V = (*d.board.file)[BOARD_FACT_CHOPPER_ON_V];
        return {on_V, on_V + regen_share_above_chopper * (trip_dc_link_max_V(d) - on_V)};
    }
    return {regen_start_ratio * v_dc, regen_end_ratio * v_dc};
}

double largest_command_e_radps(const Drive &d)
{
    const double said =
        d.motor.max_speed_e_radps > 0.0 ? d.motor.max_speed_e_radps : trip_speed_e_radps(d);
    return d.inverter.regeneration == DcLinkSink::none ? std::min(said, emf_limit_e_radps(d))
                                                       : said;
}

} // namespace sdre
