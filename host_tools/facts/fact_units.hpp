// SPDX-License-Identifier: MIT
/// The units in which data sheets give what a drive file needs.
#pragma once

#include <string>
#include <vector>

namespace sdre {

enum class Dimension {
    count, ///< a whole number without a unit
    resistance,
    inductance,
    flux,
    emf_per_speed,
    speed_per_volt,
    torque_per_current,
    inertia,
    friction,
    speed,
    torque,
    current,
    power,
    voltage,
    frequency,
    time,
    motor_constant
};

struct Unit {
    Dimension   dimension;
    std::string name;               ///< as at the end of a key, in lower case
    double      si;                 ///< times this is SI; speeds are of the shaft
    bool        electrical = false; ///< a speed of the field: to be divided by the pole pairs
};

/// Every unit that a key may end with.
const std::vector<Unit> &fact_units();

/// "Ohm, mOhm, uOhm": the units of a dimension, for a message.
std::string unit_names(Dimension dimension);

} // namespace sdre
