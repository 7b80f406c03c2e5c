// SPDX-License-Identifier: MIT
/// The firmware's self-commissioning on the simulated motor of a drive file, with its sensors and its inverter.
///
/// The module gets what a board knows: currents as converted, dc link, a count that begins at zero wherever the shaft
/// stands, the index; bounds. The seed draws noise, disc, rotor angle, and which way the encoder counts.
#pragma once

#include <cstdint>
#include <vector>

#include "drive/drive_file.hpp"
#include "sil/setup/scenario.hpp"

extern "C" {
#include "commission.h"
}

namespace sdre {

struct CommissionOptions {
    std::uint64_t seed          = 1;
    double        coulomb_share = 0.01; ///< dry friction of the plant, of the rated torque
    double        cogging_share = 0.0;  ///< amplitude, of the rated torque; 6 periods per pole pair
    bool          lines_known   = true; ///< else counted from index to index
    int           trace_every   = 0;    ///< periods between two rows of the trace; 0: none
    double        current_share = 1.0;  ///< bound of the current, of the drive's limit
};

/// One row of the trace, of the plant.
struct CommissionRow {
    double time_s        = 0.0;
    int    stage         = 0;
    double id_A          = 0.0;
    double iq_A          = 0.0;
    double omega_e_radps = 0.0;
    double theta_e_rad   = 0.0;
    double peak_A        = 0.0; ///< largest |i| since the row before
};

struct CommissionRun {
    commission_stage_t         stage  = COMMISSION_IDLE;
    commission_stage_t         during = COMMISSION_IDLE; ///< last stage that ran
    commission_reason_t        reason = COMMISSION_REASON_NONE;
    commission_result_t        found{};
    commission_map_t           map{}; ///< of the module alone
    double                     time_s            = 0.0;
    double                     bound_A           = 0.0; ///< that the drive may use
    double                     peak_current_A    = 0.0; ///< |i| of the plant, also between samples
    double                     true_offset_e_rad = 0.0; ///< what offset_rad should be
    double                     true_coulomb_Nm   = 0.0;
    bool                       reversed          = false;
    std::vector<CommissionRow> trace;

    bool finished() const
    {
        return stage == COMMISSION_FINISHED;
    }
    /// Largest current, of the bound.
    double peak_share() const
    {
        return peak_current_A / bound_A;
    }
};

/// The simulated motor with its surroundings, at rest.
Scenario commission_scenario(const Drive &truth, const CommissionOptions &options);

/// The board's constants of a drive, with the drive's limits as bounds.
commission_config_t commission_config_of(const Drive &drive, const CommissionOptions &options);

CommissionRun commission(const Drive &truth, const CommissionOptions &options);

/// The same in surroundings of the caller's choice: faults, load, inverter, disc.
CommissionRun commission_in(const Scenario &scenario, const CommissionOptions &options);

const char *commission_stage_name(commission_stage_t stage);
const char *commission_reason_text(commission_reason_t reason);

} // namespace sdre
