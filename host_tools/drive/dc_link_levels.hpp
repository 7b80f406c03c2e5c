// SPDX-License-Identifier: MIT
/// Levels of the dc link, over its nominal value.
#pragma once

namespace sdre {

// Chosen: room for regeneration and for a weak supply; the board's hardware limits stand behind it.
constexpr double dc_link_min_ratio = 0.3;
constexpr double dc_link_max_ratio = 1.35;

// Chosen: regeneration is full up to 10 % above the nominal dc link and nothing at 25 %, below the trip.
constexpr double regen_start_ratio = 1.10;
constexpr double regen_end_ratio   = 1.25;

} // namespace sdre
