// SPDX-License-Identifier: MIT
/// The record of a run: one row per control period.
#pragma once

#include <vector>

#include "common/large_memory.hpp"
#include "drive/core_types.hpp"
#include "sil/run/board.hpp"

namespace sdre {

/// One control period: the plant at the sampling instant and what the core answered.
struct TraceRow {
    double time_s              = 0.0;
    double omega_ref_e_radps   = 0.0; ///< commanded
    double omega_e_radps       = 0.0;
    double iq_A                = 0.0;
    double id_A                = 0.0;
    double iq_ref_A            = 0.0;
    double id_ref_A            = 0.0;
    double vq_V                = 0.0; ///< commanded at this tick, after the limit
    double vd_V                = 0.0;
    double d_omega_hat         = 0.0;
    double d_q_hat             = 0.0;
    double d_d_hat             = 0.0;
    double sensor_offset_hat_A = 0.0; ///< length of the offset that noc_h's observer has found
    double load_torque_Nm      = 0.0;
    double torque_Nm           = 0.0;
    double dc_link_V           = 0.0;
    double theta_e_rad         = 0.0; ///< of the shaft, not wrapped
    double position_e_rad      = 0.0; ///< the same; in a run to positions from the first sample
    double position_ref_e_rad  = 0.0; ///< the core's reference; the shaft's own in a speed run
    double peak_current_A      = 0.0; ///< largest |i| from this instant to the next

    /// Current of phase 0 .. 2: from the others of the row, because few runs ask for it.
    double phase_A(int phase) const;
};

/// The rows of a whole run, of any length.
using Trace = std::vector<TraceRow, LargeAllocator<TraceRow>>;

/// The plant's part of a row, without the peak.
TraceRow row_of(double time_s, double omega_ref_e_radps, const PlantState &plant);
/// |i| at the instant of a row.
double instant_A(const TraceRow &row);
/// The drive's part of a row: references, voltages, estimated disturbances.
void add_drive(TraceRow &row, const drive_t &drive);

} // namespace sdre
