// SPDX-License-Identifier: MIT
/// The motor as the control problems see it: reduced parameters (EQ-MOTOR-1) and the two SDRE problems.
#pragma once

#include <array>
#include <optional>

#include "design/sdre_series.hpp"
#include "drive/drive_file.hpp"

namespace sdre {

/// l[1] .. l[11] of paper A (2). l[0] is the d current without load [A], at most 0. It supports a
/// magnet that gives less than a fifth of the largest flux, so that every q current has some
/// torque. It is 0 for all other motors. With a fitted curve (Motor::mtpa) the k [A] of it is l[12], which is 0 otherwise. Its form is
/// l[13]; 1 is the second-order one.
using ReducedParameters = std::array<double, 14>;

ReducedParameters reduced_parameters(const Motor &motor);

/// The same around the d current without load in place of none: l1 and l5 as they are there.
ReducedParameters at_rest(ReducedParameters l);

/// Error dynamics (10), (15), (20): states e_w, e_iq, e_id; inputs v_q, v_d; scheduled by e_iq.
SdreProblem nosc_problem(const ReducedParameters &l, const NoscSpec &spec);

/// The same for the conventional law: also scheduled by e_id, l9 e_iq e_w and -l10 e_id e_w stay in A.
SdreProblem conventional_nosc_problem(const ReducedParameters &l, const NoscSpec &spec);

/// 3 x 2 input matrix of (10).
Eigen::MatrixXd nosc_input_matrix(const ReducedParameters &l);

/// Observer (27), (34), (35). States: d_w, d_q, d_d, w, i_q, i_d, in the encoder form also theta.
/// It is scheduled by i_q and not transposed; n is 6 or 7. The conventional observer is scheduled
/// by i_d too. Its form for the load alone has no d_q and d_d, and n is 4.
struct ObserverModel {
    Eigen::MatrixXd                A0;    ///< n x n
    Eigen::MatrixXd                dA;    ///< n x n, per ampere of i_q
    std::optional<Eigen::MatrixXd> dA_id; ///< the same per ampere of i_d; conventional forms only
    Eigen::MatrixXd                C;     ///< 3 x n: w, i_q, i_d are measured, or i_q, i_d, theta
};

ObserverModel nodo_model(const ReducedParameters &l, NodoForm form);

/// The dual of the observer problem, (33): A0', dA', C' T^-1 C.
SdreProblem nodo_problem(const ReducedParameters &l, const NodoSpec &spec);

/// Electromagnetic torque of (1) [N m]; currents in amperes peak.
double torque_Nm(const Motor &motor, double id_A, double iq_A);

} // namespace sdre
