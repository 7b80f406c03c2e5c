// SPDX-License-Identifier: MIT
/// The coupling is between the motor and its load.
#pragma once

#include <optional>

#include "common/toml_reader.hpp"

namespace sdre {

enum class Coupling {
    rigid,   ///< motor and load are one mass
    elastic, ///< two masses; nobody has measured the resonance
    known    ///< two masses with this resonance
};

/// The table [mechanics]. No constant of a drive depends on it; certificate, `tune` and the simulated plant do.
/// The shafts that it stands for have any resonance and any damping ratio of these.
struct Mechanics {
    Coupling coupling           = Coupling::rigid;
    double   from_Hz            = 0.0; ///< resonance of both masses against each other
    double   to_Hz              = 0.0;
    double   least_damping      = 0.0; ///< ratio
    double   most_damping       = 0.0;
    double   load_inertia_share = 0.5; ///< of inertia_kgm2, behind the coupling
    double   resonance_Hz       = 0.0; ///< known: what was measured
};

/// Without a table a rigid coupling. InputError on anything unknown or out of range.
Mechanics read_mechanics(std::optional<TomlReader> t);

} // namespace sdre
