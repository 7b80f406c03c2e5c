// SPDX-License-Identifier: MIT
/// The result of a commissioning, compared with the true values.
#pragma once

#include <string>
#include <vector>

#include "sil/commission/bench.hpp"

namespace sdre {

struct CommissionLine {
    std::string name;
    std::string unit;
    double      truth       = 0.0;
    double      found       = 0.0;
    double      uncertainty = 0.0; ///< twice the standard deviation
    double      error       = 0.0; ///< relative, or absolute where `relative` is false
    bool        relative    = true;
};

std::vector<CommissionLine> commission_lines(const Drive &truth, const CommissionRun &run);

/// Table, maps and how it went.
std::string commission_text(const Drive &truth, const CommissionRun &run);
std::string commission_json(const Drive &truth, const CommissionRun &run);
std::string commission_csv(const CommissionRun &run);

} // namespace sdre
