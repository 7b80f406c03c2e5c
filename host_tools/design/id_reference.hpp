// SPDX-License-Identifier: MIT
/// The d-current reference as part of the loop. It follows the estimates through a first-order filter (EQ-CURRENT-REF-2 to 5, 8, 9),
/// in double precision and with its derivatives.
#pragma once

#include <vector>

#include "design/motor_model.hpp"
#include "design/sampled_model.hpp"
#include "drive/core_types.hpp"

namespace sdre {

struct Design;

/// Inputs of the reference in a period.
struct IdInputs {
    double d_omega         = 0.0; ///< estimated disturbances [rad/s2, A/s, A/s]
    double d_q             = 0.0;
    double d_d             = 0.0;
    double omega_e_radps   = 0.0;
    double iq_A            = 0.0;
    double id_A            = 0.0;
    double iq_ref_A        = 0.0; ///< of the period before
    double iq_speed_A      = 0.0; ///< what the errors of speed and position request (EQ-NOSC-3)
    double profile_e_radps = 0.0; ///< w_d, constant
};

/// The constants of the firmware, and the circle at the design's dc link.
struct IdReference {
    current_ref_config_t c{};
    double               most_Aps = 0.0; ///< l6 times the voltage for steady currents
    double               ts_s     = 0.0;
};

/// Target of id_ref [A].
double id_target_A(const IdReference &r, const ReducedParameters &l, const IdInputs &in);

/// The steady state of a motor at a speed and a q current: the point, and what the observer of another model estimates there.
struct SteadyState {
    OperatingPoint at;
    IdInputs       in;
};

/// At a point that is one. @param motor what the motor is, @param model what the controller believes.
SteadyState state_at(const TrueMotor &motor, const ReducedParameters &model,
                     const OperatingPoint &at);

/// id_ref = id_target_A(). @param motor what the motor is, @param model what the controller believes.
SteadyState steady_state(const IdReference &r, const TrueMotor &motor,
                         const ReducedParameters &model, double omega_e_radps, double iq_A);

/// The reference linearised there. `Lambda` as in LoopGains: its speed row makes iq_speed_A.
MovingReference moving_reference(const IdReference &r, const ReducedParameters &model,
                                 const Eigen::MatrixXd &Lambda, const SteadyState &s);

/// The constants of a drive's law with the design's dc link.
IdReference id_reference(const Design &design, const current_ref_config_t &c);

/// The q current of the largest torque that current limit and voltage circle allow a motor in steady state, with the sign of `sign`.
double most_iq_A(const IdReference &r, const TrueMotor &motor, const ReducedParameters &model,
                 double omega_e_radps, double sign);

/// The steady state at a share of nearly the largest q current, -1 .. 1.
OperatingPoint loaded_point(const IdReference &r, const TrueMotor &motor,
                            const ReducedParameters &model, double omega_e_radps, double share);

/// loaded_point()s from standstill to `top_e_radps` and from the largest q current against the speed to the largest with it:
/// per_side squared. A negative speed is the mirror image of a positive one with the other sign of current.
std::vector<OperatingPoint> plane_points(const IdReference &r, const TrueMotor &motor,
                                         const ReducedParameters &model, double top_e_radps,
                                         int per_side);

/// Chosen: neighbouring points differ by 2.5 % of the largest speed and by 5 % of the largest q current.
constexpr int plane_points_per_side = 41;
/// The same while weights of a machine with a map are searched.
constexpr int quick_points_per_side = 9;

} // namespace sdre
