// SPDX-License-Identifier: MIT
/// Goals of a drive in physical terms: the input of `sdre-gains tune`.
#pragma once

#include <filesystem>
#include <vector>

namespace sdre {

/// Factors on the controller's model, relative to the motor, and the limits for that case.
struct RobustnessCase {
    double mechanical      = 1.0; ///< on J and B
    double electrical      = 1.0; ///< on Rs, Ld, Lq and flux
    double inductance      = 1.0; ///< on Ld and Lq once more
    double resonance       = 1.0; ///< of the shaft over the believed one; noc_shaft only
    double dip_e_radps     = 0.0; ///< largest speed deviation after the load step
    double settling_time_s = 0.0;
    double ripple_e_radps  = 0.0; ///< three standard deviations of the speed
};

struct TuneSpec {
    // Operating point and disturbance.
    double speed_e_radps  = 0.0;
    double load_before_Nm = 0.0;
    double load_step_Nm   = 0.0;
    double band_e_radps   = 0.0; ///< settled within
    double largest_pole   = 0.0; ///< spectral radius that every robustness case must stay below
    // Bryson limits of the controller: one unit of cost each.
    double voltage_V      = 0.0;
    double d_axis_error_A = 0.0;
    double voltage_headroom_V =
        0.0; ///< what the load step and three deviations of noise may ask for
    double voltage_noise_V =
        0.0; ///< rms of v_q at constant speed and load, nominal case; 0: only voltage_headroom_V limits it
    bool noise_is_a_limit =
        false; ///< more noise is worse than any other goal missed; else one goal of several
    bool rare_edges =
        false; ///< fewer than samples, so that the sampled model is too good: a lively motor has to be stable, and the
               ///< sensitivity at the largest speed is a goal
    // Sensors: standard deviations of one sample, quantisation included by the tool.
    double                      current_noise_A = 0.0;
    double                      current_lsb_A   = 0.0;
    double                      angle_error_cnt = 0.0; ///< of the encoder's angle
    std::vector<RobustnessCase> cases;                 ///< the first is the nominal one
};

/// The controller's model is exact.
bool is_nominal(const RobustnessCase &c);

/// Whether a case has a shaft that is not as believed.
bool has_resonance(const TuneSpec &spec);

/// InputError in one line on anything missing, unknown or out of range.
TuneSpec read_tune_spec(const std::filesystem::path &file);

} // namespace sdre
