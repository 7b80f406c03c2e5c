// SPDX-License-Identifier: MIT
/// The sampled closed loop of the encoder form, linearised at an operating point: true motor,
/// observer, law, one period of delay. The state [w iq id (theta - theta^) | d_w^ d_q^ d_d^ w^ iq^
/// id^] has deviations from the operating point. A position's law adds theta^, a moving d-current reference [id_ref iq_ref]:
/// n = 10 to 13.
#pragma once

#include "design/motor_model.hpp"
#include "design/true_motor.hpp"
#include "linalg/eigenvalues.hpp"

namespace sdre {

/// The gains at that point: Lambda is 2 x 3, of a position 2 x 4 with the angle first. L is 7 x 3.
struct LoopGains {
    Eigen::MatrixXd Lambda;
    Eigen::MatrixXd L;
};

/// Whether gains are those of a position.
inline bool has_angle(const Eigen::MatrixXd &Lambda)
{
    return Lambda.cols() == 4;
}

/// EQ-CERT-3: x(k+1) = A x(k) + b_load T_load(k) + B_noise n(k).
struct SampledModel {
    Eigen::MatrixXd A;      ///< n x n
    Eigen::VectorXd b_load; ///< n, per newton metre of load torque
    Eigen::MatrixXd
        B_noise; ///< n x 3, per ampere of iq, id and radian of angle error in the measurement
    Eigen::MatrixXd C_voltage; ///< 2 x n: the v_q, v_d in force
    Eigen::MatrixXd B_voltage; ///< n x 2, per volt of v_q, v_d that the observer does not know
    double          ts_s = 0.0;
};

/// EQ-NODO-ENCODER-2 linearised: x^-(k+1) = P x^+ + G v.
struct PredictedObserver {
    Eigen::MatrixXd P; ///< 7 x 7
    Eigen::MatrixXd G; ///< 7 x 2
};

PredictedObserver predicted_encoder_form(const ReducedParameters &model, const OperatingPoint &at,
                                         double ts_s);

/// Target of id_ref, linearised, and the first-order filter to it.
struct MovingReference {
    Eigen::RowVectorXd of_estimate;     ///< the target's slopes, 7
    double             of_iq_ref = 0.0; ///< of the period before
    double             filter    = 1.0; ///< share of the way in a period
    double             ts_s      = 0.0;
    bool torque = false; ///< of a torque: EQ-TORQUE-2 makes iq_ref, and steps are fed forward
};

/// The law on the n predicted states of the observer (EQ-CERT-6). The references of the period before are r = [id_ref iq_ref].
/// v = F x^ + F_ref r, r(k+1) = B_ref x^ + A_ref r. A constant id_ref has no r.
struct LawRows {
    Eigen::MatrixXd F;     ///< 2 x n
    Eigen::MatrixXd F_ref; ///< 2 x 2 or 2 x 0
    Eigen::MatrixXd B_ref; ///< 2 x n or 0 x n
    Eigen::MatrixXd A_ref; ///< 2 x 2 or 0 x 0
};

/// The firmware's law for speed or position, n = 7. It is EQ-NOSC-1 and EQ-FEEDFORWARD-1, 2 with iq_ref of EQ-CURRENT-REF-1.
/// Without `moving` id_ref is constant.
LawRows encoder_form_law(const ReducedParameters &l, const Eigen::MatrixXd &Lambda,
                         const OperatingPoint &at, const MovingReference *moving = nullptr);

/// A plant over one period at an operating point: its states begin with w iq id theta, its inputs are v_q, v_d, T_load.
struct HeldPlant {
    Held<Eigen::MatrixXd> held;
    OperatingPoint        at;
    double                ts_s = 0.0;
};

/// An observer and its law in the firmware's order, at least those of the encoder form; the seventh state is theta^.
struct LinearObserver {
    Eigen::MatrixXd P;   ///< n x n, of the prediction
    Eigen::MatrixXd G;   ///< n x 2
    Eigen::MatrixXd C;   ///< 3 x n: iq, id, theta are measured
    LawRows         law; ///< on the predicted states
};

/// EQ-CERT-3 with the corrections Ts L. `angle`: the law reads theta^.
SampledModel closed_loop(const HeldPlant &plant, const LinearObserver &observer,
                         const Eigen::MatrixXd &L, bool angle);

/// EQ-CERT-3 of any such plant. Its further states stand between (theta - theta^) and the observer's.
SampledModel closed_loop(const HeldPlant &plant, const ReducedParameters &model,
                         const LoopGains &gains, const MovingReference *moving = nullptr);

/// @param motor what the motor is, @param model what the controller believes. The references of `moving` are two states more.
SampledModel sampled_model(const TrueMotor &motor, const ReducedParameters &model,
                           const LoopGains &gains, const OperatingPoint &at, double ts_s,
                           const MovingReference *moving = nullptr);

/// The exact MTPA current id for an iq, 0 without saliency.
double mtpa_id_A(const ReducedParameters &l, double iq_A);

/// The q current that gives a torque with the d current of mtpa_id_A(), at most `most_A` [A].
double mtpa_iq_A(const Motor &motor, const ReducedParameters &l, double torque_Nm, double most_A);

} // namespace sdre
