// SPDX-License-Identifier: MIT
/// The constants that the control core runs on in a scenario.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drive/core_types.hpp"
#include "linalg/care.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// The constants the core runs on, from the table or solved here.
struct Controller {
    drive_config_t              config{};
    bool                        compiled_table = false;
    std::vector<std::string>    uncertified;
    std::shared_ptr<const void> constants; ///< what config points to, when solved here
};

/// The drive that the controller knows: controller_scale, nosc_order and nodo_order of the scenario act.
Drive believed_drive(const Scenario &scenario);

/// DesignError when the gains cannot be solved. `extended` is for a drive that learns its inertia (design.hpp).
Controller prepare_controller(const Scenario &scenario, Precision precision = Precision::quick);

} // namespace sdre
