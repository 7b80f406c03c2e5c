// SPDX-License-Identifier: MIT
/// Riccati equations: the JSON file, and the solver with whatever numbers stand in it.
#include "gains/care_command.hpp"
#include "reader.hpp"

namespace {

// Larger ones take their time: a fuzzer wants many small ones.
constexpr Eigen::Index largest = 4;

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    return fuzz::read(data, size, [](const auto &file) {
        const sdre::CareProblem problem = sdre::read_care_problem(file);
        if (problem.A.rows() <= largest) {
            const sdre::CareSolution solution = sdre::solve_care_problem(problem);
            if (!solution.X.allFinite() || sdre::care_json(solution).empty()) {
                std::abort();
            }
        }
    });
}
