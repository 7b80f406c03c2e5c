// SPDX-License-Identifier: MIT
/// The programme in the simulation, with a machine that differs from its drive file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sil/run/controller.hpp"
#include "sil/verify/programme.hpp"

namespace sdre {

/// Values of a drive file that may be wrong.
enum class Believed {
    inertia,
    pm_flux,
    d_inductance,
    q_inductance,
    resistance,
    friction,
    angle,
    dead_time,
    disc,
    count
};
constexpr std::size_t believed_count = static_cast<std::size_t>(Believed::count);

/// "inertia", "magnet flux", ..
const char *believed_name(Believed what);

/// How far a machine is from its drive file, in stated uncertainties. Friction: 0 .., more than the file's.
using Difference = std::array<double, believed_count>;

/// Evenly distributed: friction 0 .. 1, all others -1 .. 1.
Difference draw_difference(std::uint64_t seed);

/// Samples of one shot; values[k][n]: signal k, sample n.
struct Record {
    std::array<std::vector<double>, 4> values;
};

/// All records of a run.
struct Records {
    std::vector<Record>        shots; ///< all of the programme's, unless it tripped
    std::optional<std::string> fault; ///< why the drive opened its bridge
};

/// Such a machine on its bench: real sensors and inverter, at rest, no load. The seed draws noise, disc and rotor angle.
Scenario machine_on_bench(const Drive &drive, const Difference &difference, std::uint64_t seed);

/// The control core runs the programme.
Records rehearse(const Scenario &machine, const Controller &controller, const Programme &programme);

/// The constants of the drive file with the sensors that it names. DesignError as prepare_controller().
Controller controller_of(const Drive &drive);

} // namespace sdre
