// SPDX-License-Identifier: MIT
#include "sil/setup/motor_scale.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace sdre {

namespace {

constexpr Range scale_range{0.01, 100.0};

Range read_factor_range(TomlReader &t, const char *key)
{
    const std::vector<double> range = t.numbers(key, {2}, scale_range);
    if (range[1] < range[0]) {
        t.fail(key, fmt::format("= [{:g}, {:g}] is not allowed: the first must not be above the "
                                "second",
                                range[0], range[1]));
    }
    return {range[0], range[1]};
}

} // namespace

Motor scaled(Motor motor, const MotorScale &scale)
{
    for (const auto &[key, factor] : scale) {
        motor_value(motor, key) *= factor;
    }
    return motor;
}

MotorScale read_scale(TomlReader t)
{
    MotorScale scale;
    Motor      probe;
    for (const std::string &key : t.keys()) {
        scale[key] = t.number(key, scale_range);
        try {
            motor_value(probe, key);
        } catch (const InputError &) {
            t.fail(key, "is not a motor key that can be scaled");
        }
    }
    return scale;
}

MotorRanges read_motor_ranges(TomlReader t)
{
    const MotorRanges ranges{read_factor_range(t, "resistance"), read_factor_range(t, "inductance"),
                             read_factor_range(t, "flux"), read_factor_range(t, "inertia")};
    t.reject_unknown_keys();
    return ranges;
}

} // namespace sdre
