// SPDX-License-Identifier: MIT
/// One scenario with many motors that the controller does not know.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/file_output.hpp"
#include "sil/eval/metrics.hpp"
#include "sil/eval/settled_noise.hpp"
#include "sil/run/simulation.hpp"
#include "sil/setup/scenario.hpp"

namespace sdre {

/// Failure of one motor's run.
struct MotorFailure {
    int                      motor   = 0; ///< 1 .. count; the noise seed too
    bool                     tripped = false;
    MotorScale               scale;
    std::vector<std::string> reasons; ///< what was seen, then the linear loop's view of why
};

struct RandomMotors {
    int                       count = 0;
    std::vector<MotorScale>   scales;   ///< of all motors; motor n is scales[n - 1]
    std::vector<MotorFailure> failures; ///< by number

    int good() const
    {
        return count - static_cast<int>(failures.size());
    }
    int tripped() const;
};

/// The current circle may be left by this factor: the project's bound for every shipped scenario.
constexpr double allowed_current_ratio = 1.1;

/// Reasons why a run fails: the drive trips, or the current exceeds its limit by that factor. Others are a speed outside
/// the band at the end of a measure, and more noise than allowed in its steady part. Empty: none.
std::vector<std::string> judge(const Scenario &scenario, const SimulationResult &result,
                               const std::vector<Metrics>    &metrics,
                               const std::vector<NoiseLimit> &limits);

/// The factors of one motor, a function of seed and number only: uniform in Scenario::motor_ranges.
MotorScale draw_motor(const MotorRanges &ranges, std::uint64_t seed, int motor);

/// Runs the scenario with motors 1 .. count in parallel. A motor fails as judge() says.
RandomMotors run_random_motors(const Scenario &scenario, int count);

std::string random_motors_text(const Scenario &scenario, const RandomMotors &runs);
/// One row per motor: number, factors, 1 when it failed, reasons.
std::string random_motors_csv(const RandomMotors &runs);
std::string random_motors_json(const Scenario &scenario, const RandomMotors &runs);

/// Every failed motor as DIR/<scenario>_motor_<n>.toml, a scenario for `sdre-sil run`; with `drive_file` in place of the
/// scenario's unless it is empty. Makes the directory.
std::vector<OutputFile> failed_motor_files(const std::filesystem::path &scenario_file,
                                           const std::filesystem::path &drive_file,
                                           const RandomMotors          &runs,
                                           const std::filesystem::path &directory);

} // namespace sdre
