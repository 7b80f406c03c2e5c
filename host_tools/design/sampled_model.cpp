// SPDX-License-Identifier: MIT
#include "design/sampled_model.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {
namespace {

using Eigen::MatrixXd;

/// The observer's model: EQ-MOTOR-2 linearised, constant disturbances, theta' = w. 7 x 7 and 7 x 2.
MatrixXd observer_jacobian(const ReducedParameters &l, const OperatingPoint &at)
{
    MatrixXd J          = MatrixXd::Zero(7, 7);
    J.block(3, 0, 3, 3) = MatrixXd::Identity(3, 3);
    J.block(3, 3, 3, 3) = motor_jacobian(l, at);
    J(6, 3)             = 1.0;
    return J;
}

MatrixXd observer_input(const ReducedParameters &l)
{
    MatrixXd B          = MatrixXd::Zero(7, 2);
    B.block(3, 0, 3, 2) = nosc_input_matrix(l);
    return B;
}

} // namespace

MatrixXd encoder_form_law(const ReducedParameters &l, const MatrixXd &Lambda,
                          const OperatingPoint &at)
{
    const double D      = l[1] + l[11] * at.id_A;
    const bool   angle  = has_angle(Lambda);
    const double k_ref  = Lambda(0, angle ? 2 : 1) + l[4] / l[6]; // v_q per ampere of iq_ref
    MatrixXd     F      = MatrixXd::Zero(2, 7);
    F.block(0, 3, 2, 3) = -Lambda.rightCols(3);
    if (angle) {
        F.col(6) = -Lambda.col(0);
    }
    F(0, 0) = -k_ref / D;
    F(0, 1) = -1.0 / l[6];
    F(0, 3) += l[10] * at.id_A / l[6];
    F(0, 5) += l[10] * at.omega_e_radps / l[6] - k_ref * at.iq_A * l[11] / D;
    F(1, 2) = -1.0 / l[8];
    F(1, 3) -= l[9] * at.iq_A / l[8];
    F(1, 4) -= l[9] * at.omega_e_radps / l[8];
    return F;
}

Held<MatrixXd> held_motor(const ReducedParameters &l, const OperatingPoint &at, double ts)
{
    MatrixXd A          = MatrixXd::Zero(4, 4);
    MatrixXd B          = MatrixXd::Zero(4, 3);
    A.block(0, 0, 3, 3) = motor_jacobian(l, at);
    A(3, 0)             = 1.0;
    B.block(0, 0, 3, 2) = nosc_input_matrix(l);
    B(0, 2)             = -l[3];
    return c2d(A, B, ts);
}

PredictedObserver predicted_encoder_form(const ReducedParameters &model, const OperatingPoint &at,
                                         double ts)
{
    const MatrixXd J = observer_jacobian(model, at);
    const MatrixXd I = MatrixXd::Identity(7, 7);
    return {I + ts * J * (I + 0.5 * ts * J), // EQ-NODO-ENCODER-2
            ts * (I + 0.5 * ts * J) * observer_input(model)};
}

Eigen::Matrix3d motor_jacobian(const ReducedParameters &l, const OperatingPoint &at)
{
    Eigen::Matrix3d J;
    J << -l[2], l[1] + l[11] * at.id_A, l[11] * at.iq_A,           //
        -l[5] - l[10] * at.id_A, -l[4], -l[10] * at.omega_e_radps, //
        l[9] * at.iq_A, l[9] * at.omega_e_radps, -l[7];
    return J;
}

SampledModel sampled_model(const ReducedParameters &motor, const ReducedParameters &model,
                           const LoopGains &gains, const OperatingPoint &at, double ts)
{
    const Held<MatrixXd> held = held_motor(motor, at, ts);
    const auto [P, G]         = predicted_encoder_form(model, at, ts);
    const MatrixXd F          = encoder_form_law(model, gains.Lambda, at);
    const MatrixXd C          = nodo_model(model, NodoForm::encoder).C;
    const MatrixXd PL         = ts * P * gains.L; // EQ-NODO-ENCODER-1, then the prediction

    MatrixXd A                = MatrixXd::Zero(11, 11); // (w iq id theta | observer)
    A.topLeftCorner(4, 4)     = held.Phi;
    A.topRightCorner(4, 7)    = held.Gamma.leftCols(2) * F;
    A.bottomLeftCorner(7, 4)  = PL * C.rightCols(4);
    A.bottomRightCorner(7, 7) = P - PL * C + G * F;

    // The motor depends on theta - theta^ only, not on the angle itself. With that difference as a
    // state, theta^ is an integrator that only a position's law reads. Otherwise theta^ is left
    // out.
    const Eigen::Index n = has_angle(gains.Lambda) ? 11 : 10;
    MatrixXd           S = MatrixXd::Identity(11, 11);
    S(3, 10)             = -1.0;
    MatrixXd S_inverse   = MatrixXd::Identity(11, 11);
    S_inverse(3, 10)     = 1.0;

    Eigen::VectorXd b_load = Eigen::VectorXd::Zero(11);
    b_load.head(4)         = held.Gamma.col(2);
    MatrixXd B_voltage     = MatrixXd::Zero(11, 2);
    B_voltage.topRows(4)   = held.Gamma.leftCols(2);
    MatrixXd B_noise       = MatrixXd::Zero(11, 3);
    B_noise.bottomRows(7)  = PL;

    SampledModel out;
    out.ts_s                       = ts;
    out.A                          = (S * A * S_inverse).topLeftCorner(n, n);
    out.C_voltage                  = MatrixXd::Zero(2, n);
    out.C_voltage.rightCols(n - 4) = F.leftCols(n - 4);
    out.b_load                     = (S * b_load).head(n);
    out.B_noise                    = (S * B_noise).topRows(n);
    out.B_voltage                  = (S * B_voltage).topRows(n);
    return out;
}

double mtpa_id_A(const ReducedParameters &l, double iq_A)
{
    const double k    = 0.5 * l[5] / std::max(1.0 - l[10], 1e-9); // EQ-CURRENT-REF-2
    const double most = iq_A == 0.0 ? 0.0 : -iq_A * iq_A / (k + std::hypot(k, iq_A));
    return std::min(most, l[0]);
}

double mtpa_iq_A(const Motor &motor, const ReducedParameters &l, double wanted_Nm, double most_A)
{
    double lo = 0.0;
    double hi = most_A;
    for (int i = 0; i < 60; i++) { // to the last bit
        const double iq_A                                                  = 0.5 * (lo + hi);
        (torque_Nm(motor, mtpa_id_A(l, iq_A), iq_A) < wanted_Nm ? lo : hi) = iq_A;
    }
    return lo;
}

} // namespace sdre
