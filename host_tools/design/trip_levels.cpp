// SPDX-License-Identifier: MIT
#include "design/trip_levels.hpp"

#include <algorithm>
#include <cmath>

#include "design/board/board_constants.hpp"

namespace sdre {
namespace {

// Chosen: room for regeneration and for a weak supply; the board's hardware limits stand behind it.
constexpr double dc_link_min_ratio  = 0.3;
constexpr double dc_link_max_ratio  = 1.35;
constexpr double trip_current_ratio = 2.0;

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

double largest_command_e_radps(const Drive &d)
{
    const double said =
        d.motor.max_speed_e_radps > 0.0 ? d.motor.max_speed_e_radps : trip_speed_e_radps(d);
    return d.inverter.regeneration == DcLinkSink::none ? std::min(said, emf_limit_e_radps(d))
                                                       : said;
}

} // namespace sdre
