// SPDX-License-Identifier: MIT
#include "design/motor_model.hpp"

#include <algorithm>
#include <cmath>

namespace sdre {

using Eigen::MatrixXd;

namespace {

// Chosen: the acceleration per ampere then changes by five over the currents, as in the machines
// that are certified without it. The current is a seventh of the limit without any magnet, with 2 %
// of the largest copper loss.
constexpr double least_flux_share = 0.2;

double rest_current_A(const Motor &m)
{
    const double saliency = m.q_axis_inductance_H - m.d_axis_inductance_H;
    if (!(saliency > 0.0) || !(m.max_current_A > 0.0)) {
        return 0.0;
    }
    const double k    = 0.5 * m.pm_flux_Wb / saliency; // EQ-CURRENT-REF-2
    const double i2   = m.max_current_A * m.max_current_A;
    const double id_A = 0.5 * i2 / (0.5 * k + std::sqrt(0.25 * k * k + 0.5 * i2));
    const double most = m.pm_flux_Wb + saliency * id_A;
    return std::min(0.0, (m.pm_flux_Wb - least_flux_share * most) / saliency);
}

} // namespace

ReducedParameters reduced_parameters(const Motor &m)
{
    const double np = m.pole_pairs;
    const double Rs = m.stator_resistance_Ohm;
    const double Ld = m.d_axis_inductance_H;
    const double Lq = m.q_axis_inductance_H;
    const double J  = m.inertia_kgm2;

    ReducedParameters l{}; // EQ-MOTOR-1
    l[0]  = rest_current_A(m);
    l[1]  = 1.5 * np * np * m.pm_flux_Wb / J;
    l[2]  = m.viscous_friction_Nms / J;
    l[3]  = np / J;
    l[4]  = Rs / Lq;
    l[5]  = m.pm_flux_Wb / Lq;
    l[6]  = 1.0 / Lq;
    l[7]  = Rs / Ld;
    l[8]  = 1.0 / Ld;
    l[9]  = Lq / Ld;
    l[10] = Ld / Lq;
    l[11] = 1.5 * np * np * (Ld - Lq) / J;
    l[12] = m.mtpa.k_A;
    l[13] = m.mtpa.second_order ? 1.0 : 0.0;
    return l;
}

ReducedParameters at_rest(ReducedParameters l)
{
    l[1] += l[11] * l[0];
    l[5] += l[10] * l[0];
    return l;
}

namespace {

MatrixXd constant_part(const ReducedParameters &l)
{
    MatrixXd A(3, 3);
    A << -l[2], l[1], 0.0, -l[5], -l[4], 0.0, 0.0, 0.0, -l[7];
    return A;
}

} // namespace

MatrixXd nosc_input_matrix(const ReducedParameters &l)
{
    MatrixXd B(3, 2);
    B << 0.0, 0.0, l[6], 0.0, 0.0, l[8];
    return B;
}

namespace {

/// The products of (10) per ampere of the q current; (20) has the first alone.
MatrixXd products_of_iq(const ReducedParameters &l)
{
    MatrixXd dA = MatrixXd::Zero(3, 3);
    dA(0, 2)    = l[11];
    dA(2, 0)    = l[9];
    return dA;
}

/// -l10 i_d w, which paper A leaves out of its state matrices.
MatrixXd products_of_id(const ReducedParameters &l)
{
    MatrixXd dA = MatrixXd::Zero(3, 3);
    dA(1, 0)    = -l[10];
    return dA;
}

SdreProblem error_problem(const ReducedParameters &l, const NoscSpec &spec,
                          const std::vector<MatrixXd> &dA)
{
    const Eigen::Vector2d T(spec.T[0], spec.T[1]);
    const Eigen::Vector3d Q(spec.Q[0], spec.Q[1], spec.Q[2]);
    return {constant_part(l), dA, control_weight(nosc_input_matrix(l), T.asDiagonal()),
            Q.asDiagonal()};
}

MatrixXd without_dq_dd(const MatrixXd &M)
{
    const std::vector<Eigen::Index> kept{0, 3, 4, 5};
    return M.rows() == 3 ? MatrixXd(M(Eigen::all, kept)) : MatrixXd(M(kept, kept));
}

} // namespace

SdreProblem nosc_problem(const ReducedParameters &l, const NoscSpec &spec)
{
    MatrixXd dA = MatrixXd::Zero(3, 3);
    dA(0, 2)    = l[11]; // (20)
    return error_problem(l, spec, {dA});
}

SdreProblem conventional_nosc_problem(const ReducedParameters &l, const NoscSpec &spec)
{
    return error_problem(l, spec, {products_of_iq(l), products_of_id(l)}); // EQ-CONVENTIONAL-2
}

ObserverModel nodo_model(const ReducedParameters &l, NodoForm form)
{
    const Eigen::Index n = (form == NodoForm::encoder) ? 7 : 6;
    ObserverModel      model;
    model.A0                   = MatrixXd::Zero(n, n);
    model.dA                   = MatrixXd::Zero(n, n);
    model.C                    = MatrixXd::Zero(3, n);
    model.A0.block(3, 0, 3, 3) = MatrixXd::Identity(3, 3); // (34); see docs/errata.md for (35)
    model.A0.block(3, 3, 3, 3) = constant_part(l);
    model.dA.block(3, 3, 3, 3) = products_of_iq(l);
    if (form == NodoForm::encoder) {
        model.A0(6, 3) = 1.0; // theta' = w
        model.C.rightCols(3).setZero();
        model.C(0, 4) = model.C(1, 5) = model.C(2, 6) = 1.0;
    } else {
        model.C.rightCols(3) = MatrixXd::Identity(3, 3);
    }
    if (form == NodoForm::conventional_load || form == NodoForm::conventional_all) {
        model.dA_id                    = MatrixXd::Zero(n, n);
        model.dA_id->block(3, 3, 3, 3) = products_of_id(l); // EQ-CONVENTIONAL-3
    }
    if (form == NodoForm::conventional_load) {
        model.A0    = without_dq_dd(model.A0);
        model.dA    = without_dq_dd(model.dA);
        model.dA_id = without_dq_dd(*model.dA_id);
        model.C     = without_dq_dd(model.C);
    }
    return model;
}

SdreProblem nodo_problem(const ReducedParameters &l, const NodoSpec &spec)
{
    const ObserverModel   model = nodo_model(l, spec.form);
    const Eigen::Vector3d T(spec.T[0], spec.T[1], spec.T[2]);
    const Eigen::VectorXd Q =
        Eigen::Map<const Eigen::VectorXd>(spec.Q.data(), static_cast<Eigen::Index>(spec.Q.size()));
    std::vector<MatrixXd> dA{model.dA.transpose()};
    if (model.dA_id) {
        dA.emplace_back(model.dA_id->transpose());
    }
    return {model.A0.transpose(), dA, control_weight(model.C.transpose(), T.asDiagonal()),
            Q.asDiagonal()};
}

double torque_Nm(const Motor &m, double id_A, double iq_A)
{
    return 1.5 * m.pole_pairs *
           (m.pm_flux_Wb + (m.d_axis_inductance_H - m.q_axis_inductance_H) * id_A) * iq_A;
}

} // namespace sdre
