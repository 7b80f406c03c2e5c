// SPDX-License-Identifier: MIT
/// Self-commissioning with a fault: how far the true current rises above its bound.
#pragma once

#include <string>
#include <vector>

#include "sil/commission/bench.hpp"

namespace sdre {

struct CommissionFault {
    std::string      name;
    FaultKind        kind         = FaultKind::current_zero;
    double           value        = 0.0; ///< see FaultKind
    double           limit        = 0.0;
    std::vector<int> phases       = {0}; ///< sets that fail together; bit 0: a, bit 1: b, bit 2: c
    bool             encoder_dead = false; ///< instead of the kind
    int              from_stage   = COMMISSION_WATCH;
};

/// Faults of sensors, motor wires and encoder; drifts scale with the drive's limit. Gains begin in LOOK: before, both
/// sensors with the same gain are those of another motor.
std::vector<CommissionFault> commission_faults(const Drive &drive);

/// One run, and the fault that begins in it.
struct CommissionCase {
    CommissionFault fault;
    int             phases   = 1;
    int             stage    = 0; ///< of a healthy run at that time
    double          time_s   = 0.0;
    double          share    = 0.0; ///< largest true current, of the bound
    bool            finished = false;
};

/// Every fault at some times of each of its stages.
/// @throws InputError a healthy run does not finish
std::vector<CommissionCase> commission_with_faults(const Drive                        &drive,
                                                   const CommissionOptions            &options,
                                                   const std::vector<CommissionFault> &faults,
                                                   int                                 times);

/// The case with the largest current, in this stage; nullptr without any.
const CommissionCase *worst_case(const std::vector<CommissionCase> &cases, int stage);

std::string case_text(const CommissionCase &one);

/// Largest current of each fault in each stage, of the bound.
std::string commission_fault_table(const std::vector<CommissionCase> &cases);

} // namespace sdre
