// SPDX-License-Identifier: MIT
#include "design/sampled_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

namespace {

/// EQ-CERT-6: adds what the references do, iq_ref as a row of the observer's states.
LawRows with_references(const ReducedParameters &l, const MatrixXd &Lambda, const MatrixXd &F,
                        const Eigen::RowVectorXd &iq_ref, const MovingReference &m)
{
    const Eigen::Vector2d per_id_ref(Lambda(0, Lambda.cols() - 1),
                                     Lambda(1, Lambda.cols() - 1) + l[7] / l[8]);
    const Eigen::Vector2d per_step(0.0, m.filter / (m.ts_s * l[8])); // the derivative's part
    const Eigen::Vector2d per_target = m.filter * per_id_ref + per_step;

    LawRows law{F + per_target * m.of_estimate, MatrixXd(2, 2), MatrixXd(2, 7),
                MatrixXd::Zero(2, 2)};
    law.F_ref << per_id_ref - per_target, m.of_iq_ref * per_target;
    law.B_ref << m.filter * m.of_estimate, iq_ref;
    law.A_ref.row(0) << 1.0 - m.filter, m.filter * m.of_iq_ref;
    return law;
}

} // namespace

namespace {

/// noc_torque.c. A free shaft has Lambda(0, 0) = 0. Its error is that of the references of the period before, whose steps are fed forward. Where the speed limit acts, its references are those of this period, without a step of iq_ref.
LawRows torque_law(const ReducedParameters &l, const MatrixXd &Lambda, const OperatingPoint &at,
                   const MovingReference &m)
{
    const double       D       = l[1] + l[11] * at.id_A;
    const bool         limited = Lambda(0, 0) > 0.0;
    const double       per_s   = 1.0 / m.ts_s;
    Eigen::RowVectorXd iq_ref  = Eigen::RowVectorXd::Zero(7);
    iq_ref(5)                  = -at.iq_A * l[11] / D;
    if (limited) {
        iq_ref(0) = -1.0 / D;
        iq_ref(3) = -Lambda(0, 0) / Lambda(0, 1);
    }
    const Eigen::RowVectorXd id_ref = m.filter * m.of_estimate;
    MatrixXd                 F      = MatrixXd::Zero(2, 7);
    F(0, 1)                         = -1.0 / l[6];
    F(0, 3)                         = (l[5] + l[10] * at.id_A) / l[6];
    F(0, 4)                         = -Lambda(0, 1);
    F(0, 5)                         = l[10] * at.omega_e_radps / l[6];
    F(1, 2)                         = -1.0 / l[8];
    F(1, 3)                         = -l[9] * at.iq_A / l[8];
    F(1, 4)                         = -l[9] * at.omega_e_radps / l[8];
    F(1, 5)                         = -Lambda(1, 2);
    const double k_q                = limited ? Lambda(0, 1) : 0.0; // of the new references
    const double k_d                = limited ? Lambda(1, 2) : 0.0;
    const double q_step             = limited ? 0.0 : per_s / l[6];
    const double d_step             = per_s / l[8];
    const double per_iq_ref         = k_q + l[4] / l[6] + q_step; // volts per ampere of them
    const double per_id_ref         = k_d + l[7] / l[8] + d_step;
    F.row(0) += per_iq_ref * iq_ref;
    F.row(1) += per_id_ref * id_ref;

    LawRows law{F, MatrixXd::Zero(2, 2), MatrixXd(2, 7), MatrixXd::Zero(2, 2)};
    law.B_ref << id_ref, iq_ref;
    law.A_ref.row(0) << 1.0 - m.filter, m.filter * m.of_iq_ref;
    law.F_ref(0, 1)  = Lambda(0, 1) - k_q - q_step;
    law.F_ref.row(1) = per_id_ref * law.A_ref.row(0);
    law.F_ref(1, 0) += Lambda(1, 2) - k_d - d_step;
    return law;
}

} // namespace

LawRows encoder_form_law(const ReducedParameters &l, const MatrixXd &Lambda,
                         const OperatingPoint &at, const MovingReference *moving)
{
    if (moving != nullptr && moving->torque) {
        return torque_law(l, Lambda, at, *moving);
    }
    const double       D      = l[1] + l[11] * at.id_A;
    const bool         angle  = has_angle(Lambda);
    const double       k_ref  = Lambda(0, angle ? 2 : 1) + l[4] / l[6]; // v_q per ampere of iq_ref
    Eigen::RowVectorXd iq_ref = Eigen::RowVectorXd::Zero(7);
    MatrixXd           F      = MatrixXd::Zero(2, 7);
    iq_ref(0)                 = -1.0 / D;
    iq_ref(5)                 = -at.iq_A * l[11] / D;
    F.block(0, 3, 2, 3)       = -Lambda.rightCols(3);
    if (angle) {
        F.col(6) = -Lambda.col(0);
    }
    F.row(0) += k_ref * iq_ref;
    F(0, 1) = -1.0 / l[6];
    F(0, 3) += l[10] * at.id_A / l[6];
    F(0, 5) += l[10] * at.omega_e_radps / l[6];
    F(1, 2) = -1.0 / l[8];
    F(1, 3) -= l[9] * at.iq_A / l[8];
    F(1, 4) -= l[9] * at.omega_e_radps / l[8];
    if (moving != nullptr) {
        return with_references(l, Lambda, F, iq_ref, *moving);
    }
    return {F, MatrixXd(2, 0), MatrixXd(0, 7), MatrixXd(0, 0)};
}

PredictedObserver predicted_encoder_form(const ReducedParameters &model, const OperatingPoint &at,
                                         double ts)
{
    const MatrixXd J = observer_jacobian(model, at);
    const MatrixXd I = MatrixXd::Identity(7, 7);
    return {I + ts * J * (I + 0.5 * ts * J), // EQ-NODO-ENCODER-2
            ts * (I + 0.5 * ts * J) * observer_input(model)};
}

SampledModel sampled_model(const TrueMotor &motor, const ReducedParameters &model,
                           const LoopGains &gains, const OperatingPoint &at, double ts,
                           const MovingReference *moving)
{
    return closed_loop({held_motor(motor, at, ts), at, ts}, model, gains, moving);
}

SampledModel closed_loop(const HeldPlant &plant, const ReducedParameters &model,
                         const LoopGains &gains, const MovingReference *moving)
{
    const PredictedObserver p = predicted_encoder_form(model, plant.at, plant.ts_s);
    const LinearObserver    o{p.P, p.G, nodo_model(model, NodoForm::encoder).C,
                           encoder_form_law(model, gains.Lambda, plant.at, moving)};
    return closed_loop(plant, o, gains.L, has_angle(gains.Lambda));
}

SampledModel closed_loop(const HeldPlant &plant, const LinearObserver &observer, const MatrixXd &L,
                         bool angle)
{
    const auto &[held, at, ts] = plant;
    const auto &[P, G, C, law] = observer;
    const MatrixXd     PL      = ts * P * L; // EQ-NODO-ENCODER-1, then the prediction
    const Eigen::Index n_ref   = law.A_ref.rows();
    const Eigen::Index n_plant = held.Phi.rows();
    const Eigen::Index n_hat   = P.rows();
    const Eigen::Index refs    = n_plant + n_hat;
    const Eigen::Index n       = refs + n_ref; // (plant | observer | references)

    MatrixXd A                              = MatrixXd::Zero(n, n);
    A.topLeftCorner(n_plant, n_plant)       = held.Phi;
    A.block(0, n_plant, n_plant, n_hat)     = held.Gamma.leftCols(2) * law.F;
    A.block(n_plant, 0, n_hat, 4)           = PL * C.middleCols(3, 4);
    A.block(n_plant, n_plant, n_hat, n_hat) = P - PL * C + G * law.F;
    A.topRightCorner(n_plant, n_ref)        = held.Gamma.leftCols(2) * law.F_ref;
    A.block(n_plant, refs, n_hat, n_ref)    = G * law.F_ref;
    A.block(refs, n_plant, n_ref, n_hat)    = law.B_ref;
    A.bottomRightCorner(n_ref, n_ref)       = law.A_ref;

    MatrixXd b_load                    = MatrixXd::Zero(n, 1);
    b_load.topRows(n_plant)            = held.Gamma.col(2);
    MatrixXd B_voltage                 = MatrixXd::Zero(n, 2);
    B_voltage.topRows(n_plant)         = held.Gamma.leftCols(2);
    MatrixXd B_noise                   = MatrixXd::Zero(n, 3);
    B_noise.middleRows(n_plant, n_hat) = PL;
    MatrixXd C_voltage(2, n);
    C_voltage << MatrixXd::Zero(2, n_plant), law.F, law.F_ref;

    // The motor depends on theta - theta^ only, not on the angle itself. With that difference as a
    // state, theta^ is an integrator that only a position's law reads. Otherwise theta^ is left
    // out.
    const Eigen::Index        hat = n_plant + 6;
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < n; i++) {
        if (i != hat || angle) {
            rows.push_back(i);
        }
    }
    MatrixXd S         = MatrixXd::Identity(n, n);
    S(3, hat)          = -1.0;
    MatrixXd S_inverse = MatrixXd::Identity(n, n);
    S_inverse(3, hat)  = 1.0;
    const auto all     = Eigen::all;

    SampledModel out;
    out.ts_s      = ts;
    out.A         = MatrixXd(S * A * S_inverse)(rows, rows);
    out.C_voltage = C_voltage(all, rows); // the law reads theta^ or not, but not their difference
    out.b_load    = MatrixXd(S * b_load)(rows, all);
    out.B_noise   = MatrixXd(S * B_noise)(rows, all);
    out.B_voltage = MatrixXd(S * B_voltage)(rows, all);
    return out;
}

double mtpa_id_A(const ReducedParameters &l, double iq_A)
{
    const double k =
        l[12] > 0.0 ? l[12] : 0.5 * l[5] / std::max(1.0 - l[10], 1e-9); // EQ-CURRENT-REF-2
    if (l[13] > 0.0) {
        return std::min(-0.5 * iq_A * iq_A / k, l[0]);
    }
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
