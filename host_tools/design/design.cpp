// SPDX-License-Identifier: MIT
#include "design/design.hpp"

#include "design/firmware_config.hpp"
#include "design/law_design.hpp"

namespace sdre {

Design design_drive(const Drive &drive, Precision precision)
{
    Design design;
    design.drive     = drive;
    design.precision = precision;
    design.l         = reduced_parameters(drive.motor);
    design.config    = common_config(design);
    law_design(drive).solve(design);
    if (drive_config_check(&design.config) != CTL_OK) {
        design.certificate.failures.emplace_back(
            "a constant is not finite in single precision or outside the firmware's range");
    }
    return design;
}

} // namespace sdre
