// SPDX-License-Identifier: MIT
/// How fast simulated time passes, and what was left out.
#pragma once

#include <optional>

namespace sdre {

class Pace {
public:
    explicit Pace(double speed_factor = 1.0) : speed_factor_(speed_factor) {}

    /// After each round of the server.
    void note(double wall_s, double simulated_s);
    /// Time that was left out because the machine was late.
    void slip(double seconds)
    {
        slipped_s_ += seconds;
    }
    /// The wanted pace: simulated seconds per second.
    double speed_factor() const
    {
        return speed_factor_;
    }
    /// The real one: mean of the last second or two; the wanted one before.
    double real_time_factor() const
    {
        return real_time_factor_.value_or(speed_factor_);
    }
    double slipped_s() const
    {
        return slipped_s_;
    }
    /// Once for each time that it has become much slower than asked for.
    bool has_become_slow();

private:
    double                speed_factor_;
    double                slipped_s_ = 0.0;
    std::optional<double> real_time_factor_;
    std::optional<double> from_wall_s_;
    double                from_simulated_s_ = 0.0;
    bool                  slow_             = false;
};

} // namespace sdre
