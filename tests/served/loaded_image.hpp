// SPDX-License-Identifier: MIT
/// Images of constants for the served drive.
#pragma once

#include <string>

#include "design/design.hpp"
#include "emit/emit_image.hpp"
#include "served_client.hpp"

namespace sdre {

/// The shipped motor, faster or slower: an image that can be told from the compiled constants.
inline Words image(double speed_max_e_radps, const std::string &name)
{
    Drive drive                   = shipped_drive();
    drive.name                    = name;
    drive.motor.max_speed_e_radps = speed_max_e_radps;
    return image_words(design_drive(drive, Precision::quick));
}

} // namespace sdre
