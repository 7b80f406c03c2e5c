// SPDX-License-Identifier: MIT
/// Many runs of one scenario that differ in some of its values: what a campaign's worker calls.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "common/toml_keys.hpp"
#include "sil/eval/random_motors.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// The text of a scenario file, which is changed and read again for every case. A case can
/// therefore be written as a scenario file, and every value is checked as there.
struct CaseBase {
    toml::table root;
    std::string source; ///< for messages
    std::string name;
    Drive       drive;
    Law         own; ///< of the drive that the file names
};

struct CaseVariable {
    std::vector<KeyPath> keys; ///< where its value goes: all get it
    bool                 whole = false;
};

/// Results of one run.
struct CaseResult {
    int    fault          = 0;     ///< SimulationResult::fault
    bool   failed         = false; ///< as judge() says
    double current_margin = 0.0;   ///< 1 - peak current / what is allowed; -1 after a fault
    double speed_margin =
        0.0; ///< 1 - largest |speed error| in the measures' steady parts / their bands; -1 after a fault
    std::vector<double> metrics; ///< measure by measure, each with all requested metrics; NaN: none
};

class CaseRunner {
public:
    /// InputError when a metric is none, or a variable's key leads through something that is no table.
    CaseRunner(CaseBase base, std::vector<CaseVariable> variables,
               std::vector<std::string> metrics);

    /// One run with these values, one for each variable, and this seed. InputError when the scenario cannot have them.
    CaseResult run(const double *values, std::uint64_t seed);

    /// InputError when the scenario cannot have these values; runs nothing.
    void check(const double *values)
    {
        scenario_of(values, first_.seed);
    }

    /// Names of the measures, in the order of the metrics.
    std::vector<std::string> measures() const;

private:
    Scenario scenario_of(const double *values, std::uint64_t seed);

    CaseBase                  base_;
    std::vector<CaseVariable> variables_;
    std::vector<std::string>  metrics_;
    Scenario                  first_; ///< the file as it stands
    bool                      other_controllers_;
    Controller                controller_; ///< of all cases, unless a variable is the controller's
    bool                      other_motors_only_;
    std::optional<std::vector<NoiseLimit>>
        limits_; ///< of the first run on, where only the motor varies
};

} // namespace sdre
